//! The commented file of the paper's rotor, from the table of inputs.

use std::fmt::Write as _;

use super::SECTIONS;
use crate::input::{CrackEdge, CrackModel, INPUTS, RotorParameters};
use crate::text::shortest;

/// A file of the paper's rotor with a comment on every input, to start from: `rotor init` writes it.
#[must_use]
pub fn template() -> String {
    let paper = RotorParameters::PAPER;
    let mut text = String::from(
        "# A rotor for the command `rotor`: a disk on a simply supported shaft with a transverse crack.\n\
         # The values are the paper's. Units are SI; after each value: symbol, unit, what it is, allowed.\n",
    );
    for section in SECTIONS {
        let _ = write!(text, "\n[{section}]\n");
        for input in INPUTS.iter().filter(|input| input.section == section) {
            let setting = format!("{} = {}", input.key, number((input.get)(&paper)));
            let unit = if input.unit.is_empty() {
                "no unit"
            } else {
                input.unit
            };
            let _ = writeln!(
                text,
                "{setting:<26} # {}, {unit}: {}; {}",
                input.symbol, input.description, input.allowed
            );
        }
    }
    let models = CrackModel::ALL.map(CrackModel::name).join(", ");
    let edges = CrackEdge::ALL.map(CrackEdge::name).join(", ");
    let model = format!("model = \"{}\"", paper.crack_model);
    let edge = format!("edge = \"{}\"", paper.crack_edge);
    let _ = writeln!(
        text,
        "{model:<26} # how the crack enters the flexibility; {models}"
    );
    let _ = writeln!(
        text,
        "{edge:<26} # how much of the crack's edge a moment opens; {edges}"
    );
    text
}

/// A number as TOML writes a float.
fn number(value: f64) -> String {
    let text = shortest(value);
    if text.contains(['.', 'e']) {
        text
    } else {
        format!("{text}.0")
    }
}
