//! Rotors and what belongs to them, written and read again by `serde`.

#![cfg(feature = "serde")]

use rotor_core::equations::Coefficients;
use rotor_core::input::{CrackEdge, CrackModel, RotorParameters};
use rotor_core::jeffcott::exact::Ends;
use rotor_core::jeffcott::region::{Region, RegionKind};
use rotor_core::jeffcott::rotor::Rotor;

type TestResult = Result<(), Box<dyn std::error::Error>>;

#[test]
fn a_rotor_is_written_as_its_inputs_and_read_again() -> TestResult {
    let rotor = Rotor::paper().with(|p| {
        p.crack_model = CrackModel::SimplySupported;
        p.crack_edge = CrackEdge::Full;
    })?;
    let text = serde_json::to_string(&rotor)?;
    assert_eq!(text, serde_json::to_string(rotor.parameters())?);
    assert_eq!(serde_json::from_str::<Rotor>(&text)?, rotor);
    Ok(())
}

#[test]
fn what_is_no_rotor_is_not_read() -> TestResult {
    let text = serde_json::to_string(&RotorParameters {
        crack_depth_ratio: 1.5,
        ..RotorParameters::PAPER
    })?;
    assert!(serde_json::from_str::<RotorParameters>(&text).is_ok());
    let error = serde_json::from_str::<Rotor>(&text).unwrap_err();
    let expected = "crack_depth_ratio is 1.5; it must be >= 0 and <= 1";
    assert!(error.to_string().contains(expected), "{error}");
    Ok(())
}

#[test]
fn choices_have_the_names_that_files_give_them() -> TestResult {
    for model in CrackModel::ALL {
        assert_eq!(serde_json::to_string(&model)?, format!("\"{model}\""));
    }
    for edge in CrackEdge::ALL {
        assert_eq!(serde_json::to_string(&edge)?, format!("\"{edge}\""));
    }
    Ok(())
}

#[test]
fn coefficients_and_ends_are_read_as_they_were_written() -> TestResult {
    let coefficients = Rotor::paper().coefficients()?;
    let text = serde_json::to_string(&coefficients)?;
    let read: Coefficients = serde_json::from_str(&text)?;
    assert!((read.gamma - coefficients.gamma).abs() <= 1e-15 * coefficients.gamma.abs());
    let ends = Region::of(RegionKind::Simple, &coefficients)?.exact_ends()?;
    let read: Ends = serde_json::from_str(&serde_json::to_string(&ends)?)?;
    assert!((read.width() - ends.width()).abs() < 1e-15);
    Ok(())
}
