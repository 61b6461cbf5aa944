//! The three ways to a region agree on the random rotors of tests/reference.

use std::path::Path;

use rayon::prelude::*;
use rotor_core::input::{INPUTS, RotorParameters};
use rotor_core::jeffcott::rotor::Rotor;
use rotor_core::model::Survey;

type Failure = Box<dyn std::error::Error>;

fn random_rotors() -> Result<Vec<Rotor>, Failure> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/reference/random_rotors.csv");
    let mut reader = csv::Reader::from_path(path)?;
    let header = reader.headers()?.clone();
    let mut rotors = Vec::new();
    for record in reader.records() {
        let record = record?;
        let cell = |name: &str| {
            let place = header.iter().position(|heading| heading == name);
            place.and_then(|place| record.get(place)).ok_or("no column")
        };
        let mut parameters = RotorParameters::PAPER;
        for input in &INPUTS {
            (input.set)(&mut parameters, cell(input.name)?.parse()?);
        }
        parameters.crack_model = cell("crack_model")?.parse()?;
        rotors.push(Rotor::new(parameters)?);
    }
    Ok(rotors)
}

#[test]
fn three_ways_to_a_region_agree() -> Result<(), Failure> {
    let rotors = random_rotors()?;
    assert_eq!(rotors.len(), 300);
    let surveys: Vec<_> = rotors
        .par_iter()
        .map(|rotor| Ok(Survey::of(&rotor.coefficients()?)))
        .collect::<Result<_, rotor_core::error::Error>>()?;
    let (mut exact, mut checked) = (0, 0);
    for (row, survey) in surveys.iter().enumerate() {
        for (kind, region) in &survey.regions {
            let Ok(region) = region else { continue };
            let line = row + 2;
            assert!(region.agrees(), "line {line}, {kind}: {:?}", region.hill);
            exact += usize::from(region.exact.is_ok());
            checked += usize::from(region.exact.is_ok() && region.hill.is_ok());
        }
    }
    assert!(10 * checked >= 9 * exact, "{checked} of {exact}");
    Ok(())
}
