//! x
#[test]
fn expands() {
    let source = include_str!("formulas/determinant.rs");
    let out = codegen::expand(source.parse().unwrap());
    println!("{}", codegen::emit::format(out).unwrap());
}
