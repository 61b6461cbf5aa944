mod document;
mod scales;

use std::f64::consts::PI;

use super::*;
use crate::geometry::{Rect, distance, visible_parts};

/// A width that falls to a zero unstable point and rises again.
fn width(ratio: f64, zup: f64) -> f64 {
    0.31 * (1.0 - (ratio / zup).powi(2)).abs() * (1.0 - 0.3 * ratio)
}

fn line(label: &str, colour: usize, dash: Dash, points: Vec<(f64, Option<f64>)>) -> Curve {
    Curve {
        label: label.to_owned(),
        colour,
        mark: Mark::Line(dash),
        points,
    }
}

fn sampled(low: f64, high: f64, count: usize, of: impl Fn(f64) -> f64) -> Vec<(f64, Option<f64>)> {
    let step = (high - low) / (count - 1) as f64;
    (0..count)
        .map(|k| low + step * k as f64)
        .map(|x| (x, Some(of(x))))
        .collect()
}

fn axis(label: &str, ticks: Ticks) -> Axis {
    Axis {
        label: label.to_owned(),
        range: None,
        ticks,
    }
}

const CAPTION: &str = "Figure 4. Width of the simple (a) and the combination (b) instability region against the \
    depth of the crack at φ = 0, and its zero unstable points. Rotor of the paper: β = 1.500, δ = 1.552, Δ_d = 0.2; \
    crack model *support-arm*. Lines: Eq. (31); symbols: exact ends.";

fn two_panels() -> Figure {
    let cases = [
        (0.2316, "*l*_c/*L* = 0.5"),
        (0.2749, "*l*_c/*L* = 0.4"),
        (0.3414, "*l*_c/*L* = 0.3"),
    ];
    let first: Vec<Curve> = cases
        .iter()
        .zip([Dash::Solid, Dash::Dashed, Dash::Dotted])
        .enumerate()
        .map(|(k, (&(zup, label), dash))| {
            line(label, k, dash, sampled(0.0, 0.4, 161, |x| width(x, zup)))
        })
        .chain([Curve {
            label: "exact, 0.5".to_owned(),
            colour: 0,
            mark: Mark::Points(Symbol::Circle),
            points: sampled(0.0, 0.4, 15, |x| 0.97 * width(x, 0.2316)),
        }])
        .collect();
    let second = [Symbol::Square, Symbol::Triangle, Symbol::Diamond]
        .into_iter()
        .enumerate()
        .map(|(k, symbol)| Curve {
            label: format!("ε_{{12}} = 0.{}", k + 1),
            colour: k + 3,
            mark: Mark::Points(symbol),
            points: sampled(0.0, PI / 2.0, 13, |x| {
                0.2 + 0.1 * k as f64 + 0.1 * (2.0 * x).sin()
            }),
        })
        .chain([line(
            "λ_c with a gap",
            6,
            Dash::Solid,
            sampled(0.0, PI / 2.0, 91, |x| 0.3 - 0.2 * (2.0 * x).cos())
                .into_iter()
                .map(|(x, y)| (x, y.filter(|_| !(0.6..0.9).contains(&x))))
                .collect(),
        )])
        .collect();
    let zups = cases.iter().map(|&(zup, _)| Annotation {
        label: format!("σ_ZUP = {zup}"),
        at: (zup, 0.0),
    });
    Figure {
        name: "figure-4".to_owned(),
        caption: CAPTION.to_owned(),
        plot: Plot::Panels(vec![
            Panel {
                title: "(a)".to_owned(),
                x: axis("crack depth ratio σ = *a*/*R* [–]", Ticks::Decimal),
                y: axis("width λ_s / ω_st [–]", Ticks::Decimal),
                curves: first,
                annotations: zups.collect(),
                note: String::new(),
            },
            Panel {
                title: "(b)".to_owned(),
                x: axis("crack angle φ [rad]", Ticks::FractionsOfPi),
                y: axis("width λ_c / ω_st & more [–]", Ticks::Decimal),
                curves: second,
                annotations: vec![Annotation {
                    label: "Ω_c = 2.553".to_owned(),
                    at: (PI / 4.0, 0.3),
                }],
                note: String::new(),
            },
        ]),
    }
}

