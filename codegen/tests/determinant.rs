//! The determinant of a symmetric 4×4 matrix with its ten partials.
use codegen::{differentiate, factor, parse, rewrite, tables::Tables, diagnostics::Diagnostics};
#[test]
fn few_operations() {
    let source = include_str!("formulas/determinant.rs");
    let item: syn::ItemMod = syn::parse_str(source).unwrap();
    let mut d = Diagnostics::default();
    let module = parse::module::Module::read(item, &mut d);
    for m in d.iter() { println!("{}", m.text()); }
    let mut tables = Tables::default();
    let mut reader = parse::body::Reader::new(&module, &mut tables);
    let value = reader.read(module.function("determinant").unwrap());
    for m in reader.diagnostics.iter() { println!("{}", m.text()); }
    let parse::value::Value::Number(value) = value.unwrap() else { panic!() };
    let (mut graph, roots) = rewrite::rewrite(&reader.graph, &[value]);
    let by: Vec<_> = graph.symbols_of(&roots).into_iter().collect();
    let gradient = differentiate::gradient(&mut graph, roots[0], &by);
    let outputs = factor::Outputs { values: roots, by, gradients: vec![gradient], hessians: vec![] };
    let circuit = factor::minimise(&graph, &outputs);
    println!("{}", circuit.cost());
    assert!(circuit.cost().operations() <= 96);
}
