//! Which room of the generator uses which: arrows point one way.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper of a test fails as a test does"
)]

use std::path::Path;

#[path = "../../tests/support/rooms.rs"]
mod rooms;

/// For each room those that it may use. A room stands below all that it uses.
const ALLOWED: [(&str, &[&str]); 25] = [
    ("budget", &[]),
    ("cost", &[]),
    ("diagnostics", &[]),
    ("parallel", &[]),
    ("approximate", &["parallel"]),
    ("graph", &["approximate"]),
    ("fingerprint", &["graph"]),
    ("outputs", &["graph"]),
    ("circuit", &["cost", "graph"]),
    ("interpret", &["approximate", "circuit", "graph"]),
    ("gather", &["fingerprint", "graph", "outputs"]),
    ("rewrite", &["fingerprint", "graph", "outputs"]),
    ("differentiate", &["budget", "graph", "rewrite"]),
    ("symbols", &["diagnostics"]),
    (
        "parse",
        &[
            "cost",
            "diagnostics",
            "differentiate",
            "graph",
            "interpret",
            "symbols",
        ],
    ),
    (
        "tables",
        &["approximate", "diagnostics", "graph", "interpret", "parse"],
    ),
    ("latex", &["parse", "symbols"]),
    (
        "factor",
        &[
            "budget",
            "circuit",
            "differentiate",
            "fingerprint",
            "graph",
            "interpret",
            "outputs",
            "parallel",
            "rewrite",
        ],
    ),
    (
        "stage",
        &["circuit", "cost", "factor", "graph", "outputs", "rewrite"],
    ),
    ("chain", &["diagnostics"]),
    (
        "emit",
        &[
            "approximate",
            "chain",
            "circuit",
            "cost",
            "graph",
            "parse",
            "stage",
        ],
    ),
    ("dot", &["circuit", "emit", "graph"]),
    (
        "expand",
        &[
            "chain",
            "circuit",
            "cost",
            "diagnostics",
            "differentiate",
            "emit",
            "factor",
            "gather",
            "graph",
            "outputs",
            "parse",
            "rewrite",
            "stage",
            "symbols",
            "tables",
        ],
    ),
    ("link", &["diagnostics", "expand", "parse"]),
    (
        "show",
        &[
            "cost",
            "diagnostics",
            "dot",
            "emit",
            "expand",
            "latex",
            "parse",
        ],
    ),
];

#[test]
fn arrows_point_one_way() {
    rooms::check_uses(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &ALLOWED);
}

#[test]
fn a_room_stands_below_what_it_uses() {
    rooms::check_order(&ALLOWED);
}