fn map_figure() -> Figure {
    let x_values: Vec<f64> = (0..81).map(|k| 0.4 * f64::from(k) / 80.0).collect();
    let y_values: Vec<f64> = (0..73).map(|k| PI / 2.0 * f64::from(k) / 72.0).collect();
    let value = |x: f64, y: f64| ((x - 0.2316).powi(2) * 4.0 + (0.25 * y.sin()).powi(2)).sqrt();
    let values = y_values
        .iter()
        .flat_map(|&y| {
            x_values
                .iter()
                .map(move |&x| (x + 0.1 * y < 0.5).then(|| value(x, y)))
        })
        .collect();
    Figure {
        name: "figure-8".to_owned(),
        caption: "Figure 8. Width λ_s over crack depth and angle; grey: no region.".to_owned(),
        plot: Plot::Map(Box::new(Map {
            title: String::new(),
            x: axis("crack depth ratio σ [–]", Ticks::Decimal),
            y: axis("crack angle φ [°]", Ticks::Degrees),
            x_values,
            y_values,
            values,
            value_label: "width λ_s / ω_st [–]".to_owned(),
            levels: vec![0.05, 0.1, 0.2, 0.3, 0.4],
            curves: vec![line(
                "zero of d*λ*_s/dσ",
                1,
                Dash::Dashed,
                vec![(0.2316, Some(0.0)), (0.2316, Some(1.5))],
            )],
            annotations: vec![Annotation {
                label: "ZUP: σ = 0.2316, φ = 0".to_owned(),
                at: (0.2316, 0.0),
            }],
            note: String::new(),
        })),
    }
}

/// The document as a tree, or the test fails.
fn parsed(svg: &str) -> roxmltree::Document<'_> {
    roxmltree::Document::parse(svg).expect("well-formed XML")
}

/// The texts of a document, without markup.
fn texts(svg: &str) -> Vec<String> {
    let of = |node: roxmltree::Node| {
        node.descendants()
            .filter(|inner| inner.is_text())
            .filter_map(|inner| inner.text())
            .collect()
    };
    parsed(svg)
        .descendants()
        .filter(|node| node.has_tag_name("text"))
        .map(of)
        .collect()
}

/// A figure of one panel with one solid line.
fn one_line(points: Vec<(f64, Option<f64>)>) -> Figure {
    let curves = vec![line("λ_s", 0, Dash::Solid, points)];
    let (x, y) = (axis("x", Ticks::Decimal), axis("y", Ticks::Decimal));
    let panel = Panel {
        title: String::new(),
        x,
        y,
        curves,
        annotations: Vec::new(),
        note: String::new(),
    };
    Figure {
        name: "figure-1".to_owned(),
        caption: String::new(),
        plot: Plot::Panels(vec![panel]),
    }
}

/// The one panel of [`one_line`].
fn panel_of(figure: &mut Figure) -> &mut Panel {
    match &mut figure.plot {
        Plot::Panels(panels) => &mut panels[0],
        Plot::Map(_) | Plot::Maps(_) => panic!("not a map"),
    }
}

/// The path data of a figure's strokes of 1.8 pixels, its curves.
fn curve_data(svg: &str, colour: &str) -> Vec<String> {
    parsed(svg)
        .descendants()
        .filter(|node| node.attribute("stroke") == Some(colour))
        .filter(|node| node.attribute("stroke-width") == Some("1.8"))
        .filter_map(|node| node.attribute("d").map(str::to_owned))
        .collect()
}

/// The path data of the first frame, the first outline that is closed by `z`.
fn frame_data(svg: &str) -> String {
    parsed(svg)
        .descendants()
        .filter(|node| node.attribute("fill") == Some("none"))
        .filter_map(|node| node.attribute("d"))
        .find(|d| d.ends_with('z'))
        .expect("the frame")
        .to_owned()
}

