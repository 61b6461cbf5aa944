//! Help, its examples, exit codes and pipes.

mod common;

use std::process::{Command, Stdio};

use common::Workplace;

const COMMANDS: [&str; 6] = ["report", "evaluate", "scan", "zup", "init", "show"];

/// The examples of a help text, as a shell takes them.
fn examples(help: &str) -> Vec<String> {
    help.lines()
        .filter_map(|line| line.trim_start().strip_prefix("$ "))
        .map(str::to_owned)
        .collect()
}

#[test]
fn every_example_of_every_help_works() {
    let mut all = examples(&Workplace::new().run(&["--help"]).stdout);
    assert!(!all.is_empty());
    for command in COMMANDS {
        let help = Workplace::new().run(&[command, "--help"]);
        assert_eq!(help.code, 0);
        assert!(
            help.stdout.lines().all(|line| line.chars().count() <= 100),
            "{}",
            help.stdout
        );
        let examples = examples(&help.stdout);
        assert!(!examples.is_empty(), "{command} has no example");
        all.extend(examples);
    }
    let folder = std::path::Path::new(env!("CARGO_BIN_EXE_rotor"))
        .parent()
        .unwrap();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths(
        [folder.to_owned()]
            .into_iter()
            .chain(std::env::split_paths(&path)),
    )
    .unwrap();
    for example in all {
        let place = Workplace::new();
        // A second time, too: the files of the first are there then. Drawing all figures again would show nothing new.
        let draws = example == "rotor" || example.contains("rotor report");
        for time in 0..if draws { 1 } else { 2 } {
            let output = Command::new("sh")
                .args(["-c", &example])
                .env("PATH", &path)
                .current_dir(place.folder())
                .output()
                .unwrap();
            let stderr = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{example}, {time}: {stderr}");
        }
    }
}

#[test]
fn a_wrong_command_line_ends_with_2() {
    for arguments in [
        vec!["reprot"],
        vec!["evaluate"],
        vec!["zup", "--bogus"],
        vec!["show", "phi", "--rust", "--latex"],
    ] {
        let run = Workplace::new().run(&arguments);
        assert_eq!(run.code, 2, "{arguments:?}");
        assert!(
            run.stdout.is_empty() && run.stderr.contains("error"),
            "{}",
            run.stderr
        );
    }
}

#[test]
fn missing_files_end_with_2() {
    for arguments in [["zup", "none.toml"], ["report", "none.toml"]] {
        let place = Workplace::new();
        let run = place.run(&arguments);
        assert!(
            run.code == 2 && run.stderr.contains("cannot read `none.toml`"),
            "{}",
            run.stderr
        );
        assert!(place.names().is_empty());
    }
}

#[test]
fn help_is_a_command_too() {
    let run = Workplace::new().run(&["help", "zup"]);
    assert!(
        run.code == 0 && run.stdout.contains("$ rotor zup"),
        "{}",
        run.stderr
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_ends_with_2_and_its_name() {
    for arguments in [vec!["--help"], vec!["--version"], vec!["zup"], vec!["show"]] {
        let full = std::fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_rotor"))
            .args(&arguments)
            .stdout(full)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
    let place = Workplace::new().with("t.csv", "crack_angle\n0\n");
    let run = place.run(&["evaluate", "t.csv", "-o", "/dev/full"]);
    assert!(
        run.code == 2 && run.stderr.contains("`/dev/full`"),
        "{}",
        run.stderr
    );
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_nothing_and_ends_as_a_shell_expects() {
    for (signal, code) in [("INT", 130), ("TERM", 143)] {
        let place = Workplace::new();
        let mut child = Command::new(env!("CARGO_BIN_EXE_rotor"))
            .args(["evaluate", "-", "-o", "out.csv"])
            .current_dir(place.folder())
            .stdin(Stdio::piped())
            .spawn()
            .unwrap();
        // The part of a file is there once the header has been read; the rest of the table never comes.
        let mut table = child.stdin.take().unwrap();
        std::io::Write::write_all(&mut table, b"crack_angle\n0\n").unwrap();
        while place.names().is_empty() {
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
        let id = child.id().to_string();
        let killed = Command::new("kill")
            .args(["-s", signal, &id])
            .status()
            .unwrap();
        assert!(killed.success());
        assert_eq!(child.wait().unwrap().code(), Some(code));
        drop(table);
        assert_eq!(place.names(), Vec::<String>::new());
    }
}

#[test]
fn zup_has_the_upper_simple_region_where_the_rotor_has_it() {
    let file = common::rotor_file("0.2096", "0.1");
    let run = Workplace::new()
        .with("a.toml", file)
        .run(&["zup", "a.toml"]);
    assert!(run.stdout.contains("upper SIR"), "{}", run.stdout);
    assert!(!Workplace::new().run(&["zup"]).stdout.contains("upper SIR"));
}

#[test]
fn a_closed_pipe_is_quiet() {
    let place = Workplace::new();
    let rows: String = (0..20_000).map(|row| format!("{row}\n")).collect();
    let place = place.with("t.csv", format!("crack_angle\n{rows}"));
    for arguments in [
        vec!["evaluate", "t.csv", "-q", "sir_width"],
        vec!["zup"],
        vec!["init", "-o", "-"],
    ] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_rotor"))
            .args(&arguments)
            .current_dir(place.folder())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{arguments:?}");
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
    }
}

#[test]
fn zup_says_once_that_nothing_excites_the_rotor() {
    let file = common::rotor_file("asymmetry = 0.2", "asymmetry = 0")
        .replace("depth_ratio = 0.2", "depth_ratio = 0");
    let run = Workplace::new()
        .with("a.toml", file)
        .run(&["zup", "a.toml"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert_eq!(
        run.stdout.matches("every position").count(),
        2,
        "{}",
        run.stdout
    );
    assert!(run.stdout.lines().count() < 16, "{}", run.stdout);
}

#[test]
fn zup_warns_and_tells_uncoupled_motions() {
    let file = common::rotor_file("asymmetry = 0.2", "asymmetry = 0.8")
        .replace("position_ratio = 0.25", "position_ratio = 0.5")
        .replace("depth_ratio = 0.2", "depth_ratio = 0");
    let run = Workplace::new()
        .with("a.toml", file)
        .run(&["zup", "a.toml"]);
    assert_eq!(run.code, 0);
    assert!(
        run.stderr.starts_with("warning: disk_asymmetry is 0.8"),
        "{}",
        run.stderr
    );
    assert!(
        run.stdout.contains("uncoupled") && !run.stdout.contains("NaN"),
        "{}",
        run.stdout
    );
}

#[test]
fn zup_says_none_in_range() {
    let file =
        common::rotor_file("asymmetry = 0.2", "asymmetry = 0.99").replace("0.2096", "0.2794");
    let run = Workplace::new()
        .with("a.toml", file)
        .run(&["zup", "a.toml"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.contains("none in range"), "{}", run.stdout);
    assert!(
        run.stdout
            .contains("there is no combination instability region"),
        "{}",
        run.stdout
    );
    assert!(
        run.stdout.lines().all(|line| line.chars().count() <= 100),
        "{}",
        run.stdout
    );
}
