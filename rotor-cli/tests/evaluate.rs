//! `rotor evaluate` on good and on bad tables.

mod common;

use common::{Run, Workplace, cells, rotor_file};

fn evaluate(table: impl AsRef<[u8]>, more: &[&str]) -> Run {
    let arguments = [&["evaluate", "-"], more].concat();
    Workplace::new().run_on(&arguments, table.as_ref())
}

/// A table that must be refused: the message, with nothing on stdout.
fn refused(table: impl AsRef<[u8]>, more: &[&str]) -> String {
    let place = Workplace::new();
    let arguments = [&["evaluate", "-", "-o", "out.csv"], more].concat();
    let run = place.run_on(&arguments, table.as_ref());
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{}", run.stderr);
    assert_eq!(
        place.names(),
        Vec::<String>::new(),
        "no file, not even a part of one"
    );
    run.stderr
}

#[test]
fn results_follow_the_columns_of_the_table_and_read_back_exactly() {
    let run = evaluate(
        "name,crack.depth_ratio\n\"A, B\",0.2\n",
        &["-q", "sir_width,reference_speed,sir_width"],
    );
    assert_eq!(run.code, 0, "{}", run.stderr);
    let table = cells(&run.stdout);
    assert_eq!(
        table[0],
        [
            "name",
            "crack.depth_ratio",
            "sir_width",
            "reference_speed",
            "error"
        ]
    );
    assert_eq!(table[1][0..2], ["A, B", "0.2"]);
    assert_eq!(table[1][4], "");
    let width: f64 = table[1][2].parse().unwrap();
    let rotor = rotor_core::jeffcott::rotor::Rotor::default();
    assert_eq!(
        width,
        rotor_core::quantity::Quantity::SirWidth
            .evaluate(&rotor)
            .unwrap()
    );
    assert!((width - 0.0717331014860298).abs() < 1e-13);
}

#[test]
fn every_result_of_the_documentation_can_be_asked_for() {
    let run = evaluate("crack_angle\n0\n", &[]);
    let header = cells(&run.stdout)[0].join(",");
    assert_eq!(
        header,
        "crack_angle,c11,c22,c33,c44,reference_speed,beta,gamma,delta,epsilon_1,epsilon_12,epsilon_2,sir_start,\
         cir_start,sir_width,cir_width,sir_zup_asymmetry,cir_zup_asymmetry,sir_exact_lower,sir_exact_upper,\
         cir_exact_lower,cir_exact_upper,error"
    );
    assert!(
        cells(&run.stdout)[1][1..22]
            .iter()
            .all(|cell| cell.parse::<f64>().unwrap().is_finite())
    );
}

#[test]
fn inputs_without_a_column_come_from_the_base() {
    let place = Workplace::new().with(
        "base.toml",
        rotor_file("depth_ratio = 0.2", "depth_ratio = 0.3"),
    );
    let run = place.run_on(
        &["evaluate", "-", "-q", "delta", "-b", "base.toml"],
        b"crack_angle\n0\n",
    );
    let from_base = cells(&run.stdout)[1][1].clone();
    let run = place.run_on(
        &["evaluate", "-", "-q", "delta"],
        b"crack_depth_ratio\n0.3\n",
    );
    assert_eq!(from_base, cells(&run.stdout)[1][1]);
    let run = place.run_on(&["evaluate", "-", "-q", "delta"], b"crack_angle\n0\n");
    assert_ne!(from_base, cells(&run.stdout)[1][1]);
}

#[test]
fn models_are_a_column_too() {
    let table = "crack_model,crack.edge\nsupport-arm,half\nmidspan-arm,half\nsupport-arm,full\n";
    let run = evaluate(table, &["-q", "epsilon_1"]);
    let table = cells(&run.stdout);
    assert_ne!(table[1][2], table[2][2]);
    assert_ne!(table[1][2], table[3][2]);
}

