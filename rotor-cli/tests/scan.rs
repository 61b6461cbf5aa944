//! `rotor scan` on good and on bad input, interrupted and resumed.

mod common;

use common::{Run, Workplace, cells, rotor_file};

fn scan(arguments: &str) -> Run {
    Workplace::new().run(&words(arguments))
}

fn words(arguments: &str) -> Vec<&str> {
    std::iter::once("scan")
        .chain(arguments.split_whitespace())
        .collect()
}

/// A command line that must be refused, with no file left: the message in one line.
fn refused(arguments: &str) -> String {
    let place = Workplace::new().with("table.csv", "phi,crack.angle\n0,1\n90deg,x\n");
    let run = place.run(&words(arguments));
    assert_eq!(
        (run.code, run.stdout.as_str()),
        (2, ""),
        "{arguments}: {}",
        run.stderr
    );
    assert_eq!(place.names(), ["table.csv"], "{arguments}");
    run.stderr.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn a_grid_is_a_row_for_each_point_and_reads_back_exactly() {
    let run = scan(
        "--vary crack.depth_ratio=0.1,20% --vary crack.angle=0deg:180deg:3 --quantity sir_width",
    );
    assert_eq!(run.code, 0, "{}", run.stderr);
    let table = cells(&run.stdout);
    assert_eq!(table[0], ["crack_depth_ratio", "crack_angle", "sir_width"]);
    let places: Vec<_> = table[1..]
        .iter()
        .map(|row| (row[0].as_str(), row[1].as_str()))
        .collect();
    let (half, whole) = ("1.5707963267948966", "3.141592653589793");
    let expected = [
        ("0.1", "0.0"),
        ("0.1", half),
        ("0.1", whole),
        ("0.2", "0.0"),
        ("0.2", half),
        ("0.2", whole),
    ];
    assert_eq!(places, expected);
    let width: f64 = table[4][2].parse().unwrap();
    assert!((width - 0.0717331014860298).abs() < 1e-13);
    assert!(run.stderr.starts_with("6 points in "), "{}", run.stderr);
    assert!(run.stderr.contains("points/s"), "{}", run.stderr);
}

#[test]
fn what_does_not_exist_is_empty_and_counted() {
    let arguments = "--vary disk.polar_inertia=0.2096,0.2794 --quantity sir_width,cir_width";
    let run = scan(arguments);
    let table = cells(&run.stdout);
    assert_eq!(table[2][2], "", "no combination region at beta = 2");
    assert!(table[2][1].parse::<f64>().unwrap() > 0.0);
    assert!(
        run.stderr
            .contains("null, since they do not exist: cir_width 1"),
        "{}",
        run.stderr
    );
    let run = scan("--vary disk.polar_inertia=0.2:0.3:2 --quantity sir_width");
    assert!(
        run.stderr.contains("1 points are no rotor"),
        "{}",
        run.stderr
    );
}

#[test]
fn linked_inputs_logarithms_reversed_ranges_and_single_values() {
    let run = scan("--vary disk.asymmetry=0:0.2:3,crack.depth_ratio=0.3:0.1:3 --quantity beta");
    let table = cells(&run.stdout);
    assert_eq!(table.len(), 4);
    assert_eq!(table[3][..2], ["0.2", "0.1"]);
    let run = scan("--vary disk.mass=1:100:3:log --quantity reference_speed");
    let table = cells(&run.stdout);
    assert_eq!(table[1][0], "1.0");
    assert_eq!(table[3][0], "100.0");
    assert!((table[2][0].parse::<f64>().unwrap() - 10.0).abs() < 1e-13);
    for one in ["0.3", "0.3:0.3:1"] {
        let run = scan(&format!("--vary crack.angle={one} --quantity beta"));
        assert_eq!(cells(&run.stdout).len(), 2, "{}", run.stderr);
    }
}

#[test]
fn values_come_from_a_column_and_the_rest_from_the_file() {
    let place = Workplace::new()
        .with("values.csv", "phi,crack.angle\n0,1\n90deg,2\n")
        .with(
            "rotor.toml",
            rotor_file("depth_ratio = 0.2", "depth_ratio = 0.3"),
        );
    let run = place.run(&words(
        "rotor.toml --vary crack.angle=values.csv:phi --quantity delta",
    ));
    let table = cells(&run.stdout);
    assert_eq!(table[2][0], "1.5707963267948966", "{}", run.stderr);
    let from_file = table[1][1].clone();
    let run = place.run(&words("--vary crack.angle=values.csv --quantity delta"));
    let table = cells(&run.stdout);
    assert_eq!(table[1][0], "1.0");
    assert_ne!(from_file, table[1][1]);
}

#[test]
fn samples_depend_on_their_seed_alone() {
    let arguments = |seed: &str| {
        format!(
            "--sample disk.asymmetry=normal(0.2,0.01) --sample crack.angle=uniform(0deg,180deg) --count 1e2 \
             --quantity sir_width {seed}"
        )
    };
    let stdout = |seed: &str| {
        let run = scan(&arguments(seed));
        assert_eq!(run.code, 0, "{}", run.stderr);
        run.stdout
    };
    assert_eq!(stdout("--seed 7"), stdout("--seed 7 --threads 1"));
    assert_ne!(stdout("--seed 7"), stdout("--seed 8"));
    assert_ne!(stdout("--seed 7"), stdout("--seed 7 --sobol"));
    assert_eq!(cells(&stdout("")).len(), 101);
}

#[test]
fn reductions_are_printed_and_written() {
    let place = Workplace::new();
    let arguments = "--vary crack.depth_ratio=0.1,0.2 --vary crack.angle=0deg:180deg:181 --quantity sir_width,cir_width \
                     --reduce max:crack.angle,argmin:crack.angle --reduce histogram(0,1,4),count(0.1),mean -o reduced.csv";
    let run = place.run(&words(arguments));
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(place.names(), ["reduced.csv"]);
    for title in [
        "max:crack_angle of 362 points",
        "argmin:crack_angle of",
        "histogram(0.0,1.0,4) of",
        "count(0.1) of",
        "mean of",
    ] {
        assert!(run.stdout.contains(title), "{title}: {}", run.stdout);
    }
    let table = cells(&place.read("reduced.csv"));
    let heading = [
        "reduction",
        "quantity",
        "crack_depth_ratio",
        "crack_angle",
        "bin_from",
        "bin_to",
        "value",
    ];
    assert_eq!(table[0], heading);
    let found = table
        .iter()
        .find(|row| row[0] == "max:crack_angle" && row[1] == "sir_width" && row[2] == "0.2");
    let row = found.unwrap();
    assert_eq!(row[3], "", "the angle is reduced");
    assert!((row[6].parse::<f64>().unwrap() - 0.0717331014860298).abs() < 1e-13);
    let found = table
        .iter()
        .find(|row| row[0] == "argmin:crack_angle" && row[1] == "sir_width" && row[2] == "0.2");
    assert_eq!(
        found.unwrap()[3],
        "1.5707963267948966",
        "where the least is"
    );
    let bins: Vec<_> = table
        .iter()
        .filter(|row| row[0].starts_with("histogram") && row[1] == "cir_width")
        .collect();
    assert_eq!(bins.len(), 6);
    let sum: f64 = bins.iter().map(|row| row[6].parse::<f64>().unwrap()).sum();
    assert_eq!(sum, 362.0);
}

#[test]
fn every_format_is_written_whole_and_the_same_on_any_number_of_threads() {
    for extension in ["csv", "parquet", "arrow", "npy"] {
        let place = Workplace::new();
        for threads in ["1", "3"] {
            let arguments = format!(
                "--vary crack.angle=0:1:300000 --quantity beta,reference_speed -o {threads}.{extension} --threads {threads}"
            );
            let run = place.run(&words(&arguments));
            assert_eq!((run.code, run.stdout.as_str()), (0, ""), "{}", run.stderr);
        }
        let bytes = |name: &str| std::fs::read(place.path(&format!("{name}.{extension}"))).unwrap();
        assert!(bytes("1") == bytes("3"), "{extension}");
        assert_eq!(place.names().len(), 2, "{:?}", place.names());
    }
}

/// Axes that are none, and what is said of them.
const WRONG_AXES: [(&str, &str); 26] = [
    (
        "crack.depth=0:1:3",
        "there is no input \"crack.depth\"; did you mean crack.depth_ratio?",
    ),
    (
        "xyzzy=0:1:3",
        "there is no input \"xyzzy\"; the inputs are disk.mass,",
    ),
    (
        "crack.angle",
        "\"crack.angle\" has no `=`; an input or the speed and its values are wanted, as crack.angle=0deg:180deg:91",
    ),
    (
        "crack.angle=",
        "a value of crack_angle is empty; a finite number is wanted",
    ),
    (
        "crack.angle=0:1",
        "\"0:1\" is no range; start:stop:count or start:stop:count:log is wanted, as crack.angle=0deg:180deg:91",
    ),
    (
        "crack.angle=0:1:3:lin",
        "\"0:1:3:lin\" ends with \"lin\"; after the count only `log` can stand",
    ),
    (
        "crack.angle=0:1:0",
        "the count is \"0\"; it must be a whole number from 1 on",
    ),
    ("crack.angle=0:1:2.5", "the count is \"2.5\""),
    ("crack.angle=0:1:-3", "the count is \"-3\""),
    (
        "crack.angle=0:1:1",
        "runs from 0 to 1 in one value, which cannot be both",
    ),
    ("crack.angle=nan", "\"nan\" is no finite number"),
    ("crack.angle=0:inf:3", "\"inf\" is no finite number"),
    ("crack.angle=1e999", "\"1e999\" is no finite number"),
    (
        "crack.angle=0,x",
        "\"x\" is no finite number; for crack_angle a finite number is wanted",
    ),
    (
        "crack.depth_ratio=0:1.4:3",
        "value 3 of the axis of crack_depth_ratio is 1.4; it must be >= 0 and <= 1",
    ),
    ("crack.depth_ratio=0:1:3:log", "both ends must be > 0"),
    (
        "crack.depth_ratio=0:40deg:3",
        "\"40deg\" is an angle, but crack_depth_ratio is in no unit",
    ),
    ("disk.mass=5%", "\"5%\" is a ratio, but disk_mass is in kg"),
    (
        "crack.angle=0:1:3,disk.mass=1,2",
        "crack_angle has 3 values and disk_mass has 2",
    ),
    ("crack.angle=0,crack_angle=1", "crack_angle is varied twice"),
    ("crack.angle=none.csv:phi", "cannot read `none.csv`"),
    (
        "crack.angle=table.csv:psi",
        "`table.csv` has no column \"psi\"; it has phi, crack.angle",
    ),
    (
        "crack.angle=table.csv",
        "`table.csv` line 3: \"x\" is no finite number",
    ),
    ("crack.angle=0:1:1e16", "the count is \"1e16\""),
    (
        "crack.angle=0:1:1e12 --vary disk.mass=1:2:1e12",
        "more than 9007199254740992 points",
    ),
    (
        "crack.angle=0:1:3 --vary crack.angle=0:1:3",
        "crack_angle is varied twice",
    ),
];

#[test]
fn the_speed_is_an_axis_for_what_is_at_a_speed() {
    let run =
        scan("--vary crack.depth_ratio=0.1,0.2 --vary speed=0.6,0.74 -q growth_rate,sir_width");
    assert_eq!(run.code, 0, "{}", run.stderr);
    let table = cells(&run.stdout);
    assert_eq!(
        table[0],
        ["crack_depth_ratio", "speed", "growth_rate", "sir_width"]
    );
    let number = |row: usize, column: usize| table[row][column].parse::<f64>().unwrap();
    // The first speed is below the region, the other in it; the width is that of the rotor at both.
    for row in [1, 3] {
        assert_eq!((number(row, 2), number(row + 1, 2) > 0.01), (0.0, true));
        assert_eq!(number(row, 3), number(row + 1, 3));
    }
    // Where the motion grows most of these speeds.
    let run = scan("--vary speed=0.6:1.6:101 -q growth_rate --reduce argmax");
    let place = run.stdout.split_whitespace().last();
    assert_eq!(place, Some("0.740000"), "{}", run.stdout);
    // `all` is what the rotor has at any speed.
    let all = scan("--vary speed=0.74 -q all,growth_rate");
    assert!(all.stdout.starts_with("speed,c11,"), "{}", all.stdout);
    assert!(
        !scan("--vary crack.angle=0 -q all")
            .stdout
            .contains("growth_rate")
    );
    let halves = scan("--vary speed=74%,0.74 -q growth_rate");
    assert_eq!(cells(&halves.stdout)[1], cells(&halves.stdout)[2]);
    let unsaid = refused("--vary crack.angle=0 -q growth_rate");
    assert!(
        unsaid.contains("growth_rate is at a speed, which is not varied"),
        "{unsaid}"
    );
    assert!(
        refused("--vary speed=0:2:3 -q growth_rate")
            .contains("the axis of speed is 0; it must be > 0")
    );
    assert!(refused("--vary sped=1 -q growth_rate").contains("did you mean speed?"));
}

#[test]
fn a_wrong_axis_says_what_is_wrong_and_what_would_be_right() {
    for (axis, message) in WRONG_AXES {
        let found = refused(&format!("--vary {axis} --quantity beta -o out.csv"));
        assert!(found.contains(message), "{axis}: {found}");
    }
}

/// Other command lines that cannot be used, and what is said of them.
const WRONG_LINES: [(&str, &str); 17] = [
    (
        "--quantity beta",
        "nothing varies; give an axis, as --vary crack.angle=0deg:180deg:91",
    ),
    (
        "--vary crack.angle=0:1:3 --quantity sir_with",
        "there is no quantity \"sir_with\"; the nearest are sir_width,",
    ),
    (
        "--vary crack.angle=0:1:3 --quantity beta -o out.txt",
        "the name must end with .parquet, .arrow, .csv or .npy",
    ),
    (
        "--vary crack.angle=0:1:3 --quantity beta -o none/out.csv",
        "cannot write `none/out.csv`: No such file or directory",
    ),
    (
        "--vary crack.angle=0:1:3 --quantity beta -o .",
        "cannot tell the format of `.`",
    ),
    (
        "--vary crack.angle=0:1:3 --quantity beta --plot out.jpg",
        "the name must end with .svg, .png or .pdf",
    ),
    (
        "--vary crack.angle=0:1:3 --quantity beta --reduce median",
        "there is no reduction \"median\"",
    ),
    (
        "--vary crack.angle=0:1:3 --quantity beta --reduce max:disk.mass",
        "is over disk_mass, which is not varied",
    ),
    (
        "--vary crack.angle=0:1:3 --quantity beta --reduce count",
        "count wants a threshold, as count(0.05)",
    ),
    (
        "--vary crack.angle=0:1:3 --quantity beta --reduce histogram(1,0,3)",
        "the ends must be finite numbers that increase",
    ),
    (
        "--vary crack.angle=0:1:3 --quantity beta --threads 0",
        "0 is not in 1..=1024",
    ),
    (
        "--vary crack.angle=0:1:3 --quantity beta --resume",
        "--output",
    ),
    ("--sample disk.mass=normal(1,2) --quantity beta", "--count"),
    (
        "--sample disk.mass=normal(1) --count 3 --quantity beta",
        "does not have 2 parameters",
    ),
    (
        "--sample disk.mass=cauchy(1,2) --count 3 --quantity beta",
        "there is no distribution \"cauchy\"",
    ),
    (
        "--sample disk.mass=normal(1,-2) --count 3 --quantity beta",
        "the standard deviation = -2",
    ),
    ("--sample disk.mass --count 3 --quantity beta", "has no `=`"),
];

#[test]
fn other_mistakes_are_told_too() {
    for (arguments, message) in WRONG_LINES {
        let found = refused(arguments);
        assert!(found.contains(message), "{arguments}: {found}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told() {
    for arguments in ["", "--reduce max"] {
        let run = scan(&format!(
            "--vary crack.angle=0:1:3 --quantity beta -o /dev/full {arguments}"
        ));
        assert_eq!(run.code, 2);
        assert!(
            run.stderr
                .contains("cannot write `/dev/full`: No space left on device"),
            "{}",
            run.stderr
        );
    }
}

#[test]
fn an_existing_file_is_replaced_only_by_a_whole_one() {
    let place = Workplace::new().with("out.csv", "before");
    let run = place.run(&words(
        "--vary crack.angle=0:1:3 --quantity sir_with -o out.csv",
    ));
    assert_eq!((run.code, place.read("out.csv").as_str()), (2, "before"));
    let run = place.run(&words(
        "--vary crack.angle=0:1:3 --quantity beta -o out.csv",
    ));
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(place.read("out.csv").starts_with("crack_angle,beta\n"));
    assert_eq!(place.names(), ["out.csv"]);
}

#[test]
fn pictures_are_curves_maps_and_small_maps() {
    let place = Workplace::new();
    let depth = "--vary crack.depth_ratio=0:0.4:9";
    let angle = "--vary crack.angle=0deg:180deg:9";
    for (axes, name) in [
        (angle.to_owned(), "curves.svg"),
        (format!("{depth} {angle}"), "map.svg"),
        (
            format!("--vary disk.asymmetry=0.1,0.2,0.3 {depth} {angle}"),
            "maps.svg",
        ),
        (format!("{depth} {angle}"), "map.png"),
        (format!("{depth} {angle}"), "map.pdf"),
        (
            "--vary disk.mass=1:100:9:log --vary crack.depth_ratio=0.1:0.4:4:log".to_owned(),
            "decades.svg",
        ),
    ] {
        let run = place.run(&words(&format!(
            "{axes} --quantity sir_width --plot {name}"
        )));
        assert_eq!(
            (run.code, run.stdout.as_str()),
            (0, ""),
            "{name}: {}",
            run.stderr
        );
        assert!(place.path(name).exists());
    }
    assert_eq!(
        place.names(),
        [
            "curves.svg",
            "decades.svg",
            "map.pdf",
            "map.png",
            "map.svg",
            "maps.svg"
        ]
    );
    assert!(
        std::fs::read(place.path("map.pdf"))
            .unwrap()
            .starts_with(b"%PDF")
    );
    // On a logarithmic axis the ticks are at 1, 2 and 5 in each decade.
    let decades = place.read("decades.svg");
    for mass in ["1", "2", "5", "10", "20", "50", "100"] {
        assert!(decades.contains(&format!(">{mass}</text>")), "{mass}");
    }
    let svg = place.read("map.svg");
    assert!(
        svg.contains("ZUP"),
        "the line along which the region can close"
    );
    roxmltree::Document::parse(&place.read("maps.svg")).unwrap();
}

#[cfg(unix)]
#[allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "helpers of tests fail by panicking too"
)]
mod interruptions {
    use super::*;
    use std::process::{Child, Command, Stdio};
    use std::time::{Duration, Instant};

    const SCAN: &str = "--vary crack.depth_ratio=0.1:0.4:4 --vary crack.angle=0:3:100000 --quantity sir_width,cir_exact_upper \
                        --threads 1";

    fn start(place: &Workplace, arguments: &str) -> Child {
        Command::new(env!("CARGO_BIN_EXE_rotor"))
            .args(words(arguments))
            .current_dir(place.folder())
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap()
    }

    /// Waits until a chunk is finished.
    fn wait_for_a_chunk(place: &Workplace, folder: &str, child: &mut Child) {
        let start = Instant::now();
        while start.elapsed() < Duration::from_secs(60) {
            let entries = std::fs::read_dir(place.path(folder))
                .into_iter()
                .flatten()
                .flatten();
            let mut names = entries.map(|entry| entry.file_name().into_string().unwrap());
            if names.any(|name| name.ends_with(".chunk")) {
                return;
            }
            assert!(
                child.try_wait().unwrap().is_none(),
                "it ended before a chunk was seen"
            );
            std::thread::sleep(Duration::from_millis(2));
        }
        panic!("no chunk was finished");
    }

    #[test]
    fn a_killed_scan_leaves_no_file_and_goes_on_to_the_same_bytes() {
        for extension in ["parquet", "arrow", "csv", "npy"] {
            let place = Workplace::new();
            let (whole, killed) = (format!("whole.{extension}"), format!("killed.{extension}"));
            assert_eq!(place.run(&words(&format!("{SCAN} -o {whole}"))).code, 0);
            let mut child = start(&place, &format!("{SCAN} -o {killed}"));
            let folder = format!("{killed}.part");
            wait_for_a_chunk(&place, &folder, &mut child);
            child.kill().unwrap();
            child.wait().unwrap();
            assert!(!place.path(&killed).exists());
            let other = place.run(&words(&format!(
                "{SCAN} -o {killed} --resume --quantity beta"
            )));
            assert_eq!(other.code, 2, "{}", other.stderr);
            assert!(
                other.stderr.contains("the unfinished part of another scan"),
                "{}",
                other.stderr
            );
            let run = place.run(&words(
                &format!("{SCAN} -o {killed} --resume --threads 2").replace("--threads 1", ""),
            ));
            assert_eq!(run.code, 0, "{}", run.stderr);
            let bytes = |name: &str| std::fs::read(place.path(name)).unwrap();
            assert!(bytes(&whole) == bytes(&killed), "{extension}");
            assert_eq!(place.names().len(), 2, "{:?}", place.names());
        }
    }

    #[test]
    fn ctrl_c_says_how_to_go_on() {
        let place = Workplace::new();
        let mut child = start(&place, &format!("{SCAN} -o out.parquet"));
        wait_for_a_chunk(&place, "out.parquet.part", &mut child);
        let sent = Command::new("kill")
            .args(["-INT", &child.id().to_string()])
            .status()
            .unwrap();
        assert!(sent.success());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(130));
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(
            message.contains("The same command with --resume goes on"),
            "{message}"
        );
        assert!(!place.path("out.parquet").exists());
        let run = place.run(&words(
            "--vary crack.angle=0:1:3 --quantity beta -o out.parquet",
        ));
        assert_eq!(run.code, 0);
        let message = run.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            message.contains("they are dropped, since --resume was not given"),
            "{message}"
        );
    }
}
