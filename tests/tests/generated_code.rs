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
    let mut system = show::system(&equations::SOURCES).unwrap();
    let counts: String = ["phi", "phi_on_sir", "sir_width", "cir_width"]
        .into_iter()
        .flat_map(|name| {
            show::forms(system.of(name).unwrap(), name)
                .unwrap()
                .into_iter()
                .map(move |form| (name, form))
        })
        .map(|(name, form)| format!("{name}::{}: {}\n", form.form.name(), form.circuit.cost()))
        .collect();
    assert_eq!(
        counts,
        "\
phi::value: 28 add, 41 mul, 0 div, 0 sqrt, 1 call
phi::gradient: 53 add, 78 mul, 0 div, 0 sqrt, 1 call
phi::hessian: 132 add, 178 mul, 0 div, 0 sqrt, 1 call
phi_on_sir::value: 20 add, 31 mul, 0 div, 0 sqrt, 1 call
phi_on_sir::gradient: 33 add, 53 mul, 0 div, 0 sqrt, 1 call
sir_width::value: 21 add, 27 mul, 3 div, 2 sqrt, 2 call
sir_width::gradient: 53 add, 85 mul, 6 div, 3 sqrt, 2 call
cir_width::value: 37 add, 57 mul, 2 div, 4 sqrt, 2 call
cir_width::gradient: 108 add, 188 mul, 9 div, 4 sqrt, 2 call
"
    );
}

/// Functions whose gradients by all inputs take long to make; two of them stand for all.
const LONG: [&str; 3] = [
    "widths_midspan_arm",
    "widths_simply_supported_left",
    "widths_simply_supported_right",
];

#[test]
fn it_is_formatted_as_rustfmt_does() {
    let mut system = show::system(&equations::SOURCES).unwrap();
    let names: Vec<String> = system
        .names()
        .into_iter()
        .filter(|name| !LONG.contains(&name.as_str()))
        .collect();
    let mut shown = 0;
    for name in names {
        // What holds an integral has no code.
        let Ok(text) = show::rust(system.of(&name).unwrap(), &name) else {
            continue;
        };
        shown += 1;
        let formatted = rustfmt(&text);
        assert!(
            text == formatted,
            "rustfmt would change\n{text}to\n{formatted}"
        );
    }
    assert!(shown > 40, "{shown} functions");
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
