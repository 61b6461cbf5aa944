//! The drawing in ARCHITECTURE.md stays true: which room of the library uses which.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper of a test fails as a test does"
)]

use std::path::Path;

#[path = "../../tests/support/rooms.rs"]
mod rooms;

/// For each room those that it may use. Arrows point one way: a room stands below all that it uses.
const ALLOWED: [(&str, &[&str]); 16] = [
    ("unit", &[]),
    ("text", &[]),
    ("region", &[]),
    ("input", &["text", "unit"]),
    ("error", &["input", "region", "text"]),
    ("warning", &["input", "text"]),
    ("equations", &["input"]),
    ("periodic", &["error"]),
    (
        "jeffcott",
        &["equations", "error", "input", "region", "warning"],
    ),
    ("model", &["equations", "error", "jeffcott", "periodic"]),
    (
        "quantity",
        &["equations", "error", "input", "jeffcott", "unit"],
    ),
    (
        "batch",
        &["equations", "error", "input", "jeffcott", "quantity"],
    ),
    (
        "study",
        &["batch", "error", "input", "jeffcott", "quantity"],
    ),
    ("reason", &["equations", "error", "jeffcott"]),
    ("file", &["error", "input", "jeffcott", "text"]),
    ("corrections", &[]),
];

#[test]
fn arrows_point_one_way() {
    rooms::check_uses(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &ALLOWED);
}

#[test]
fn a_room_stands_below_what_it_uses() {
    rooms::check_order(&ALLOWED);
}
