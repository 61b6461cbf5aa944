//! Rotor files: what `rotor init` writes, and how mistakes are shown.

mod common;

use common::{Workplace, rotor_file};

/// The message for a file that must be refused.
fn refused(content: impl AsRef<[u8]>) -> String {
    let run = Workplace::new()
        .with("shaft.toml", content)
        .run(&["zup", "shaft.toml"]);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""));
    assert!(!run.stderr.contains('\u{1b}'), "no control codes in a pipe");
    run.stderr
}

#[test]
fn the_file_of_init_is_the_papers_rotor() {
    let place = Workplace::new();
    let run = place.run(&["init"]);
    assert_eq!((run.code, run.stdout.as_str()), (0, "wrote rotor.toml\n"));
    insta::assert_snapshot!(place.read("rotor.toml"));
    let of_file = place.run(&["zup", "rotor.toml"]).stdout;
    let of_paper = place.run(&["zup"]).stdout;
    assert_eq!(of_file.replace("rotor.toml", "the paper's rotor"), of_paper);
}

#[test]
fn init_writes_over_a_file_only_when_told_to() {
    let place = Workplace::new().with("rotor.toml", "mine");
    let run = place.run(&["init"]);
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("`rotor.toml` exists already") && run.stderr.contains("--force"));
    assert_eq!(place.read("rotor.toml"), "mine");
    assert_eq!(place.run(&["init", "--force"]).code, 0);
    assert!(place.read("rotor.toml").contains("[disk]"));
}

