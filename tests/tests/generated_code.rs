//! The code that is generated from the paper's equations: how many operations, and how it is written.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test fails by panicking"
)]

use codegen::show;
use rotor_core::equations;

#[test]
fn the_main_formulas_take_as_many_operations_as_ever() {
    let mut expansion = show::module(equations::SOURCE).unwrap();
    let counts: String = ["phi", "phi_on_sir", "sir_width", "cir_width"]
        .into_iter()
        .flat_map(|name| {
            show::forms(&mut expansion, name)
                .unwrap()
                .into_iter()
                .map(move |form| (name, form))
        })
        .map(|(name, form)| format!("{name}::{}: {}\n", form.form.name(), form.circuit.cost()))
        .collect();
    assert_eq!(
        counts,
        "\
phi::value: 27 add, 40 mul, 0 div, 0 sqrt, 1 call
phi::gradient: 52 add, 78 mul, 0 div, 0 sqrt, 1 call
phi::hessian: 131 add, 181 mul, 0 div, 0 sqrt, 1 call
phi_on_sir::value: 19 add, 30 mul, 0 div, 0 sqrt, 1 call
phi_on_sir::gradient: 32 add, 52 mul, 0 div, 0 sqrt, 1 call
sir_width::value: 21 add, 24 mul, 3 div, 2 sqrt, 2 call
sir_width::gradient: 52 add, 89 mul, 7 div, 3 sqrt, 2 call
cir_width::value: 38 add, 61 mul, 2 div, 4 sqrt, 2 call
cir_width::gradient: 113 add, 212 mul, 7 div, 4 sqrt, 2 call
"
    );
}

#[test]
fn it_is_formatted_as_rustfmt_does() {
    let mut module = show::module(equations::SOURCE).unwrap();
    for name in ["f_n", "phi", "phi_on_sir", "sir_width", "cir_width"] {
        let text = show::rust(&mut module, name).unwrap();
        let formatted = rustfmt(&text);
        assert!(
            text == formatted,
            "rustfmt would change\n{text}to\n{formatted}"
        );
    }
}

/// The text as rustfmt writes it.
fn rustfmt(text: &str) -> String {
    use std::io::Write;
    use std::process::{Command, Stdio};
    let mut process = Command::new("rustfmt")
        .args(["--edition", "2024"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("rustfmt is a part of the toolchain");
    process
        .stdin
        .take()
        .unwrap()
        .write_all(text.as_bytes())
        .unwrap();
    let output = process.wait_with_output().unwrap();
    assert!(output.status.success());
    String::from_utf8(output.stdout).unwrap()
}
