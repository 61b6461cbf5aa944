//! The code that is generated from the paper's equations: how many operations.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test fails by panicking"
)]

use codegen::emit::scalar::Form;
use codegen::show;
use rotor_core::equations;

#[test]
fn the_main_formulas_take_as_many_operations_as_ever() {
    let mut system = show::system(&equations::SOURCES).unwrap();
    let counts: String = ["phi", "phi_on_sir", "sir_width", "cir_width"]
        .into_iter()
        .flat_map(|name| {
            show::forms(system.of(name).unwrap(), name)
                .unwrap()
                .into_iter()
                .map(move |form| (name, form))
        })
        .map(|(name, form)| format!("{name}::{}: {}\n", form.form.name(), form.circuit.cost()))
        .collect();
    assert_eq!(
        counts,
        "\
phi::value: 28 add, 41 mul, 0 div, 0 sqrt, 1 call
phi::gradient: 53 add, 78 mul, 0 div, 0 sqrt, 1 call
phi::hessian: 132 add, 178 mul, 0 div, 0 sqrt, 1 call
phi_on_sir::value: 20 add, 31 mul, 0 div, 0 sqrt, 1 call
phi_on_sir::gradient: 33 add, 53 mul, 0 div, 0 sqrt, 1 call
sir_width::value: 26 add, 34 mul, 4 div, 2 sqrt, 2 call
sir_width::gradient: 66 add, 108 mul, 8 div, 4 sqrt, 2 call
cir_width::value: 37 add, 57 mul, 2 div, 4 sqrt, 2 call
cir_width::gradient: 108 add, 188 mul, 9 div, 4 sqrt, 2 call
"
    );
}

/// Of the sums in this gradient, parts are equal to others though they are written differently; where that goes unnoticed it
/// takes 8 operations more.
#[test]
fn equal_parts_of_sums_are_computed_once() {
    let mut system = show::system(&equations::SOURCES).unwrap();
    let expansion = system.of("sir_growth").unwrap();
    expansion.read_only("sir_growth");
    let function = expansion.module().function("sir_growth").cloned().unwrap();
    let form = expansion.generate(&function, Form::Gradient, &[]).unwrap();
    let cost = form.circuit.cost();
    assert_eq!((cost.add, cost.mul, cost.div), (66, 121, 8), "{cost}");
}