#[test]
fn every_label_is_in_the_document() {
    let shown = texts(&two_panels().svg().unwrap());
    for label in [
        "(a)",
        "(b)",
        "lc/L = 0.4",
        "exact, 0.5",
        "ε12 = 0.3",
        "crack depth ratio σ = a/R [–]",
        "width λs / ωst [–]",
        "width λc / ωst & more [–]",
        "σZUP = 0.2749",
        "Ωc = 2.553",
        "3π/8",
        "π/2",
        "0.4",
    ] {
        assert!(
            shown.iter().any(|text| text == label),
            "{label} is missing in {shown:?}"
        );
    }
    let caption = shown.join(" ").replace('\u{a0}', " ");
    assert!(
        caption.contains(
            "Rotor of the paper: β = 1.500, δ = 1.552, Δd = 0.2; crack model support-arm."
        )
    );
    let shown = texts(&map_figure().svg().unwrap());
    for label in [
        "crack angle φ [°]",
        "90°",
        "ZUP: σ = 0.2316, φ = 0",
        "0.05",
        "zero of dλs/dσ",
    ] {
        assert!(
            shown.iter().any(|text| text == label),
            "{label} is missing in {shown:?}"
        );
    }
}

#[test]
fn subscripts_are_lowered_and_raised_again() {
    let svg = two_panels().svg().unwrap();
    let document = parsed(&svg);
    let mut lowered = 0;
    for text in document
        .descendants()
        .filter(|node| node.has_tag_name("text"))
    {
        let mut level = 0.0_f64;
        for run in text.children() {
            level += run
                .attribute("dy")
                .map_or(0.0, |dy| dy.parse::<f64>().unwrap());
            let subscript = run.attribute("font-size").is_some();
            assert_eq!(subscript, level > 1.0, "{run:?}");
            lowered += usize::from(subscript);
        }
    }
    assert!(lowered >= 15, "{lowered} subscripts");
}

#[test]
fn markup_knows_symbols_from_words() {
    let plain = label::plain;
    assert_eq!(plain("ε_{12} and *l*_c/*L*"), "ε_12 and l_c/L");
    // A word with underscores, a lonely star, an unclosed brace: as they are.
    assert_eq!(plain("crack_depth_ratio * 2"), "crack_depth_ratio * 2");
    assert_eq!(plain("λ_{st"), "λ_{st");
    let fonts = label::Fonts::embedded().unwrap();
    let width = |label| fonts.width(label, 100.0);
    // A subscript is narrower than the same letters on the line, and the underscore takes no room.
    assert!(width("λ_s") < width("λs") && width("λ_s") > width("λ"));
    // Advance widths of DejaVu Sans: 0 has 1303 of 2048 units to the em.
    approx(width("00"), 2.0 * 100.0 * 1303.0 / 2048.0);
}

/// Equal to a millionth.
#[track_caller]
fn approx(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-6 * b.abs().max(1.0), "{a} is not {b}");
}

#[test]
fn the_same_figure_gives_the_same_bytes_without_ids() {
    for figure in [two_panels(), map_figure()] {
        let svg = figure.svg().unwrap();
        assert_eq!(svg, figure.svg().unwrap());
        assert_eq!(figure.png().unwrap(), figure.png().unwrap());
        // Several documents go into one page: nothing may have a name, or refer to one or to a file.
        let document = parsed(&svg);
        for attribute in document.descendants().flat_map(|node| node.attributes()) {
            assert!(!["id", "href", "class"].contains(&attribute.name()));
            assert!(!attribute.value().contains("url("));
        }
    }
}

#[test]
fn the_image_has_two_pixels_per_unit_and_ink() {
    let figure = two_panels();
    let image = resvg::tiny_skia::Pixmap::decode_png(&figure.png().unwrap()).unwrap();
    let svg = figure.svg().unwrap();
    let root = parsed(&svg);
    let attribute = |name| {
        root.root_element()
            .attribute(name)
            .unwrap()
            .parse::<u32>()
            .unwrap()
    };
    assert_eq!(
        (image.width(), image.height()),
        (2 * attribute("width"), 2 * attribute("height"))
    );
    assert_eq!(attribute("width"), 900);
    // The caption at the foot is letters only: they are there without any font of the machine.
    let foot = 2 * (image.height() as usize - 60) * image.width() as usize * 2;
    let dark = image.data()[foot..]
        .chunks(4)
        .filter(|pixel| pixel[0] < 0x80)
        .count();
    assert!(dark > 2_000, "{dark} dark pixels in the caption");
}

