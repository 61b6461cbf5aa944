//! What the generator says about mistakes: one case per kind, all mistakes of a module in one pass.

#[test]
fn mistakes_are_reported_at_their_tokens_with_a_hint() {
    trybuild::TestCases::new().compile_fail("tests/ui/*.rs");
}
