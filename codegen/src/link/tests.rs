use std::collections::BTreeMap;

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use quote::quote;

use super::{attribute, linked};

/// Modules by the path at which the others find them, each with its attribute and its source.
type Modules<'s> = [(&'s str, &'s str, &'s str)];

/// The last group in braces of a stream.
fn last_group(tokens: &TokenStream) -> TokenStream {
    let groups = tokens.clone().into_iter().filter_map(|token| match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => Some(group.stream()),
        _ => None,
    });
    groups.last().expect("a group")
}

/// What the module's hidden macro puts behind what was gathered.
fn handed(expanded: &TokenStream) -> TokenStream {
    let mut tokens = last_group(expanded).into_iter();
    let of_macro =
        |token: &TokenTree| matches!(token, TokenTree::Ident(name) if name == "__this_module");
    tokens.find(of_macro).expect("the macro");
    let Some(TokenTree::Group(rules)) = tokens.next() else {
        panic!("the rules of the macro");
    };
    // `{ ::rotor_macros::__linked! { $gathered module } }`
    let call = last_group(&last_group(&rules.stream()));
    let last = call.into_iter().last().expect("the module");
    quote!(#last)
}

/// The path before the `!` of the last macro call of a stream, and what the call is given.
fn call(tokens: &TokenStream) -> Option<(String, TokenStream)> {
    let tokens: Vec<TokenTree> = tokens.clone().into_iter().collect();
    let [path @ .., TokenTree::Punct(mark), TokenTree::Group(group)] = tokens.as_slice() else {
        return None;
    };
    let path: TokenStream = path.iter().cloned().collect();
    let path = path.to_string().replace(' ', "");
    let start =
        path.rfind(|letter: char| !(letter.is_alphanumeric() || matches!(letter, ':' | '_')));
    let path = &path[start.map_or(0, |start| start + 1)..];
    (mark.as_char() == '!').then(|| (path.to_owned(), group.stream()))
}

/// Does what the compiler does with the hidden macros: what the module at the first place becomes, and which modules it
/// asked.
fn expand(modules: &Modules<'_>) -> (String, Vec<String>) {
    let expanded = modules.iter().map(|(place, settings, source)| {
        let tokens = attribute(settings.parse().unwrap(), source.parse().unwrap());
        (*place, tokens)
    });
    let expanded: BTreeMap<&str, TokenStream> = expanded.collect();
    let mut asked = Vec::new();
    let mut tokens = last_group(&expanded[modules[0].0]);
    while let Some((path, gathered)) = call(&tokens) {
        tokens = match path.strip_suffix("::__formulas") {
            Some(place) => {
                // The module's own items are one module further in.
                let place = place.strip_prefix("super::").unwrap_or(place);
                asked.push(place.to_owned());
                let answer = handed(&expanded[place]);
                linked(quote!(#gathered #answer))
            }
            None if path.ends_with("__linked") => linked(gathered),
            // The message of a mistake.
            None => break,
        };
    }
    (tokens.to_string(), asked)
}

const DIAMOND: [(&str, &str, &str); 4] = [
    (
        "super::top",
        "with(super::left, super::right)",
        "mod formulas {
            use super::super::left::*;
            use super::super::right::two_sides;
            #[generate(value)]
            pub fn all(x: f64) -> f64 { one_side(x) + two_sides(x) }
        }",
    ),
    (
        "super::left",
        "with(super::base)",
        "mod formulas {
            use super::super::base::*;
            pub fn one_side(x: f64) -> f64 { side(x) }
        }",
    ),
    (
        "super::right",
        "with(super::base)",
        "mod formulas { pub fn two_sides(x: f64) -> f64 { 2.0 * super::super::base::side(x) } }",
    ),
    (
        "super::base",
        "sizes = 1e-6..=1e6",
        "mod formulas { pub fn side(x: f64) -> f64 { x.sin() } }",
    ),
];

#[test]
fn each_module_is_asked_once() {
    let (expanded, asked) = expand(&DIAMOND);
    assert_eq!(asked, ["super::left", "super::right", "super::base"]);
    assert!(!expanded.contains("compile_error"), "{expanded}");
    // The functions as written stay, and only what this module asks for is generated.
    assert!(
        expanded.contains("one_side (x) + two_sides (x)"),
        "{expanded}"
    );
    assert!(expanded.contains("x . sin ()"), "{expanded}");
    assert_eq!(expanded.matches("pub fn").count(), 2, "{expanded}");
}

#[test]
fn a_module_that_another_one_links_is_known_by_its_path() {
    let mut modules = DIAMOND;
    modules[0].2 = "mod formulas {
        #[generate(value)]
        pub fn all(x: f64) -> f64 { super::super::base::side(x) }
    }";
    let (expanded, _) = expand(&modules);
    assert!(!expanded.contains("compile_error"), "{expanded}");
}

#[test]
fn an_import_of_what_is_not_known_hides_what_is_imported_whole() {
    let mut modules = DIAMOND;
    modules[0].2 = "mod formulas {
        use super::super::base::*;
        use super::by_hand::side;
        pub fn all(x: f64) -> f64 { side(x) }
    }";
    let (expanded, _) = expand(&modules);
    assert!(expanded.contains("unknown function `side`"), "{expanded}");
}

#[test]
fn circles_are_refused() {
    let mut modules = DIAMOND;
    modules[3].1 = "with(super::top)";
    let (expanded, _) = expand(&modules);
    let way = "this module links itself: `super::left` → `super::base` → `super::top`";
    assert!(expanded.contains(way), "{expanded}");
}

#[test]
fn settings_are_taken_over_unless_they_are_stated() {
    let mut modules = DIAMOND;
    modules[2].1 = "with(super::base), sizes = 1e-3..=1e3";
    let (expanded, _) = expand(&modules);
    let message = "`super::right` says another thing of the sizes of numbers";
    assert!(expanded.contains(message), "{expanded}");
    modules[0].1 = "with(super::left, super::right), sizes = 1e-9..=1e9";
    let (expanded, _) = expand(&modules);
    assert!(!expanded.contains("compile_error"), "{expanded}");
    // Without sizes 1/(1/x + 1/y) keeps its divisions.
    modules[0].2 = "mod formulas {
        #[generate(value)]
        pub fn both(x: f64, y: f64) -> f64 { 1.0 / (1.0 / x + 1.0 / y) }
    }";
    modules[0].1 = "with(super::left), domain(x > 0.0, y > 0.0)";
    let (expanded, _) = expand(&modules);
    assert!(expanded.contains("1 div"), "{expanded}");
    modules[3].1 = "";
    let (expanded, _) = expand(&modules);
    assert!(expanded.contains("3 div"), "{expanded}");
}

#[test]
fn other_tokens_are_refused() {
    let refused = linked(quote!(a b)).to_string();
    assert!(refused.contains("by nothing else"), "{refused}");
}