#[test]
fn integers_are_numbers_and_choices_may_be_left_out() {
    let file = rotor_file("mass = 10.43", "mass = 1_0")
        .replace("model =", "# model")
        .replace("edge =", "# edge");
    let run = Workplace::new()
        .with("a.toml", &file)
        .run(&["zup", "a.toml"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.contains("crack model support-arm, edge half"));
    let dotted = file
        .replace("[disk]\n", "")
        .replace("mass = 1_0", "disk.mass = 10");
    assert!(
        refused(dotted).contains("diametral_inertia"),
        "keys without their section are unknown"
    );
}

#[test]
fn mistakes_are_shown_at_their_lines() {
    insta::assert_snapshot!(
        "misspelt_key",
        refused(rotor_file("mass = 10.43", "mas = 10.43"))
    );
    insta::assert_snapshot!(
        "not_allowed",
        refused(rotor_file("depth_ratio = 0.2", "depth_ratio = 1.5"))
    );
    insta::assert_snapshot!(
        "text_for_a_number",
        refused(rotor_file("length = 0.5045", "length = \"0.5045\""))
    );
    insta::assert_snapshot!(
        "unknown_model",
        refused(rotor_file("\"support-arm\"", "\"suport-arm\""))
    );
    insta::assert_snapshot!(
        "too_much_polar_inertia",
        refused(rotor_file("0.2096", "0.5"))
    );
    insta::assert_snapshot!(
        "no_toml",
        refused(rotor_file("mass = 10.43", "mass = 10.43 kg"))
    );
    insta::assert_snapshot!("empty", refused(""));
}

#[test]
fn the_right_place_of_a_key_is_told() {
    let cases = [
        (
            ("[disk]", "disk_mass = 1\n[disk]"),
            "write `mass` under `[disk]`",
        ),
        (("[shaft]", "[Shaft]"), "did you mean `shaft`?"),
        (
            ("mass = 10.43", "radius = 1\nmass = 10.43"),
            "`radius` belongs under `[shaft]`",
        ),
        (
            ("mass = 10.43", "mass = nan"),
            "disk_mass is NaN kg; it must be finite and > 0",
        ),
        (
            ("mass = 10.43", "mass = 1e400"),
            "disk_mass is inf kg; it must be finite and > 0",
        ),
        (
            ("angle = 0.0", "angle = inf"),
            "crack_angle is inf rad; it must be finite",
        ),
        (("mass = 10.43", "mass = true"), "of type boolean"),
        (("mass = 10.43", "mass = 1\nmass = 2"), "duplicate key"),
        (("model = \"support-arm\"", "model = 1"), "a text in quotes"),
        (("[disk]", "[[disk]]"), "is not a section"),
    ];
    for ((from, to), expected) in cases {
        let message = refused(rotor_file(from, to));
        assert!(message.contains(expected), "{to}: {message}");
        assert!(message.contains("--> shaft.toml:"), "{message}");
    }
}

#[test]
fn of_very_many_mistakes_the_first_are_told() {
    let lines: String = (0..50).map(|index| format!("x{index} = 1\n")).collect();
    let message = refused(lines);
    assert_eq!(message.matches("error: ").count(), 20, "{message}");
    assert!(message.contains("and 31 more in shaft.toml"), "{message}");
}

#[test]
fn all_mistakes_are_told_at_once() {
    let message = refused(
        rotor_file("mass = 10.43", "mass = 0").replace("asymmetry = 0.2", "asymetry = 0.2"),
    );
    assert!(
        message.contains("disk_mass is 0 kg") && message.contains("`asymetry`"),
        "{message}"
    );
    assert!(
        !message.contains("is missing"),
        "a misspelt key is one mistake: {message}"
    );
}

#[test]
fn the_key_that_was_meant_is_found() {
    let cases = [
        (
            "depth_ratio = 0.2",
            "depth = 0.2",
            "did you mean `depth_ratio`?",
        ),
        ("length =", "len =", "did you mean `length`?"),
        ("youngs_modulus =", "E =", "did you mean `youngs_modulus`?"),
        ("\nradius =", "\nradius_mm =", "did you mean `radius`?"),
        ("[shaft]", "m_d = 1\n[shaft]", "did you mean `mass`?"),
    ];
    for (from, to, expected) in cases {
        let message = refused(rotor_file(from, to));
        assert!(message.contains(expected), "{to}: {message}");
        assert_eq!(message.matches("error: ").count(), 1, "{message}");
    }
}

#[test]
fn a_section_without_its_header_is_one_mistake() {
    for section in ["disk", "shaft", "crack"] {
        let message = refused(rotor_file(&format!("[{section}]\n"), ""));
        assert_eq!(message.matches("error: ").count(), 1, "{message}");
        assert!(
            message.contains(&format!("the header `[{section}]` is missing")),
            "{message}"
        );
    }
    insta::assert_snapshot!("no_header", refused(rotor_file("[shaft]\n", "")));
    insta::assert_snapshot!(
        "missing_keys",
        refused(rotor_file("\nlength", "\n# length").replace("\nradius", "\n# radius"))
    );
}

#[test]
fn no_line_is_too_wide_and_no_control_code_is_shown() {
    let long = "x".repeat(300);
    let files = [
        rotor_file("mass = 10.43", &format!("mass = -1 # {long}")),
        rotor_file("mass = 10.43", &format!("{long} = -1")),
        rotor_file("\"support-arm\"", &format!("\"{long}\"")),
        rotor_file("0.2096", "0.5"),
        rotor_file("mass = 10.43", "\"\\u001b[31m\" = 1"),
        String::new(),
    ];
    for file in files {
        let message = refused(&file);
        assert!(
            message.lines().all(|line| line.chars().count() <= 100),
            "{message}"
        );
    }
    let name = format!("{}\u{1b}.toml", "n".repeat(150));
    let run = Workplace::new()
        .with(&name, rotor_file("mass = 10.43", "mass = 10"))
        .run(&["zup", &name]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(!run.stdout.contains('\u{1b}'));
    assert!(
        run.stdout.lines().all(|line| line.chars().count() <= 100),
        "{}",
        run.stdout
    );
}

#[test]
fn what_is_far_too_long_is_no_rotor_file() {
    assert!(refused("# x\n".repeat(300_000)).contains("no rotor file"));
}

#[test]
fn files_in_other_encodings() {
    assert!(refused(b"\xff\xfe[\0").contains("UTF-16"));
    assert!(refused(b"[disk]\n# caf\xe9\n").contains("line 2"));
    let marked = [
        b"\xef\xbb\xbf".as_slice(),
        rotor_file("mass = 10.43", "mass = 0").as_bytes(),
    ]
    .concat();
    assert!(
        refused(&marked).contains("shaft.toml:5:"),
        "{}",
        refused(&marked)
    );
    let windows = rotor_file("mass = 10.43", "mass = 10.5").replace('\n', "\r\n");
    assert_eq!(
        Workplace::new()
            .with("a.toml", windows)
            .run(&["zup", "a.toml"])
            .code,
        0
    );
}
