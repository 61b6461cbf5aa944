//! `rotor` and `rotor report`: what is printed, and what is in the folder.

mod common;

use common::{Workplace, cells, rotor_file};

const FIGURES: [&str; 9] = [
    "figure-3", "figure-4", "figure-5", "figure-6", "figure-7", "figure-8", "figure-9", "map-cir",
    "map-sir",
];

/// The last digits of Hill's widths are rounding, and not the same on every machine.
fn without_rounding(text: &str) -> String {
    let shorten = |line: &str| {
        if !line.contains("by Hill's method, Eq. (40)") {
            return line.to_owned();
        }
        line.split(' ')
            .map(|word| {
                if word.starts_with("0.") {
                    &word[..word.len() - 3]
                } else {
                    word
                }
            })
            .collect::<Vec<_>>()
            .join(" ")
    };
    text.lines().map(shorten).collect::<Vec<_>>().join("\n")
}

#[test]
fn without_a_command_it_reports_on_the_papers_rotor() {
    let place = Workplace::new();
    let run = place.run(&[]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    insta::assert_snapshot!(without_rounding(&run.stdout));
    assert!(
        run.stdout.lines().all(|line| line.chars().count() <= 100),
        "100 columns"
    );
    assert!(!run.stdout.contains('\u{1b}'), "no control codes in a pipe");
    assert_eq!(place.names(), ["rotor-report"]);
    let mut expected: Vec<String> = vec!["report.html".to_owned()];
    for figure in FIGURES {
        expected.extend(["csv", "png", "svg"].map(|kind| format!("{figure}.{kind}")));
    }
    expected.sort();
    let folder = place.path("rotor-report");
    let mut names: Vec<_> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, expected);
    for figure in FIGURES {
        assert!(
            std::fs::read(folder.join(format!("{figure}.png")))
                .unwrap()
                .starts_with(b"\x89PNG")
        );
        let svg = std::fs::read_to_string(folder.join(format!("{figure}.svg"))).unwrap();
        assert!(svg.contains("<svg") && svg.trim_end().ends_with("</svg>"));
        assert!(
            cells(&std::fs::read_to_string(folder.join(format!("{figure}.csv"))).unwrap()).len()
                > 10
        );
    }
}

