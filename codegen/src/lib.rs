//! Closed-form formulas in, specialised Rust out.
