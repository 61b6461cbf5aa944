//! What a reader asks of whoever makes the tables of approximated functions.

use super::attributes::Approximation;
use super::module::{Function, Module};
use crate::graph::Table;

/// Makes the tables of approximated functions that formulas call. To make one, a function's body is read, and that may call
/// other tabulated functions: so the reader takes its tables from outside.
pub trait TableSource {
    /// The table of an approximated function of the module `home`, which is read for the module `reading`, another one or
    /// itself; none where it could not be made, which the source reports.
    fn table(
        &mut self,
        reading: &Module,
        home: &Module,
        function: &Function,
        approximation: &Approximation,
    ) -> Option<&Table>;

    /// An empty source whose tables have a few digits only, for code that is read and then dropped.
    fn sketched_apart(&self) -> Box<dyn TableSource>;
}
