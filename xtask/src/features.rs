//! `cargo xtask features` and `cargo xtask portable`: `rotor-core` with other features than the workspace builds it with.
//!
//! The workspace's build has its features `rayon` and `toml` on, so that neither the code for one thread nor the
//! serialisation of rotors is compiled by `cargo test --workspace`.

use std::path::Path;

use crate::Outcome;
use crate::cargo::{cargo, run};

/// The tests of scans, which run on the calling thread where the feature `rayon` is off.
const ON_ONE_THREAD: [&str; 2] = ["scan", "scan_reductions"];

/// The tests of what the feature `serde` adds.
const SERIALISATION: &str = "serialisation";

/// Tests the crate without features and with all of them.
pub(crate) fn check(root: &Path) -> Outcome {
    let package = ["--package", "rotor-core"];
    run(cargo(root, &["check", "--tests", "--no-default-features"]).args(package))?;
    let mut scans = cargo(root, &["test", "--no-default-features"]);
    for test in ON_ONE_THREAD {
        scans.args(["--test", test]);
    }
    run(scans.args(package))?;
    run(cargo(root, &["test", "--all-features", "--test", SERIALISATION]).args(package))
}

/// Builds the crate for a processor without threads and files, as web pages have it.
pub(crate) fn wasm(root: &Path) -> Outcome {
    let target = ["--target", crate::tools::WASM_TARGET];
    run(cargo(
        root,
        &[
            "build",
            "--package",
            "rotor-core",
            "--lib",
            "--no-default-features",
        ],
    )
    .args(target))
}