#[test]
fn a_curve_breaks_at_a_gap_and_is_cut_at_the_frame() {
    let whole = one_line(sampled(0.0, 1.0, 11, |x| x)).svg().unwrap();
    let mut figure = one_line(sampled(0.0, 1.0, 11, |x| x));
    panel_of(&mut figure).curves[0].points[5].1 = None;
    let broken = figure.svg().unwrap();
    let starts = |svg: &str| curve_data(svg, "#0072b2").join("").matches('M').count();
    // One start is the sample in the legend.
    assert_eq!((starts(&whole), starts(&broken)), (2, 3));

    let window = Rect::new(0.0, 0.0, 5.0, 2.0);
    let parts = visible_parts(
        &[
            (0.0, Some(-1.0)),
            (2.0, Some(1.0)),
            (3.0, Some(9.0)),
            (4.0, None),
            (4.5, Some(0.5)),
        ],
        &window,
    );
    assert_eq!(
        parts,
        [vec![(1.0, 0.0), (2.0, 1.0), (2.125, 2.0)], vec![(4.5, 0.5)]]
    );
}

#[test]
fn points_of_a_curve_lie_where_the_axes_say() {
    let mut figure = one_line(vec![(0.0, Some(0.0)), (0.5, Some(1.0)), (1.0, Some(0.0))]);
    let panel = panel_of(&mut figure);
    (panel.x.range, panel.y.range) = (Some((0.0, 1.0)), Some((0.0, 2.0)));
    let svg = figure.svg().unwrap();
    let curve = curve_data(&svg, "#0072b2")
        .into_iter()
        .find(|data| data.matches('L').count() == 2)
        .expect("the curve");
    let at: Vec<f64> = curve
        .split(['M', 'L', ' '])
        .filter_map(|number| number.parse().ok())
        .collect();
    let frame = frame_data(&svg);
    let edge: Vec<f64> = frame
        .split(['M', ' ', 'H', 'V', 'z'])
        .filter_map(|number| number.parse().ok())
        .collect();
    let [x0, y0, x1, y1, x2, y2] = at[..] else {
        panic!("{at:?}")
    };
    let [left, top, right, bottom, ..] = edge[..] else {
        panic!("{edge:?}")
    };
    let (width, height) = (right - left, bottom - top);
    // Coordinates are rounded to hundredths.
    let near = |a: f64, b: f64| assert!((a - b).abs() < 0.011, "{a} is not {b}");
    near(x0, left);
    near(x1, left + 0.5 * width);
    near(x2, left + width);
    near(y0, top + height);
    near(y1, top + 0.5 * height);
    near(y2, y0);
}

#[test]
fn what_cannot_be_drawn_is_refused_by_name() {
    let message = |figure: &Figure| figure.svg().expect_err("must be refused").to_string();
    let nan = one_line(vec![(0.0, Some(1.0)), (1.0, Some(f64::NAN))]);
    assert_eq!(
        message(&nan),
        "figure-1: the curve \"λ_s\" has y = NaN at its point 1; every value must be finite (a gap is None)"
    );
    assert!(nan.png().is_err() && nan.csv().is_err());
    assert!(message(&one_line(vec![(f64::INFINITY, None)])).contains("x = inf at its point 0"));
    assert!(message(&one_line(vec![(0.0, None)])).contains("no point to draw"));
    assert!(
        message(&one_line(vec![(-1e308, Some(0.0)), (1e308, Some(0.0))]))
            .contains("the range must be")
    );

    let mut figure = one_line(vec![(0.0, Some(1.0))]);
    panel_of(&mut figure).y.range = Some((1.0, 1.0));
    assert_eq!(
        message(&figure),
        "figure-1: axis \"y\" from 1 to 1; the range must be finite and go upwards"
    );
    figure.plot = Plot::Panels(Vec::new());
    assert_eq!(message(&figure), "figure-1: 0 panels; a figure has 1 or 2");

    let broken = |change: &dyn Fn(&mut Map)| {
        let mut figure = map_figure();
        if let Plot::Map(map) = &mut figure.plot {
            change(map);
        }
        message(&figure)
    };
    assert!(broken(&|map| map.values.truncate(9)).contains("9 values on a map of 81 × 73 points"));
    assert!(broken(&|map| map.y_values[3] = 0.0).contains("y values do not increase at index 3"));
    assert!(broken(&|map| map.values[7] = Some(f64::NAN)).contains("value = NaN at its point 7"));
}

