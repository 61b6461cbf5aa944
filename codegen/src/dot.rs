//! The operations of a formula as a graph in Graphviz' language.

use std::fmt::Write;

use crate::circuit::{Circuit, Net, Operation};
use crate::emit::namer::table_function;
use crate::graph::{Function, Graph, Rational};

/// The circuit as a directed graph: a box for each input, constant, operation, tabulated function and result, an arrow
/// from each operand to its user. Coefficients and powers stand at the arrows. An operation that the formula's author
/// named has its name above its sign. A constant has a box for each use, so that far ends of the picture stay apart.
///
/// `title` is the graph's name, `results` the names of the circuit's outputs in order. The same circuit gives the same
/// text.
pub fn dot(title: &str, graph: &Graph, circuit: &Circuit, results: &[String]) -> String {
    let mut text = format!("digraph {} {{\n", quoted(title));
    text.push_str("    rankdir = BT;\n    node [shape = box, fontname = \"Helvetica\"];\n    edge [fontname = \"Helvetica\", fontsize = 10];\n");
    for net in circuit.nets() {
        // Constants stand beside their users, unless they are results.
        if circuit.as_number(net).is_some() && !circuit.outputs.contains(&net) {
            continue;
        }
        let (label, style) = node(graph, circuit, net);
        let label = match circuit.suggested_name(net) {
            Some(name) => format!("{name}\n{label}"),
            None => label,
        };
        line(
            &mut text,
            &format!("{} [label = {}{style}]", box_of(net), quoted(&label)),
        );
        for (position, edge) in edges(circuit, net).into_iter().enumerate() {
            let operand = match edge.constant {
                Some(value) => {
                    let name = format!("{}_{position}", box_of(net));
                    line(
                        &mut text,
                        &format!("{name} [label = {}{CONSTANT}]", quoted(&number(&value))),
                    );
                    name
                }
                None => box_of(edge.operand),
            };
            arrow(&mut text, &operand, &box_of(net), &edge.label);
        }
    }
    for (position, (output, name)) in circuit.outputs.iter().zip(results).enumerate() {
        line(
            &mut text,
            &format!(
                "result{position} [label = {}, peripheries = 2]",
                quoted(name)
            ),
        );
        arrow(
            &mut text,
            &box_of(*output),
            &format!("result{position}"),
            "",
        );
    }
    text.push_str("}\n");
    text
}

fn box_of(net: Net) -> String {
    format!("n{}", net.index())
}

fn line(text: &mut String, statement: &str) {
    // Writing to a string never fails.
    let _ = writeln!(text, "    {statement};");
}

fn arrow(text: &mut String, from: &str, to: &str, label: &str) {
    let label = if label.is_empty() {
        String::new()
    } else {
        format!(" [label = {}]", quoted(label))
    };
    line(text, &format!("{from} -> {to}{label}"));
}

/// A string of Graphviz' language; a line break becomes the escape for one.
fn quoted(text: &str) -> String {
    format!(
        "\"{}\"",
        text.replace('\\', "\\\\")
            .replace('"', "\\\"")
            .replace('\n', "\\n")
    )
}

const CONSTANT: &str = ", style = filled, fillcolor = \"#eeeeee\"";

/// What an operation's box says, and how it looks.
fn node(graph: &Graph, circuit: &Circuit, net: Net) -> (String, &'static str) {
    const INPUT: &str = ", style = \"rounded,filled\", fillcolor = \"#dbe9f6\"";
    const TABLE: &str = ", style = filled, fillcolor = \"#fde8c8\"";
    match circuit.operation(net) {
        Operation::Number(value) => (number(value), CONSTANT),
        Operation::Symbol(symbol) => (graph.symbol(*symbol).name.clone(), INPUT),
        Operation::Sum(terms) if terms.len() == 1 => ("scaled".to_owned(), ""),
        Operation::Sum(_) => ("+".to_owned(), ""),
        Operation::Product(_) => ("×".to_owned(), ""),
        Operation::Quotient(..) => ("÷".to_owned(), ""),
        Operation::Apply(function, _) => (sign(*function).to_owned(), ""),
        Operation::Tabulated { table, order, .. } => (table_function(graph, *table, *order), TABLE),
    }
}

fn sign(function: Function) -> &'static str {
    match function {
        Function::Sqrt => "√",
        Function::Abs => "|·|",
        Function::Sign => "sign",
        Function::Select => "a = b ? x : y",
        Function::Less => "a < b ? x : y",
        Function::AtMost => "a ≤ b ? x : y",
        Function::MulAdd => "a·b + c",
        other => other.row().method,
    }
}

/// An arrow from an operand: what it says, and the operand's value where that is a constant.
struct Edge {
    operand: Net,
    label: String,
    constant: Option<Rational>,
}

fn edges(circuit: &Circuit, net: Net) -> Vec<Edge> {
    let edge = |operand: Net, label: &str| Edge {
        operand,
        label: label.to_owned(),
        constant: circuit.as_number(operand).cloned(),
    };
    match circuit.operation(net) {
        Operation::Sum(terms) => terms
            .iter()
            .map(|(operand, coefficient)| match circuit.as_number(*operand) {
                Some(value) => Edge {
                    operand: *operand,
                    label: String::new(),
                    constant: Some(value * coefficient),
                },
                None => edge(*operand, &scale(coefficient)),
            })
            .collect(),
        Operation::Product(factors) => factors
            .iter()
            .map(|(operand, power)| {
                edge(
                    *operand,
                    &if *power == 1 {
                        String::new()
                    } else {
                        format!("power {power}")
                    },
                )
            })
            .collect(),
        Operation::Quotient(numerator, denominator) => {
            vec![edge(*numerator, "over"), edge(*denominator, "under")]
        }
        Operation::Apply(function, operands) if function.is_selection() => operands
            .iter()
            .zip(["a", "b", "x", "y"])
            .map(|(operand, label)| edge(*operand, label))
            .collect(),
        _ => circuit
            .operands(net)
            .into_iter()
            .map(|operand| edge(operand, ""))
            .collect(),
    }
}

/// `−`, `2·`, nothing for 1.
fn scale(coefficient: &Rational) -> String {
    match coefficient.is_unit() {
        true if coefficient.is_negative() => "−".to_owned(),
        true => String::new(),
        false => format!("{}·", number(coefficient)),
    }
}

fn number(value: &Rational) -> String {
    if value.is_integer() {
        return value.to_string();
    }
    value
        .to_f64()
        .map_or_else(|| value.to_string(), |value| value.to_string())
}

#[cfg(test)]
mod tests {
    use crate::show;

    #[test]
    fn a_formula_as_a_graph() {
        let source = "#[symbolic(sizes = 1e-9..=1e9)] mod m { #[domain(x >= 0.0)] pub fn f(x: f64, y: f64) -> f64 { let r = x - 2.0 * y + 3.0; (r * r * x).sqrt() / y } }";
        let mut expansion = show::module(source).unwrap();
        let expected = [
            "digraph \"f\" {",
            "label = \"x\", style = \"rounded,filled\"",
            "label = \"r\\n+\"",
            "[label = \"-2·\"]",
            "[label = \"3\", style = filled",
            "label = \"÷\"",
            "[label = \"under\"]",
            "result0 [label = \"f\", peripheries = 2]",
        ];
        let text = show::graph(&mut expansion, "f").unwrap();
        for part in expected {
            assert!(text.contains(part), "no {part} in {text}");
        }
        assert_eq!(
            text,
            show::graph(&mut show::module(source).unwrap(), "f").unwrap()
        );
    }
}
