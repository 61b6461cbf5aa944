//! The command `rotor`: reports, tables and zero unstable points of asymmetric cracked rotors.

use std::process::ExitCode;

mod command_line;
mod commands;
mod doubts;
mod evaluate;
mod failure;
mod files;
mod init;
mod interrupt;
mod nearest;
mod output;
mod reasons;
mod report;
mod rotor_file;
mod scan;
mod show;
mod shown;
mod table;
mod zup;

fn main() -> ExitCode {
    commands::run()
}
