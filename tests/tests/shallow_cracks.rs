//! A shallow crack keeps its digits: the variations ε of the stiffness are differences of two nearly equal inverses.

use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::quantity::Quantity;
use rotor_core::study::evaluate;
use rotor_tests::{number, parameters, relative_error, table};

#[test]
fn compliance_and_stiffness_variations_of_shallow_cracks() {
    let quantities = [
        Quantity::C11,
        Quantity::C22,
        Quantity::C33,
        Quantity::C44,
        Quantity::Epsilon1,
        Quantity::Epsilon12,
        Quantity::Epsilon2,
    ];
    let rows = table("shallow_cracks.csv");
    assert_eq!(rows.len(), 12);
    let mut worst = 0.0_f64;
    for row in &rows {
        let rotor = Rotor::new(parameters(row)).unwrap();
        for (quantity, value) in quantities.iter().zip(evaluate(&quantities, &rotor)) {
            let error = relative_error(value.unwrap(), number(row, quantity.name()));
            worst = worst.max(error);
            assert!(
                error <= 1e-12,
                "{quantity} of {} at the depth {}: relative error {error:.1e}",
                row["crack_model"],
                row["crack_depth_ratio"]
            );
        }
    }
    println!("shallow cracks: worst relative error {worst:.1e}");
}
