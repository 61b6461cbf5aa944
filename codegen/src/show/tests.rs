use super::*;

const SOURCE: &str = "
    #[symbolic(sizes = 1e-9..=1e9)]
    mod m {
        /// Length of an arc of the sine
        /// from 0.
        ///
        /// More.
        #[approximate(x = 0.0..=2.0, factor = x, tolerance = 1e-11)]
        pub fn arc(x: f64) -> f64 { integral(|t| (1.0 + t.cos().powi(2)).sqrt(), 0.0..x) }

        /// Calls [`arc`].
        #[domain(x > 0.0)]
        #[generate(value, gradient(x, y))]
        pub fn f(x: f64, y: f64) -> f64 { y * arc(x).powi(2).sqrt() }

        pub fn untabulated(x: f64) -> f64 { integral(|t| t * t, 0.0..x) }
    }";

#[test]
fn sketched_tables_change_no_code() {
    let file = syn::parse_file(SOURCE).unwrap();
    let (attribute, item) = file
        .items
        .into_iter()
        .find_map(|item| match item {
            Item::Mod(item) => symbolic(item),
            _ => None,
        })
        .unwrap();
    let mut fitted = Expansion::unread(attribute, item);
    let mut sketched = module(SOURCE).unwrap();
    let code = rust(&mut sketched, "f").unwrap();
    assert_eq!(code, rust(&mut fitted, "f").unwrap());
    // The table's sign is known, so that the root is gone.
    assert!(
        code.contains("arc_table") && !code.contains("sqrt()"),
        "{code}"
    );
}

#[test]
fn a_list_tells_what_each_formula_is() {
    let list = list(&mut module(SOURCE).unwrap());
    let about: Vec<_> = list
        .iter()
        .map(|formula| (formula.name.as_str(), formula.about.as_str()))
        .collect();
    let expected = [
        ("arc", "Length of an arc of the sine from 0."),
        ("f", "Calls `arc`."),
        ("untabulated", ""),
    ];
    assert_eq!(about, expected);
    assert_eq!(
        list.iter()
            .map(|formula| formula.cost.is_some())
            .collect::<Vec<_>>(),
        [true, true, false]
    );
}

#[test]
fn what_cannot_be_shown_is_told() {
    assert!(matches!(module("mod m {}"), Err(ShowError::NoModule)));
    assert!(matches!(module("mod {"), Err(ShowError::Syntax(_))));
    let mut read = module(SOURCE).unwrap();
    let error = rust(&mut read, "untabulated").unwrap_err().to_string();
    assert!(error.contains("integral without a table"), "{error}");
    let error = graph(&mut read, "g").unwrap_err().to_string();
    assert!(
        error.contains("no formula `g`") && error.contains("did you mean `f`?"),
        "{error}"
    );
}

const SIDE: &str = "
    pub use formulas::*;
    #[symbolic(with(super::conventions))]
    mod formulas {
        /// The height above the ground.
        #[domain(x > 0.0)]
        pub fn height(x: f64, slope: f64) -> f64 { slope * x }
    }";

const TOP: &str = "
    #[symbolic(with(crate::a::side))]
    mod formulas {
        use crate::a::side::*;
        #[generate(value)]
        pub fn above(x: f64, slope: f64) -> f64 { height(x, slope) + 1.0 }
        pub fn lost(x: f64) -> f64 { height(x) }
    }";

#[test]
fn files_are_linked_by_their_paths() {
    let around = r#"#[symbolic(sizes = 1e-3..=1e3, latex(slope = "m"))] mod conventions {}"#;
    let files = [("a.rs", around), ("a/side.rs", SIDE), ("a/top/mod.rs", TOP)];
    let mut system = system(&files).unwrap();
    assert_eq!(system.names(), ["height", "above", "lost"]);
    let above = system.of("above").unwrap();
    let shown = latex_in_full(above, "above").unwrap();
    assert!(shown.contains(r"\mathrm{height}(x, m) &= m x"), "{shown}");
    let code = rust(above, "above").unwrap();
    assert!(code.contains("1 add, 1 mul"), "{code}");
    let error = rust(above, "lost").unwrap_err().to_string();
    assert!(
        error.contains("`height` takes 2 arguments, not 1"),
        "{error}"
    );
    let error = system.of("abov").unwrap_err().to_string();
    assert!(error.contains("did you mean `above`?"), "{error}");
    assert_eq!(system.list()[0].about, "The height above the ground.");
}
