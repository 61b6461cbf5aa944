//! The generator takes any tokens: it answers with code or with messages, never with a panic.
//!
//! Begin with the formulas that there are:
//! `cargo +nightly fuzz run expand codegen/tests/formulas rotor-core/src -- -max_len=4096 -timeout=10`.
#![no_main]

use libfuzzer_sys::fuzz_target;
use proc_macro2::TokenStream;

fuzz_target!(|source: &str| {
    // Fits take long by their nature, so that no timeout would mean anything.
    if source.contains("approximate") {
        return;
    }
    if let Ok(module) = source.parse::<TokenStream>() {
        codegen::expand(TokenStream::new(), module);
    }
});
