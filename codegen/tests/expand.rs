//! x
#[test]
fn expands() {
    let source = include_str!("../../rotor-core/src/equations.rs");
    let t=std::time::Instant::now();
    let mut e = codegen::show::module(source).unwrap();
    for d in e.diagnostics.iter() { println!("{}", d.text()); }
    println!("read {:?}", t.elapsed());
    for n in ["phi","phi_on_sir","sir_width","cir_width","stiffness","widths_support_arm"] {
        let t=std::time::Instant::now();
        for f in codegen::show::forms(&mut e, n).unwrap() { println!("{n} {:?} {} nodes {}", f.form, f.circuit.cost(), f.graph.len()); }
        println!("{:?}", t.elapsed());
    }
    for n in ["sir_width","cir_width","stiffness"] { println!("{}", codegen::show::rust(&mut e, n).unwrap()); }
}