#[test]
fn the_page_needs_nothing_from_outside_and_says_what_the_terminal_says() {
    let place = Workplace::new();
    let run = place.run(&["report", "-o", "deep/down"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let page = place.read("deep/down/report.html");
    assert_eq!(page.matches("<svg").count(), FIGURES.len());
    for outside in ["<script", "<link", "src=", "@import", "url("] {
        assert!(!page.contains(outside), "{outside}");
    }
    // Numbers, and the words of the notes.
    for word in run
        .stdout
        .split_whitespace()
        .filter(|word| word.parse::<f64>().is_ok())
    {
        assert!(page.contains(word), "{word} is only on the terminal");
    }
    assert!(page.contains("crack model support-arm, edge half"));
    assert!(
        page.matches("crack model support-arm").count() > FIGURES.len(),
        "each caption names the model"
    );
}

#[test]
fn numbers_of_the_paper_stand_in_the_report() {
    let run = Workplace::new().run(&["report"]);
    for number in [
        "646.3700572",
        "-0.9102808071",
        "1.551667703",
        "0.7388659083",
        "2.553152221",
        "0.07173310149",
        "0.07171721847",
        "0.1692517111",
        "0.1614596242",
        "0.2316400263",
        "0.2647358801",
    ] {
        assert!(run.stdout.contains(number), "{number}");
    }
}

#[test]
fn a_rotor_without_a_combination_region_is_told_so() {
    let place = Workplace::new().with(
        "a.toml",
        rotor_file("polar_inertia = 0.2096", "polar_inertia = 0.2794"),
    );
    let run = place.run(&["report", "a.toml"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.contains("Rotor: a.toml"));
    assert!(
        run.stdout
            .contains("None: there is no combination instability region at beta = 2"),
        "{}",
        run.stdout
    );
    assert!(!run.stdout.contains("NaN"));
    assert!(
        run.stdout.lines().all(|line| line.chars().count() <= 100),
        "{}",
        run.stdout
    );
}

#[test]
fn a_second_simple_region_is_reported() {
    let place = Workplace::new().with(
        "a.toml",
        rotor_file("polar_inertia = 0.2096", "polar_inertia = 0.07"),
    );
    let run = place.run(&["report", "a.toml"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.contains("second SIR"), "{}", run.stdout);
}

#[test]
fn instability_without_an_upper_end_is_reported() {
    // With |Δ_d| > |β - 1|; only the second of them has a second simple region.
    for inertia in ["0.1397", "0.132715"] {
        let file = rotor_file(
            "polar_inertia = 0.2096",
            &format!("polar_inertia = {inertia}"),
        );
        let run = Workplace::new()
            .with("a.toml", file)
            .run(&["report", "a.toml"]);
        assert_eq!(run.code, 0, "{}", run.stderr);
        let line = run
            .stdout
            .lines()
            .find(|line| line.contains("unstable from Ω = … upwards"))
            .unwrap();
        let speeds: Vec<f64> = line
            .split_whitespace()
            .filter_map(|word| word.parse().ok())
            .collect();
        assert!(
            speeds.len() == 3 && speeds[0] > 2.4 && speeds[0] < 2.8,
            "{line}"
        );
        assert!(!run.stdout.contains("e10"), "{}", run.stdout);
    }
}

#[test]
fn an_end_inside_an_instability_without_upper_end_is_no_boundary() {
    // The combination region leads into the one that has no upper end.
    let file = rotor_file("polar_inertia = 0.2096", "polar_inertia = 0.1397")
        .replace("asymmetry = 0.2", "asymmetry = 0.9");
    let run = Workplace::new()
        .with("a.toml", file)
        .run(&["report", "a.toml"]);
    assert!(run.code == 0, "{}", run.stderr);
    assert!(
        run.stdout
            .contains("Its exact upper end is no boundary of stability"),
        "{}",
        run.stdout
    );
}

#[test]
fn a_closed_region_and_a_doubtful_disk_are_told() {
    let file = rotor_file("asymmetry = 0.2", "asymmetry = 0.9")
        .replace("depth_ratio = 0.2", "depth_ratio = 0");
    let run = Workplace::new()
        .with("a.toml", file)
        .run(&["report", "a.toml"]);
    assert!(
        run.stdout.contains("Warning: disk_asymmetry is 0.9"),
        "{} {}",
        run.stdout,
        run.stderr
    );
    let file = rotor_file("asymmetry = 0.2", "asymmetry = 0")
        .replace("depth_ratio = 0.2", "depth_ratio = 0");
    let run = Workplace::new()
        .with("a.toml", file)
        .run(&["report", "a.toml"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(
        run.stdout.contains("No width by Hill's method: ") && !run.stdout.contains("NaN"),
        "{}",
        run.stdout
    );
}

#[test]
fn the_folder_keeps_other_files_and_appears_only_when_all_is_made() {
    let place = Workplace::new().with("a.toml", "").with("file", "");
    std::fs::create_dir(place.path("out")).unwrap();
    std::fs::write(place.path("out/mine.txt"), "mine").unwrap();
    assert_eq!(place.run(&["report", "a.toml", "-o", "out"]).code, 2);
    assert_eq!(std::fs::read_dir(place.path("out")).unwrap().count(), 1);
    assert_eq!(place.run(&["report", "-o", "out"]).code, 0);
    assert_eq!(place.read("out/mine.txt"), "mine");
    assert!(place.path("out/report.html").is_file());
    let run = place.run(&["report", "-o", "file"]);
    assert!(
        run.code == 2 && run.stderr.contains("`file`: it is not a folder"),
        "{}",
        run.stderr
    );
    assert_eq!(place.names(), ["a.toml", "file", "out"]);
}

#[test]
fn a_report_that_cannot_be_written_still_prints_its_tables_and_leaves_the_folder_as_it_was() {
    let place = Workplace::new();
    std::fs::create_dir_all(place.path("r/report.html")).unwrap();
    std::fs::write(place.path("r/figure-3.csv"), "mine").unwrap();
    let run = place.run(&["report", "-o", "r"]);
    assert_eq!(run.code, 2, "{}", run.stderr);
    assert!(
        run.stdout.contains("Zero unstable points"),
        "{}",
        run.stdout
    );
    assert!(!run.stdout.contains("this report:"), "{}", run.stdout);
    assert!(
        run.stderr.contains("report.html`: it is a folder"),
        "{}",
        run.stderr
    );
    assert_eq!(place.read("r/figure-3.csv"), "mine");
    assert_eq!(std::fs::read_dir(place.path("r")).unwrap().count(), 2);
    assert_eq!(place.names(), ["r"]);
    let place = Workplace::new().with("file", "");
    let run = place.run(&["report", "-o", "file"]);
    assert!(
        run.code == 2 && run.stdout.contains("Zero unstable points"),
        "{}",
        run.stderr
    );
    let run = place.run(&["report", "-o", "-"]);
    assert!(
        run.code == 2 && run.stderr.contains("cannot be standard output"),
        "{}",
        run.stderr
    );
}

#[test]
fn numbers_beyond_double_precision_are_refused_by_the_quantitys_name() {
    let place = Workplace::new().with("a.toml", rotor_file("mass = 10.43", "mass = 1e300"));
    let run = place.run(&["report", "a.toml"]);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{}", run.stderr);
    assert!(run.stderr.contains("double precision"), "{}", run.stderr);
    let run = place.run_on(
        &["evaluate", "-", "-q", "sir_start,sir_width", "-k"],
        b"disk_mass\n1e300\n",
    );
    let row = &cells(&run.stdout)[1];
    assert_eq!((row[1].as_str(), row[2].as_str()), ("", ""), "{row:?}");
    assert!(row[3].contains("double precision"), "{row:?}");
}
