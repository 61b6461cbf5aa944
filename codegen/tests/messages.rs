//! Messages that no source of a user's can bring about on stable Rust; all others are in `rotor-macros/tests/ui`.

use codegen::expand::Expansion;

#[test]
fn a_module_in_a_file_of_its_own_is_reported() {
    let expansion = Expansion::of(syn::parse_quote!(
        mod formulas;
    ));
    let messages: Vec<String> = expansion
        .diagnostics
        .iter()
        .map(|diagnostic| diagnostic.text())
        .collect();
    assert_eq!(
        messages,
        ["the module's formulas are not here\n  help: write the module inline: mod name { … }"]
    );
    assert!(
        expansion
            .into_tokens()
            .to_string()
            .contains("compile_error")
    );
}
