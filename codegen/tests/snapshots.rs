//! The code of small formulas as it is, so that every change of it is seen.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod support;

use codegen::emit;
use codegen::emit::scalar::Form;
use proc_macro2::TokenStream;

const SMALL: &str = include_str!("formulas/small.rs");
const DETERMINANT: &str = include_str!("formulas/determinant.rs");

/// The module `name` of generated forms in an expansion.
fn forms_of(source: &str, name: &str) -> String {
    let attribute = quote::quote!(sizes = 1e-9..=1e9);
    let expanded = codegen::expand(attribute, source.parse().unwrap());
    let expanded: syn::ItemMod = syn::parse2(expanded).unwrap();
    let is_forms = |item: &syn::Item| {
        let text = quote::ToTokens::to_token_stream(item).to_string();
        text.contains(&format!("pub mod {name} {{"))
    };
    let forms: Vec<TokenStream> = expanded
        .content
        .unwrap()
        .1
        .iter()
        .filter(|item| is_forms(item))
        .map(quote::ToTokens::to_token_stream)
        .collect();
    assert_eq!(forms.len(), 1, "{name}");
    emit::format(forms.into_iter().collect()).unwrap()
}

macro_rules! snapshot {
    ($test:ident, $source:expr) => {
        #[test]
        fn $test() {
            insta::assert_snapshot!(stringify!($test), forms_of($source, stringify!($test)));
        }
    };
}

snapshot!(determinant, DETERMINANT);
snapshot!(turned, SMALL);
snapshot!(clamped, SMALL);
snapshot!(quotient, SMALL);
snapshot!(fractions, SMALL);
snapshot!(circle_on_diagonal, SMALL);
snapshot!(tabulated, SMALL);
snapshot!(in_columns, SMALL);
snapshot!(resultant, SMALL);

#[test]
fn a_determinant_with_ten_partials_takes_96_operations() {
    let mut expansion = support::expansion(DETERMINANT);
    let form = support::generated(&mut expansion, "determinant", Form::Gradient);
    assert_eq!(form.by.len(), 10);
    assert_eq!(
        (form.circuit.cost().operations(), form.circuit.cost().div),
        (96, 0)
    );
}