#[test]
fn an_empty_panel_with_ranges_is_a_frame() {
    let mut figure = one_line(Vec::new());
    let panel = panel_of(&mut figure);
    (panel.x.range, panel.y.range) = (Some((0.0, 1.0)), Some((-1.0, 1.0)));
    let shown = texts(&figure.svg().unwrap());
    assert!(shown.contains(&"−0.5".to_owned()), "{shown:?}");
}

#[test]
fn a_single_point_and_extreme_numbers_are_drawn() {
    for (x, y) in [
        (0.0, 0.0),
        (1.0, -3.0),
        (1e-300, 1e300),
        (5e-324, 1e-320),
        (1e15, 1e-15),
    ] {
        let svg = one_line(vec![(x, Some(y))]).svg().unwrap();
        assert!(
            !svg.contains("NaN") && !svg.contains("inf"),
            "({x}, {y}): {svg}"
        );
    }
    let narrow = one_line(vec![
        (1.0, Some(1.0)),
        (1.0 + f64::EPSILON, Some(1.0 + f64::EPSILON)),
    ]);
    assert!(narrow.svg().is_ok());
}

#[test]
fn the_cells_of_a_map_leave_no_seams() {
    let mut figure = map_figure();
    let Plot::Map(map) = &mut figure.plot else {
        panic!("a map")
    };
    // Rows and columns that do not fall on whole pixels, of one colour, with nothing drawn over them.
    map.x_values = (0..98).map(f64::from).collect();
    map.y_values = (0..97).map(f64::from).collect();
    map.values = vec![Some(1.0); 98 * 97];
    (map.x.ticks, map.y.ticks) = (Ticks::Decimal, Ticks::Decimal);
    (map.levels, map.curves, map.annotations) = (Vec::new(), Vec::new(), Vec::new());
    for (index, value) in map.values.iter_mut().enumerate() {
        // Every other cell a little more: no two neighbours are one rectangle.
        *value = Some(1.0 + 0.2 * ((index + index / 98) % 2) as f64);
    }
    let image = resvg::tiny_skia::Pixmap::decode_png(&figure.png().unwrap()).unwrap();
    let background = |x: u32, y: u32| {
        image
            .pixel(x, y)
            .is_some_and(|pixel| pixel.red() > 0xe0 && pixel.blue() > 0xe0)
    };
    // Well inside the frame.
    let seams = (200..900)
        .flat_map(|x| (100..700).map(move |y| (x, y)))
        .filter(|&(x, y)| background(x, y))
        .count();
    assert_eq!(seams, 0);
}

#[test]
fn the_table_reads_back_exactly() {
    let mut figure = two_panels();
    let awkward = [0.1 + 0.2, 1.0 / 3.0, 5e-324, -1.797e308, 1e21, -0.0];
    if let Plot::Panels(panels) = &mut figure.plot {
        panels[0].curves[0].points = awkward.iter().map(|&y| (y / 2.0, Some(y))).collect();
        panels[0].curves[0].points.push((7.0, None));
    }
    let text = figure.csv().unwrap();
    let mut table = csv::Reader::from_reader(text.as_bytes());
    let header = table.headers().unwrap().clone();
    assert_eq!(
        header.iter().collect::<Vec<_>>(),
        [
            "panel",
            "curve",
            "crack depth ratio σ = a/R [–]",
            "width λ_s / ω_st [–]",
            "crack angle φ [rad]",
            "width λ_c / ω_st & more [–]"
        ]
    );
    let lines: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    for (line, y) in lines.iter().zip(awkward) {
        assert_eq!((&line[0], &line[1]), ("(a)", "l_c/L = 0.5"));
        assert_eq!(
            line[2].parse::<f64>().unwrap().to_bits(),
            (y / 2.0).to_bits()
        );
        assert_eq!(line[3].parse::<f64>().unwrap().to_bits(), y.to_bits());
    }
    assert_eq!((&lines[6][2], &lines[6][3]), ("7.0", ""));
    for line in &lines {
        // A point has the quantities of its own panel only.
        let others = if &line[0] == "(a)" { [4, 5] } else { [2, 3] };
        assert!(
            others.iter().all(|&column| line[column].is_empty()),
            "{line:?}"
        );
    }
    assert!(
        lines
            .iter()
            .any(|line| &line[1] == "σ_ZUP = 0.3414" && &line[2] == "0.3414")
    );
}

