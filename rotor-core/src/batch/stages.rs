//! Stages of the chain: what each computes itself, and which stand for each other.

use crate::equations::chain::{Column, Stage};
use crate::jeffcott::rotor::LoadCase;

/// For each stage the first column that it computes, found while the crate is built: what a stage passes on is another's.
const OWN: [Column; Stage::ALL.len()] = {
    let mut own = [Column::ALL[0]; Stage::ALL.len()];
    let mut place = 0;
    while place < own.len() {
        let gives = Stage::ALL[place].gives();
        let mut given = gives.len();
        while given > 0 {
            given -= 1;
            let stages = gives[given].stages();
            let mut number = 0;
            while number < stages.len() {
                if stages[number] as usize == place {
                    own[place] = gives[given];
                }
                number += 1;
            }
        }
        place += 1;
    }
    own
};

/// The first column that a stage computes.
pub(super) const fn own(stage: Stage) -> Column {
    OWN[stage as usize]
}

/// The stages that give the same columns as a stage, itself among them: more than one are alternatives.
pub(super) const fn alternatives(stage: Stage) -> &'static [Stage] {
    own(stage).stages()
}

/// The stage that computes the loads in a case.
pub(super) const fn stage_of(case: LoadCase) -> Stage {
    match case {
        LoadCase::SupportArm => Stage::SupportArm,
        LoadCase::MidspanArm => Stage::MidspanArm,
        LoadCase::SimplySupportedLeft => Stage::SimplySupportedLeft,
        LoadCase::SimplySupportedRight => Stage::SimplySupportedRight,
    }
}