#[test]
fn a_region_that_does_not_exist_is_empty_with_its_reason_and_no_failure() {
    let table = "disk_polar_inertia\n0.2794\n0.2096\n";
    let run = evaluate(table, &["-q", "cir_width,sir_start,cir_start"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let table = cells(&run.stdout);
    assert_eq!((table[1][1].as_str(), table[1][3].as_str()), ("", ""));
    assert!(table[1][2].parse::<f64>().is_ok());
    assert!(table[1][4].contains("beta"), "{:?}", table[1]);
    assert_eq!(
        table[1][4].matches("combination").count(),
        1,
        "one reason is told once: {:?}",
        table[1]
    );
    assert!(
        table[2]
            .iter()
            .take(4)
            .all(|cell| cell.parse::<f64>().is_ok())
            && table[2][4].is_empty()
    );
}

#[test]
fn a_bad_row_is_told_by_line_column_value_and_what_is_allowed() {
    let table = "name,disk_mass\n\"two\nlines\",1\n\nB,-2\n";
    insta::assert_snapshot!(refused(table, &[]), @r#"
    warning: standard input: columns that are no inputs are only carried through: `name`
    error: standard input: line 5: column `disk_mass`: "-2" is not allowed, a number > 0 is wanted; no
      results are written
    "#);
    let tables = [
        ("disk_mass\nnan\n", "\"nan\" is no number"),
        ("disk_mass\nInfinity\n", "\"Infinity\" is no number"),
        ("disk_mass\ninf\n", "\"inf\" is no number"),
        ("disk_mass\n1e999\n", "too large"),
        ("disk_mass\n\"1,5\"\n", "a point, not a comma"),
        ("disk_mass,x\n,1\n", "the cell is empty"),
        ("disk_mass\nten\n", "\"ten\" is no number"),
        ("disk_mass,x\n1\n", "the row has 1 field, the header has 2"),
        ("crack_angle\nx\n", "a finite number is wanted"),
        (
            "disk_mass,x\n1,2,3\n",
            "the row has 3 fields, the header has 2",
        ),
        (
            "crack_model\nsupport\n",
            "support-arm, midspan-arm, simply-supported",
        ),
        ("disk_polar_inertia\n1\n", "<= 2"),
        ("disk_mass,x\n\"1,2\n", "never closed"),
    ];
    for (table, expected) in tables {
        let message = refused(table, &[]);
        assert!(
            message.contains("line 2") && message.contains(expected),
            "{table:?}: {message}"
        );
    }
}

#[test]
fn standard_output_stays_empty_when_a_late_row_is_bad() {
    let mut table = String::from("crack_depth_ratio\n");
    table.push_str(&"0.1\n".repeat(5000));
    table.push_str("1.5\n");
    let run = evaluate(&table, &["-q", "sir_width"]);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""));
    assert!(run.stderr.contains("line 5002"), "{}", run.stderr);
}

#[test]
fn with_keep_going_a_bad_row_stays_and_is_counted() {
    let run = evaluate(
        "n,disk_mass\n1,0\n2,1\n3\n4,1,9\n",
        &["-q", "sir_width", "--keep-going"],
    );
    assert_eq!(run.code, 0);
    assert!(run.stderr.contains("3 of 4 rows"), "{}", run.stderr);
    let table = cells(&run.stdout);
    assert_eq!(table.len(), 5);
    assert_eq!((table[1][0].as_str(), table[1][2].as_str()), ("1", ""));
    assert!(table[1][3].contains("> 0"));
    assert!(table[2][2].parse::<f64>().is_ok() && table[2][3].is_empty());
    assert_eq!(table[3][0..3], ["3", "", ""]);
    assert!(table[3][3].contains("1 field,"));
    assert_eq!(table[4][0..3], ["4", "1", ""]);
}

#[test]
fn headers_that_cannot_be_used_are_refused() {
    let tables = [
        ("", "is empty"),
        ("\n\n", "is empty"),
        (
            "disk_mass,disk.mass\n1,1\n",
            "has two columns, 1 (`disk_mass`) and 2 (`disk.mass`)",
        ),
    ];
    for (table, expected) in tables {
        let message = refused(table, &["-q", "sir_width"]);
        assert!(message.contains(expected), "{table:?}: {message}");
    }
    assert!(
        refused("\u{feff}disk_mass\n-1\n", &[]).contains("column `disk_mass`"),
        "a byte order mark is no letter"
    );
    assert!(refused(b"\xff\xfed\0i\0", &[]).contains("UTF-16"));
    let message = refused("disk_mass;crack_angle\n1;2\n", &[]);
    assert!(message.contains("separated by semicolons"), "{message}");
    let message = refused("name\tcrack.angle\nA\t2\n", &[]);
    assert!(message.contains("separated by tabs"), "{message}");
    let run = evaluate("a;b\n1\n", &["-q", "beta"]);
    assert!(
        run.code == 0 && run.stderr.contains("every row is the base rotor"),
        "{}",
        run.stderr
    );
}

#[test]
fn rows_of_doubtful_disks_are_counted_in_one_line() {
    let table = "disk_asymmetry\n0.2\n0.9\n-0.8\n0.1\n";
    let run = evaluate(table, &["-q", "sir_width"]);
    assert_eq!(run.code, 0);
    insta::assert_snapshot!(run.stderr, @r"
    warning: standard input: 2 of 4 rows are doubtful, the first in line 3: disk_asymmetry is 0.9, but a
      rigid body with beta = 1.5003579098067288 has at most beta / 2 = 0.7501789549033644: its moments
      of inertia would break the triangle inequality
    ");
}

#[test]
fn a_zero_has_no_sign_and_a_closed_region_has_the_width_zero() {
    let table = "disk_position_ratio,crack_depth_ratio\n0.5,0\n";
    let run = evaluate(table, &[]);
    let table = cells(&run.stdout);
    assert!(!table[1].contains(&"-0.0".to_owned()), "{:?}", table[1]);
    let column = table[0].iter().position(|name| name == "cir_width");
    assert_eq!(table[1][column.unwrap()], "0.0");
    assert!(!run.stdout.contains("NaN"), "{}", run.stdout);
}

#[test]
fn results_that_the_table_has_already_are_computed_anew() {
    let first = evaluate("disk_mass\n1\n", &["-q", "sir_width"]);
    let again = evaluate(&first.stdout, &["-q", "sir_width"]);
    assert_eq!((again.code, &again.stdout), (0, &first.stdout));
    insta::assert_snapshot!(again.stderr, @r"
    warning: standard input: results are computed anew, the table's own are dropped: `sir_width`,
      `error`
    ");
    let other = evaluate(&first.stdout, &["-q", "beta"]);
    assert_eq!(
        cells(&other.stdout)[0],
        ["disk_mass", "sir_width", "beta", "error"]
    );
    insta::assert_snapshot!(other.stderr, @r"
    warning: standard input: columns that are no inputs are only carried through: `sir_width`
    warning: standard input: results are computed anew, the table's own are dropped: `error`
    ");
}

#[test]
fn a_header_alone_gives_a_header() {
    let run = evaluate("disk_mass,x", &["-q", "beta"]);
    assert_eq!(
        (run.code, run.stdout.as_str()),
        (0, "disk_mass,x,beta,error\n")
    );
}

#[test]
fn columns_that_look_like_inputs_are_remarked_upon() {
    let run = evaluate("disk_mas,disk_mass\n1,1\n", &["-q", "beta"]);
    assert_eq!(run.code, 0);
    assert!(
        run.stderr.contains("`disk_mas`") && run.stderr.contains("`disk_mass`?"),
        "{}",
        run.stderr
    );
    assert!(
        run.stderr.lines().all(|line| line.chars().count() <= 100),
        "{}",
        run.stderr
    );
}

#[test]
fn columns_that_are_no_inputs_are_named_in_one_line_with_what_they_may_have_been_meant_to_be() {
    let table = "crack_depth,depth_ratio,model,E,name,crack_angle\n0.3,0.3,midspan-arm,1e9,A,0\n";
    let run = evaluate(table, &["-q", "beta"]);
    assert_eq!(run.code, 0);
    insta::assert_snapshot!(run.stderr, @r"
    warning: standard input: columns that are no inputs are only carried through: `crack_depth` (is it
      `crack_depth_ratio`?), `depth_ratio` (is it `crack_depth_ratio`?), `model` (is it `crack_model`?),
      `E` (is it `shaft_youngs_modulus`?), `name`
    ");
    let wide: Vec<_> = (0..100).map(|index| format!("x{index:02}")).collect();
    let run = evaluate(format!("crack_angle,{}\n", wide.join(",")), &["-q", "beta"]);
    assert!(run.stderr.contains("`x11`, and 88 more"), "{}", run.stderr);
}

#[test]
fn a_lone_return_ends_a_row_as_other_line_ends_do() {
    let cases = [
        ("crack_angle\r0\r1\r", 2),
        ("crack_angle,name\r\n0,a\r1,b\r\n2,c\n", 3),
        ("crack_angle\n0\r\r\n1", 2),
    ];
    for (table, rows) in cases {
        let run = evaluate(table, &["-q", "sir_width"]);
        assert_eq!(run.code, 0, "{table:?}: {}", run.stderr);
        assert_eq!(
            cells(&run.stdout).len(),
            rows + 1,
            "{table:?}: {}",
            run.stdout
        );
    }
    assert!(refused("crack_angle\r0\rbad\r", &[]).contains("line 3: column `crack_angle`"));
    assert!(
        refused("crack_angle,name\n0,a\rb\n", &[]).contains("line 3: the row has 1 field"),
        "what follows the return is a row of its own"
    );
    let quoted = evaluate("crack_angle,name\n0,\"a\rb\"\n", &["-q", "beta"]);
    assert_eq!(cells(&quoted.stdout)[1][1], "a\rb");
}

#[test]
fn keeping_going_loses_nothing() {
    let run = evaluate(
        "n,crack_angle,error\n1,0,mine\n2,0,x,9,\"8,7\"\n3,\"0\n4,0,y\n",
        &["-q", "beta", "--keep-going"],
    );
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stderr.contains("dropped: `error`"), "{}", run.stderr);
    let table = cells(&run.stdout);
    assert_eq!(table.len(), 5, "{}", run.stdout);
    assert_eq!(
        table[2][3],
        "the row has 5 fields, the header has 3; beyond it: \"9\", \"8,7\""
    );
    assert_eq!((table[3][0].as_str(), table[3][1].as_str()), ("3", "0"));
    assert!(table[3][3].contains("never closed"), "{:?}", table[3]);
    assert!(table[4][2].parse::<f64>().is_ok(), "{:?}", table[4]);
}

#[test]
fn a_table_without_a_single_rotor_ends_with_1() {
    let run = evaluate("disk_mass\n0\n-1\n", &["-q", "beta", "--keep-going"]);
    assert_eq!(run.code, 1, "{}", run.stderr);
    assert!(run.stderr.contains("2 of 2 rows"), "{}", run.stderr);
    assert_eq!(cells(&run.stdout).len(), 3);
    assert_eq!(evaluate("disk_mass\n", &["--keep-going"]).code, 0);
}

#[test]
fn a_base_is_not_refused_for_what_columns_replace() {
    let place = Workplace::new()
        .with(
            "deep.toml",
            rotor_file("depth_ratio = 0.2", "depth_ratio = 1.5"),
        )
        .with("flat.toml", rotor_file("0.2096", "0.5"))
        .with("short.toml", rotor_file("mass = 10.43", "# mass"));
    let run = |base: &str, table: &str| {
        place.run_on(
            &["evaluate", "-", "-q", "beta", "-b", base],
            table.as_bytes(),
        )
    };
    for (base, table) in [
        ("deep.toml", "crack_depth_ratio\n0.1\n"),
        ("flat.toml", "disk_polar_inertia\n0.2\n"),
        ("short.toml", "disk_mass\n1\n"),
    ] {
        assert_eq!(run(base, table).code, 0, "{}", run(base, table).stderr);
        assert_eq!(run(base, "crack_angle\n0\n").code, 2, "{base}");
    }
    let both = run("flat.toml", "disk_diametral_inertia\n0.1\n");
    assert!(
        both.code == 2 && both.stderr.contains("line 2"),
        "{}",
        both.stderr
    );
}

#[test]
fn cells_reach_the_terminal_without_control_codes_and_not_endless() {
    let message = refused("crack_angle\n\"\u{1b}[31mred\"\n", &[]);
    assert!(message.contains("\\u{1b}[31mred"), "{message:?}");
    assert!(!message.contains('\u{1b}'), "{message:?}");
    let message = refused(format!("crack_angle\n{}\n", "7x".repeat(5000)), &[]);
    assert!(
        message.lines().all(|line| line.chars().count() <= 100) && message.contains('…'),
        "{message}"
    );
}

#[test]
fn names_of_results_may_be_capitals() {
    let run = evaluate("crack_angle\n0\n", &["-q", "SIR_WIDTH"]);
    assert!(
        run.stdout.starts_with("crack_angle,sir_width,error"),
        "{}",
        run.stderr
    );
    assert_eq!(
        cells(&evaluate("crack_angle\n0\n", &["-q", "ALL"]).stdout)[0].len(),
        23
    );
}

#[test]
fn rows_in_other_units_are_doubtful() {
    let run = evaluate("crack_angle\n1\n90\n", &["-q", "beta"]);
    assert_eq!(run.code, 0);
    insta::assert_snapshot!(run.stderr, @r"
    warning: standard input: 1 of 2 rows are doubtful, the first in line 3: crack_angle is 90 rad, more
      than a turn; is it in degrees?
    ");
}

#[test]
fn bytes_of_other_columns_are_carried_through_and_those_of_inputs_must_be_text() {
    let place = Workplace::new();
    let run = place.run_on(
        &["evaluate", "-", "-q", "beta", "-o", "out.csv"],
        b"n,disk_mass\r\n\xe9t\xe9,1\r\n",
    );
    assert_eq!(run.code, 0, "{}", run.stderr);
    let bytes = std::fs::read(place.path("out.csv")).unwrap();
    assert!(bytes.windows(4).any(|window| window == b"\xe9t\xe9,"));
    assert!(refused(b"disk_mass\n\xe91\n", &[]).contains("is not UTF-8"));
}

#[test]
fn a_table_can_be_replaced_by_its_results() {
    let place = Workplace::new().with("t.csv", "crack_angle\n0\n");
    let run = place.run(&["evaluate", "t.csv", "-o", "t.csv", "-q", "beta"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(
        place
            .read("t.csv")
            .starts_with("crack_angle,beta,error\n0,1.5")
    );
    assert_eq!(place.names(), ["t.csv"]);
}

#[test]
fn an_output_file_keeps_its_content_when_a_row_is_bad() {
    let place = Workplace::new()
        .with("t.csv", "disk_mass\n1\n0\n")
        .with("out.csv", "before");
    let run = place.run(&["evaluate", "t.csv", "-o", "out.csv"]);
    assert_eq!(run.code, 2);
    assert_eq!(place.read("out.csv"), "before");
    assert_eq!(place.names(), ["out.csv", "t.csv"]);
}

#[cfg(unix)]
#[test]
fn a_new_file_can_be_read_by_others_and_an_old_one_keeps_its_permissions_and_links() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let mode = |path| std::fs::metadata(path).unwrap().permissions().mode() & 0o777;
    let place = Workplace::new()
        .with("t.csv", "disk_mass\n1\n")
        .with("old.csv", "");
    let usual = mode(place.path("t.csv"));
    std::fs::set_permissions(place.path("old.csv"), PermissionsExt::from_mode(0o640)).unwrap();
    symlink("old.csv", place.path("link.csv")).unwrap();
    assert_eq!(place.run(&["evaluate", "t.csv", "-o", "new.csv"]).code, 0);
    assert_eq!(place.run(&["evaluate", "t.csv", "-o", "link.csv"]).code, 0);
    assert_eq!(
        (mode(place.path("new.csv")), mode(place.path("old.csv"))),
        (usual, 0o640)
    );
    assert!(
        std::fs::symlink_metadata(place.path("link.csv"))
            .unwrap()
            .is_symlink()
    );
    assert!(place.read("old.csv").contains("sir_width"));
}

#[test]
fn what_cannot_be_read_written_or_computed_is_named() {
    let place = Workplace::new().with("t.csv", "disk_mass\n1\n");
    let cases = [
        (
            ["evaluate", "none.csv", "-o", "o.csv"],
            "cannot read `none.csv`",
        ),
        (["evaluate", ".", "-o", "o.csv"], "it is a folder"),
        (["evaluate", "t.csv", "-o", "."], "it is a folder"),
        (
            ["evaluate", "t.csv", "-o", "no/o.csv"],
            "cannot write `no/o.csv`",
        ),
        (["evaluate", "t.csv", "-q", "sir_with"], "sir_width"),
        (["evaluate", "t.csv", "-q", ""], "a name is empty"),
    ];
    for (arguments, expected) in cases {
        let run = place.run(&arguments);
        assert!(
            run.code == 2 && run.stderr.contains(expected),
            "{arguments:?}: {}",
            run.stderr
        );
        assert!(!run.stderr.contains(".rotor-"), "{}", run.stderr);
    }
}

#[test]
fn a_long_table_is_in_order() {
    // More pieces than are under way at once.
    const ROWS: u32 = 150_000;
    let mut table = String::from("crack_angle\n");
    for row in 0..ROWS {
        table.push_str(&format!("{}\n", f64::from(row) * 1e-3));
    }
    let run = evaluate(&table, &["-q", "sir_width"]);
    let rows = cells(&run.stdout);
    assert_eq!(rows.len(), ROWS as usize + 1);
    for (index, row) in rows.iter().skip(1).enumerate() {
        assert_eq!(row[0], format!("{}", index as f64 * 1e-3));
    }
    for row in [1, 16_385, ROWS as usize] {
        let alone = evaluate(
            format!("crack_angle\n{}\n", rows[row][0]),
            &["-q", "sir_width"],
        );
        assert_eq!(rows[row], cells(&alone.stdout)[1], "row {row}");
    }
}

#[test]
fn tables_come_and_go_in_every_format_with_the_same_numbers() {
    let table =
        "name,disk_polar_inertia,crack.model\n\"A, B\",0.2096,support-arm\nC,0.2794,midspan-arm\n";
    let place = Workplace::new().with("in.csv", table);
    let evaluate = |from: &str, to: &str| {
        let run = place.run(&["evaluate", from, "-q", "sir_width,cir_width", "-o", to]);
        assert_eq!(run.code, 0, "{from} to {to}: {}", run.stderr);
        assert!(
            run.stderr.contains("only carried through: `name`"),
            "{}",
            run.stderr
        );
    };
    evaluate("in.csv", "direct.csv");
    for (first, second) in [("a.parquet", "b.arrow"), ("c.arrow", "d.parquet")] {
        evaluate("in.csv", first);
        // The results are computed anew from the columns of the file.
        let run = place.run(&["evaluate", first, "-q", "sir_width,cir_width", "-o", second]);
        assert!(run.stderr.contains("computed anew"), "{}", run.stderr);
        let run = place.run(&["evaluate", second, "-q", "sir_width,cir_width"]);
        assert_eq!(run.stdout, place.read("direct.csv"), "{second}");
    }
}

#[test]
fn a_bad_row_of_a_file_of_columns_is_told_by_its_number() {
    let place = Workplace::new().with("in.csv", "crack_depth_ratio\n0.1\n7\n");
    let run = place.run(&["evaluate", "in.csv", "-k", "-q", "beta", "-o", "in.parquet"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let run = place.run(&["evaluate", "in.parquet", "-q", "beta"]);
    assert_eq!(run.code, 2);
    let message = run.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        message.contains("in.parquet: row 2: column `crack_depth_ratio`: \"7.0\" is not allowed"),
        "{message}"
    );
    let broken = Workplace::new()
        .with("in.parquet", "no parquet")
        .with("in.arrow", "no arrow");
    for name in ["in.parquet", "in.arrow"] {
        let run = broken.run(&["evaluate", name]);
        assert!(
            run.code == 2 && run.stderr.contains(&format!("cannot read `{name}`")),
            "{}",
            run.stderr
        );
    }
    let run = broken.run_on(&["evaluate", "-", "-o", "out.npy"], b"crack_angle\n0\n");
    assert!(
        run.stderr.contains("cannot write `out.npy`"),
        "{}",
        run.stderr
    );
}

#[test]
fn what_is_at_a_speed_is_refused_and_not_among_all() {
    let table = "crack.angle\n0.5\n";
    let told = refused(table, &["-q", "sir_width,growth_rate"]);
    assert!(told.contains("growth_rate is at a speed"), "{told}");
    let all = evaluate(table, &["-q", "all"]);
    assert!(!all.stdout.contains("growth_rate"), "{}", all.stdout);
}
