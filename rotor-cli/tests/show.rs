//! `rotor show`: every equation in every form, and the list.

mod common;

use common::Workplace;

/// The names in the list of all equations.
fn names(list: &str) -> Vec<&str> {
    list.lines()
        .filter(|line| !line.starts_with(' '))
        .filter_map(|line| line.split_whitespace().next())
        .collect()
}

#[test]
fn the_list_names_every_equation_once() {
    let run = Workplace::new().run(&["show"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(
        run.stdout.lines().all(|line| line.chars().count() <= 100),
        "{}",
        run.stdout
    );
    let mut names = names(&run.stdout);
    let count = names.len();
    assert!(
        names.contains(&"sir_width") && names.contains(&"phi_on_sir"),
        "{names:?}"
    );
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count);
}

#[test]
fn every_equation_has_its_latex() {
    let list = Workplace::new().run(&["show"]).stdout;
    for name in names(&list) {
        let run = Workplace::new().run(&["show", name, "--latex"]);
        assert_eq!(run.code, 0, "{name}: {}", run.stderr);
        assert!(run.stdout.contains('='), "{name}: {}", run.stdout);
    }
}

#[test]
fn an_equation_in_each_form() {
    let run = Workplace::new().run(&["show", "f_n", "--latex"]);
    assert_eq!(
        run.stdout,
        "f_n(\\omega, \\Omega) = H(\\omega) G(\\omega, \\Omega) - \\gamma^2\n"
    );
    let run = Workplace::new().run(&["show", "f_n", "--graph"]);
    assert!(
        run.stdout.starts_with("digraph \"f_n\" {") && run.stdout.ends_with("}\n"),
        "{}",
        run.stdout
    );
    for arguments in [vec!["show", "f_n"], vec!["show", "f_n", "--rust"]] {
        let run = Workplace::new().run(&arguments);
        assert!(
            run.stdout.contains("pub fn hessian(") && run.stdout.contains("Operations: "),
            "{}",
            run.stdout
        );
    }
}

#[test]
fn an_unknown_equation_ends_with_2_and_the_nearest_name() {
    for form in ["--rust", "--latex", "--graph"] {
        let run = Workplace::new().run(&["show", "sir_widht", form]);
        assert_eq!(run.code, 2);
        assert!(run.stdout.is_empty());
        assert!(
            run.stderr.contains("did you mean `sir_width`?"),
            "{}",
            run.stderr
        );
    }
}
