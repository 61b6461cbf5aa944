//! How much a search for fewer operations may look at.
//!
//! A search whose candidates are pairs of operations, or levels of nesting, would take the square of the time of a formula
//! twice as long. So it asks a [`Budget`] before it looks, and where that is spent it goes on with fewer candidates or stops:
//! the code is right either way and has some operations more. Looks are counted and never timed, so that the same formula
//! gives the same bytes on every machine. What a budget gives is far more than any formula of the size of a page asks for.

/// Looks that every search may have, however small the formula: a millisecond of work, and five times what any search takes
/// in the formulas of this crate's tests.
const LEAST: usize = 1 << 13;

/// Looks per operation beyond these, which is what makes the work grow as the formula does: so many neighbours are compared
/// with each operand of a wide sum or product.
const PER_OPERATION: usize = 16;

/// Looks at candidates that are left, and how many there were.
#[derive(Clone, Debug, Default)]
pub struct Budget {
    left: usize,
    spent: usize,
}

impl Budget {
    /// Gives the next search in a circuit of so many operations its own looks: none is cut short by the one before it.
    pub fn renew(&mut self, operations: usize) {
        self.allow(LEAST + PER_OPERATION * operations);
    }

    /// Gives the next search so many looks.
    pub fn allow(&mut self, looks: usize) {
        self.left = looks;
    }

    /// Whether so many looks are left; they are taken if so.
    pub fn take(&mut self, looks: usize) -> bool {
        let is_left = looks <= self.left;
        if is_left {
            self.left -= looks;
            self.spent += looks;
        }
        is_left
    }

    /// All looks so far, of all searches.
    pub fn spent(&self) -> usize {
        self.spent
    }
}
