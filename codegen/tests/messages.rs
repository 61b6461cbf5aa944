//! Messages that no source of a user's can bring about on stable Rust, and the generator's own documentation; all other
//! messages are in `rotor-macros/tests/ui`.

use codegen::expand::Expansion;
use codegen::show;

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

#[test]
fn nothing_stands_in_for_code_without_an_error() {
    let mut expansion = Expansion::unread(
        proc_macro2::TokenStream::new(),
        syn::parse_quote!(
            mod formulas {
                #[generate(value)]
                pub fn square(x: f64) -> f64 {
                    x * x
                }
            }
        ),
    );
    expansion.generate_all();
    let messages: Vec<String> = expansion
        .diagnostics
        .iter()
        .map(|diagnostic| diagnostic.text())
        .collect();
    assert_eq!(
        messages,
        ["`square` was not read\n  help: formulas are read before code is generated from them"]
    );
}

#[test]
fn two_stages_of_one_name_are_reported() {
    let mut expansion = Expansion::of(syn::parse_quote!(
        mod formulas {
            #[generate(stage(a, b, d), stage(a, c, d))]
            pub fn sum(a: f64, b: f64, c: f64, d: f64, e: f64) -> f64 {
                a * b + c * d + e
            }
        }
    ));
    expansion.generate_all();
    let messages: Vec<String> = expansion
        .diagnostics
        .iter()
        .map(|diagnostic| diagnostic.text())
        .collect();
    assert_eq!(
        messages,
        [
            "a second stage whose module is `along_a_to_d`\n  help: leave one of them, or name its parameters in another order"
        ]
    );
}

#[test]
fn partials_by_nothing_are_documented_as_such() {
    let source = "#[symbolic] mod m { #[generate(gradient)] pub fn one() -> f64 { 1.0 } }";
    let mut module = show::module(source).unwrap();
    let rust = show::rust(&mut module, "one").unwrap();
    assert!(
        rust.contains("depends on no number: it has no partials"),
        "{rust}"
    );
    assert!(
        rust.contains("pub fn gradient() -> (f64, [f64; 0])"),
        "{rust}"
    );
}
