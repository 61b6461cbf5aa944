//! The command `rotor`: reports, tables and zero unstable points of asymmetric cracked rotors.

use std::process::ExitCode;

mod command_line;
mod commands;
mod evaluate;
mod failure;
mod files;
mod init;
mod interrupt;
mod output;
mod report;
mod rotor_file;
mod scan;
mod show;
mod table;
mod zup;

fn main() -> ExitCode {
    commands::run()
}
