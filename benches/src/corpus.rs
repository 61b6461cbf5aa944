//! Thirty formulas of public origin on which the tools' operation counts are compared.
//!
//! Each is plain Rust under the generator, with its source and units, in `corpus/` or, those of the rotor, in
//! [`rotor_core::equations`].

use codegen::cost::Cost;
use codegen::emit::scalar::Form;
use codegen::expand::Generated;
use codegen::parse::module::Function;
use codegen::show::{self, ShowError, System};
use rotor_core::equations;

#[path = "../corpus/chemistry.rs"]
pub mod chemistry;
#[path = "../corpus/geometry.rs"]
pub mod geometry;
#[path = "../corpus/robotics.rs"]
pub mod robotics;

/// The formulas of one field.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// The field, which is also the name of its file.
    pub name: &'static str,
    /// The files of its modules: the path and the text of each.
    pub sources: &'static [(&'static str, &'static str)],
    /// The formulas taken from it.
    pub formulas: &'static [&'static str],
}

/// All fields.
pub const FIELDS: [Field; 4] = [
    Field {
        name: "rotor",
        sources: &equations::SOURCES,
        formulas: &[
            "f_n",
            "phi",
            "sir_start",
            "cir_start",
            "sir_width",
            "cir_width",
        ],
    },
    Field {
        name: "robotics",
        sources: &[("robotics.rs", robotics::SOURCE)],
        formulas: &[
            "two_link_position",
            "three_link_pose",
            "two_link_torques",
            "quaternion_rotation",
            "reprojection_error",
            "inertial_position_residual",
            "relative_pose_error",
            "bicycle_rates",
        ],
    },
    Field {
        name: "chemistry",
        sources: &[("chemistry.rs", chemistry::SOURCE)],
        formulas: &[
            "van_der_waals",
            "peng_robinson",
            "mixed_inhibition",
            "arrhenius",
            "lennard_jones",
            "morse",
            "debye_hueckel",
            "antoine",
        ],
    },
    Field {
        name: "geometry",
        sources: &[("geometry.rs", geometry::SOURCE)],
        formulas: &[
            "heron",
            "circumradius",
            "haversine",
            "determinant_3",
            "determinant_4",
            "tetrahedron_volume",
            "ray_sphere",
            "torus_distance",
        ],
    },
];

/// A formula with what the generator makes of it.
#[derive(Debug)]
pub struct Counted {
    /// As read.
    pub function: Function,
    /// The value alone.
    pub value: Generated,
    /// The value and its first partials: by those that the formula names, by all its inputs where it names none.
    pub gradient: Generated,
}

impl Counted {
    /// The counts of the value, and of value and gradient together.
    pub fn costs(&self) -> [Cost; 2] {
        [self.value.circuit.cost(), self.gradient.circuit.cost()]
    }
}

impl Field {
    /// Its modules, of which nothing is read yet.
    ///
    /// # Errors
    /// See [`show::system`].
    pub fn system(&self) -> Result<System, ShowError> {
        show::system(self.sources)
    }

    /// One of its formulas, counted.
    ///
    /// # Errors
    /// There is no such formula, or it has mistakes.
    pub fn counted(&self, system: &mut System, name: &str) -> Result<Counted, ShowError> {
        let expansion = system.of(name)?;
        // Finds mistakes, and reads the formula.
        show::forms(expansion, name)?;
        let missing = || ShowError::Mistakes(name.to_owned());
        let function = expansion.module().function(name).cloned();
        let function = function.ok_or_else(missing)?;
        let by = function
            .request
            .clone()
            .and_then(|request| request.gradient);
        let by = by.unwrap_or_default();
        let mut form = |form| expansion.generate(&function, form, &by).ok_or_else(missing);
        let (value, gradient) = (form(Form::Value)?, form(Form::Gradient)?);
        Ok(Counted {
            function: Function::clone(&function),
            value,
            gradient,
        })
    }
}
