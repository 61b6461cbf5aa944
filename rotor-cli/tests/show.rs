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
        let wide = |line: &&str| line.chars().count() > 100;
        assert_eq!(run.stdout.lines().find(wide), None, "{name}");
        for environment in ["\\begin{aligned}", "\\end{aligned}"] {
            assert!(run.stdout.matches(environment).count() <= 1, "{name}");
        }
    }
    assert!(!list.contains('$') && list.contains("ω_1"), "{list}");
}

#[test]
fn a_formula_comes_with_the_formulas_that_it_calls() {
    let text = Workplace::new()
        .run(&["show", "sir_width", "--latex"])
        .stdout;
    insta::assert_snapshot!("sir_width_latex", text);
    let phi = Workplace::new().run(&["show", "phi", "--latex"]).stdout;
    assert!(
        !phi.contains("gamma_2") && phi.contains(r"\gamma^2"),
        "{phi}"
    );
    let coefficients = Workplace::new()
        .run(&["show", "coefficients", "--latex"])
        .stdout;
    assert!(
        !coefficients.contains(r"\Delta_d &= \Delta_d"),
        "{coefficients}"
    );
}

#[test]
fn no_line_of_the_generated_code_is_too_wide() {
    for name in ["sir_width", "cir_width", "phi"] {
        let code = Workplace::new().run(&["show", name]).stdout;
        let wide = |line: &&str| line.chars().count() > 100;
        assert_eq!(code.lines().find(wide), None, "{name}");
    }
}

#[test]
fn results_lead_to_the_formula_that_gives_them() {
    for (name, formula) in [
        ("beta", "coefficients"),
        ("epsilon_1", "coefficients"),
        ("c44", "crack_compliance"),
        ("GAMMA", "coefficients"),
    ] {
        let run = Workplace::new().run(&["show", name, "--latex"]);
        assert_eq!(run.code, 0, "{}", run.stderr);
        assert!(
            run.stderr.contains(&format!("results of `{formula}`")),
            "{}",
            run.stderr
        );
        let direct = Workplace::new().run(&["show", formula, "--latex"]);
        assert_eq!(run.stdout, direct.stdout);
    }
    let run = Workplace::new().run(&["show", "sir_exact_lower"]);
    assert!(
        run.code == 2 && run.stderr.contains("no closed form"),
        "{}",
        run.stderr
    );
    let run = Workplace::new().run(&["show", "--latex"]);
    assert!(
        run.code == 2 && run.stderr.contains("NAME"),
        "{}",
        run.stderr
    );
}

#[test]
fn an_equation_in_each_form() {
    let run = Workplace::new().run(&["show", "transverse", "--latex"]);
    assert_eq!(run.stdout, "H(\\omega) = 1 - \\omega^2\n");
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