#[test]
fn the_table_of_a_map_has_a_line_for_each_point() {
    let figure = map_figure();
    let text = figure.csv().unwrap();
    let mut table = csv::Reader::from_reader(text.as_bytes());
    let lines: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    let Plot::Map(map) = &figure.plot else {
        panic!("a map")
    };
    assert_eq!(lines.len(), map.values.len() + 2 + 1);
    // The second row of the grid begins after the 81 points of the first.
    assert_eq!(lines[82][1].parse::<f64>().unwrap(), map.x_values[1]);
    assert_eq!(lines[82][2].parse::<f64>().unwrap(), map.y_values[1]);
    assert_eq!(lines[82][3].parse::<f64>().ok(), map.values[82]);
}

#[test]
fn ticks_are_round_and_written_with_equal_decimals() {
    use scale::{Ends, Scale};
    let written = |low, high, kind, ends| {
        let scale = Scale::new(low, high, kind, ends, 6.0);
        scale
            .ticks
            .iter()
            .map(|&tick| scale.write(tick))
            .collect::<Vec<_>>()
    };
    let kept = |low, high, kind| written(low, high, kind, Ends::Kept);
    assert_eq!(
        kept(0.0, 0.4, Ticks::Decimal),
        ["0", "0.1", "0.2", "0.3", "0.4"]
    );
    assert_eq!(
        kept(-1.0, 1.0, Ticks::Decimal),
        ["−1.0", "−0.5", "0", "0.5", "1.0"]
    );
    assert_eq!(kept(0.0, 3e6, Ticks::Decimal).last().unwrap(), "3.0×10⁶");
    assert_eq!(kept(0.0, 6e-7, Ticks::Decimal)[1], "1×10⁻⁷");
    assert_eq!(
        kept(0.0, PI, Ticks::FractionsOfPi),
        ["0", "π/4", "π/2", "3π/4", "π"]
    );
    assert_eq!(
        kept(-PI / 4.0, 0.0, Ticks::FractionsOfPi),
        ["−π/4", "−3π/16", "−π/8", "−π/16", "0"]
    );
    assert_eq!(
        kept(0.0, 40.0 * PI, Ticks::FractionsOfPi),
        ["0", "10π", "20π", "30π", "40π"]
    );
    assert_eq!(
        kept(0.0, PI / 2.0, Ticks::Degrees),
        ["0°", "15°", "30°", "45°", "60°", "75°", "90°"]
    );
    assert_eq!(kept(0.0, PI / 180.0, Ticks::Degrees)[1], "0.2°");
    // Rounded outwards, with room above the highest value and zero where it is near.
    assert_eq!(
        written(0.1, 0.5, Ticks::Decimal, Ends::Rounded)
            .last()
            .unwrap(),
        "0.6"
    );
    assert_eq!(written(0.1, 0.5, Ticks::Decimal, Ends::Rounded)[0], "0");
}

#[test]
fn contours_lie_on_the_level_and_stop_where_nothing_is() {
    let mut figure = map_figure();
    let Plot::Map(map) = &mut figure.plot else {
        panic!("a map")
    };
    // A plane: its contours are straight, and linear interpolation is exact.
    let plane = |x: f64, y: f64| x + 0.1 * y;
    let (xs, ys) = (map.x_values.clone(), map.y_values.clone());
    map.values = ys
        .iter()
        .flat_map(|&y| xs.iter().map(move |&x| (y < 1.0).then(|| plane(x, y))))
        .collect();
    let window = Rect::new(0.0, 0.0, 0.4, 2.0);
    let lines = contour::lines(map, 0.2, &window);
    assert_eq!(lines.len(), 1, "its pieces are joined");
    let line = &lines[0];
    assert!(line.len() > 40);
    for &(x, y) in line {
        approx(plane(x, y), 0.2);
        assert!(y <= 1.0);
    }
    // As long as the part of the line below the last whole row of the grid.
    let last = ys.iter().copied().filter(|&y| y < 1.0).fold(0.0, f64::max);
    let length: f64 = line.windows(2).map(|ends| distance(ends[0], ends[1])).sum();
    approx(length, last * 1.0_f64.hypot(0.1));
}
