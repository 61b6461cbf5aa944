//! What holds for every document: its numbers are numbers, and its texts stand on the page and not on each other.

use proptest::prelude::*;

use super::*;
use crate::label::{Fonts, Level, Run, Shape};

/// A logarithmic map with a hatched part, and an area on logarithmic axes with numbers that are long to write.
fn logarithmic() -> Vec<Figure> {
    let mut mapped = map_figure();
    if let Plot::Map(map) = &mut mapped.plot {
        map.x_values = (0..81)
            .map(|k| 10f64.powf(f64::from(k) / 16.0 - 3.0))
            .collect();
        map.x.ticks = Ticks::Logarithmic;
        (map.curves, map.annotations) = (Vec::new(), Vec::new());
    }
    let mut curved = one_line(sampled(1.0, 9.0, 30, |x| 1e-7 * 10f64.powf(x)));
    let panel = panel_of(&mut curved);
    (panel.x.ticks, panel.y.ticks) = (Ticks::Logarithmic, Ticks::Logarithmic);
    panel.curves[0].mark = Mark::Area;
    panel.title = "kg^{2} of &lt; <b>".to_owned();
    let long = one_line(sampled(1e-9, 1.234_567e-9, 9, |x| 1e12 * x + 3.0));
    vec![mapped, curved, long]
}

/// Four small maps, the wide titles of which need a row of the legend each.
fn small_maps() -> Figure {
    let Figure {
        name,
        caption,
        plot,
    } = map_figure();
    let Plot::Map(map) = plot else {
        panic!("a map")
    };
    let titled = |k: usize| Map {
        title: format!("Δ_d = 0.{k}, φ = {k}0°, *l*_c/*L* = 0.5 and so on and on"),
        ..(*map).clone()
    };
    Figure {
        name,
        caption,
        plot: Plot::Maps((0..4).map(titled).collect()),
    }
}

fn figures() -> Vec<Figure> {
    let mut figures = vec![two_panels(), map_figure(), small_maps()];
    figures.extend(logarithmic());
    figures
}

/// A text of a document and the rectangle that it takes, by the metrics of the embedded fonts.
fn placed(svg: &str) -> Vec<(String, Rect)> {
    let document = parsed(svg);
    let number =
        |node: roxmltree::Node, name| -> Option<f64> { node.attribute(name)?.parse().ok() };
    let is_text = |node: &roxmltree::Node| node.has_tag_name("text");
    let mut placed = Vec::new();
    for text in document.descendants().filter(is_text) {
        let size = number(text, "font-size").expect("a size");
        let run = |node: roxmltree::Node| Run {
            text: node.text().unwrap_or_default().to_owned(),
            shape: match (node.attribute("font-style"), node.attribute("font-weight")) {
                (Some(_), _) => Shape::Italic,
                (_, Some(_)) => Shape::Bold,
                _ => Shape::Upright,
            },
            level: node
                .attribute("font-size")
                .map_or(Level::Base, |_| Level::Subscript),
        };
        let runs: Vec<Run> = text.children().map(run).collect();
        let width = Fonts::embedded().unwrap().width_of(&runs, size);
        let (x, y) = (number(text, "x").unwrap(), number(text, "y").unwrap());
        let before = match text.attribute("text-anchor") {
            None => 0.0,
            Some("middle") => 0.5 * width,
            Some(_) => width,
        };
        // From the top of a capital to the baseline; what hangs below is less than the space between two labels.
        let (left, top) = (-before, -0.73 * size);
        let (right, bottom) = (left + width, 0.0);
        let rect = if text.attribute("transform").is_some() {
            Rect::new(x + top, y - right, x + bottom, y - left)
        } else {
            Rect::new(x + left, y + top, x + right, y + bottom)
        };
        placed.push((runs.into_iter().map(|run| run.text).collect(), rect));
    }
    placed
}

/// The numbers of an attribute that has numbers.
fn numbers<'a>(name: &str, value: &'a str) -> Vec<&'a str> {
    let numeric = [
        "x",
        "y",
        "width",
        "height",
        "viewBox",
        "font-size",
        "dy",
        "d",
        "transform",
        "stroke-width",
        "stroke-dasharray",
    ];
    if !numeric.contains(&name) {
        return Vec::new();
    }
    let separates = |letter: char| letter.is_alphabetic() || " (),".contains(letter);
    value
        .split(separates)
        .filter(|number| !number.is_empty())
        .collect()
}

/// Checks the numbers of a document, and the places of its texts.
fn check(svg: &str) {
    let document = parsed(svg);
    for attribute in document.descendants().flat_map(|node| node.attributes()) {
        for number in numbers(attribute.name(), attribute.value()) {
            let value: f64 = number.parse().unwrap_or(f64::NAN);
            assert!(value.is_finite() && value.abs() < 1e5, "{attribute:?}");
            let decimals = number
                .split_once('.')
                .map_or(0, |(_, decimals)| decimals.len());
            assert!(decimals <= 2, "{attribute:?}");
        }
    }
    let size = |name| {
        document
            .root_element()
            .attribute(name)
            .unwrap()
            .parse()
            .unwrap()
    };
    let page = Rect::at((0.0, 0.0), (size("width"), size("height")));
    let placed = placed(svg);
    assert!(!placed.is_empty());
    for (index, (text, rect)) in placed.iter().enumerate() {
        assert!(
            rect.corners().iter().all(|&corner| page.holds(corner)),
            "{text} leaves the page: {rect:?}"
        );
        for (other, taken) in &placed[..index] {
            assert!(!rect.meets(taken), "{text} on {other}: {rect:?} {taken:?}");
        }
    }
}

#[test]
fn numbers_parse_and_texts_stand_apart_on_the_page() {
    for figure in figures() {
        check(&figure.svg().unwrap());
    }
}

#[test]
fn every_format_is_what_its_name_says() {
    let starts: [&[u8]; 3] = [b"<svg", b"\x89PNG", b"%PDF"];
    for figure in figures() {
        for (format, start) in Format::ALL.into_iter().zip(starts) {
            let drawn = figure.draw(format).unwrap();
            assert!(drawn.starts_with(start), "{format:?}");
            assert_eq!(drawn, figure.draw(format).unwrap(), "the same bytes again");
        }
    }
}

#[test]
fn letters_of_every_shape_are_in_the_pixels() {
    // Each label alone on a panel, beside the same panel without it.
    for label in [
        "upright",
        "*slanted*",
        "π",
        "λ_{st}",
        "×10⁻⁷",
        "m^{2}",
        "−½ ≤ φ",
    ] {
        let ink = |note: &str| {
            let mut figure = one_line(Vec::new());
            let panel = panel_of(&mut figure);
            (panel.x.range, panel.y.range) = (Some((0.0, 1.0)), Some((0.0, 1.0)));
            panel.note = note.to_owned();
            let image = resvg::tiny_skia::Pixmap::decode_png(&figure.png().unwrap()).unwrap();
            image
                .pixels()
                .iter()
                .filter(|pixel| pixel.red() < 0x40)
                .count()
        };
        assert!(ink(label) > ink("") + 20, "{label}");
    }
}

#[test]
fn a_picture_names_itself_to_who_cannot_see_it() {
    let svg = two_panels().svg().unwrap();
    let document = parsed(&svg);
    let text = |name| {
        let node = document
            .root_element()
            .children()
            .find(|node| node.has_tag_name(name));
        node.and_then(|node| node.text()).unwrap_or_default()
    };
    assert_eq!(text("title"), "figure-4");
    assert!(
        text("desc").contains("crack model support-arm. Lines: Eq. (31)"),
        "{}",
        text("desc")
    );
}

#[test]
fn curves_differ_without_colours() {
    let curves = (0..6).map(|k| {
        let points = sampled(0.0, 1.0, 9, |x| x * k as f64);
        line(&format!("case {k}"), k, Dash::of(k), points)
    });
    let mut figure = one_line(Vec::new());
    panel_of(&mut figure).curves = curves.collect();
    let svg = figure.svg().unwrap();
    let document = parsed(&svg);
    let patterns: std::collections::BTreeSet<_> = document
        .descendants()
        .filter(|node| node.attribute("stroke-width") == Some("1.8"))
        .map(|node| node.attribute("stroke-dasharray"))
        .collect();
    assert_eq!(patterns.len(), 6, "{patterns:?}");
}

#[test]
fn an_area_is_cut_at_the_frame_and_hatched() {
    let corners = [(-1.0, 0.2), (2.0, 0.2), (2.0, 0.8), (-1.0, 0.8)];
    let mut figure = one_line(corners.map(|(x, y)| (x, Some(y))).to_vec());
    let panel = panel_of(&mut figure);
    panel.curves[0].mark = Mark::Area;
    (panel.x.range, panel.y.range) = (Some((0.0, 1.0)), Some((0.0, 1.0)));
    let svg = figure.svg().unwrap();
    check(&svg);
    let of_width = |width: &str| -> String {
        let document = parsed(&svg);
        let node = document
            .descendants()
            .find(|node| node.attribute("stroke-width") == Some(width));
        node.and_then(|node| node.attribute("d"))
            .expect("a path")
            .to_owned()
    };
    let (outline, hatching, frame) = (of_width("1.2"), of_width("0.8"), frame_data(&svg));
    // `frame_data` answers with the first closed outline, which is the area's.
    assert_eq!(outline, frame);
    let xs: Vec<f64> = numbers("d", &outline)
        .iter()
        .step_by(2)
        .map(|x| x.parse().unwrap())
        .collect();
    let (least, most) = (
        xs.iter().copied().reduce(f64::min),
        xs.iter().copied().reduce(f64::max),
    );
    // From the vertical axis on, over a frame of 555 pixels at least.
    assert!(least > Some(40.0) && most < Some(630.0), "{outline}");
    assert!(
        most.zip(least)
            .is_some_and(|(most, least)| most - least > 500.0)
    );
    assert!(hatching.matches('M').count() > 50);
}

#[test]
fn a_dash_runs_on_along_a_contour() {
    let Plot::Map(map) = map_figure().plot else {
        panic!("a map")
    };
    // A circle about the middle: one closed line, its end where it began.
    let round = |x: f64, y: f64| (x - 0.2).hypot(0.2 * (y - 0.8));
    let values = map
        .y_values
        .iter()
        .flat_map(|&y| map.x_values.iter().map(move |&x| Some(round(x, y))));
    let map = Map {
        values: values.collect(),
        ..*map.clone()
    };
    let line = map.level_line(0.1);
    let gaps = line.iter().filter(|point| point.1.is_none()).count();
    assert_eq!((gaps, line[0].1), (1, line[line.len() - 2].1));
}

#[test]
fn too_much_is_refused() {
    let mut figure = one_line(sampled(0.0, 1.0, 5, |x| x));
    panel_of(&mut figure).x.ticks = Ticks::Logarithmic;
    let message = figure.svg().unwrap_err().to_string();
    assert_eq!(
        message,
        "figure-1: axis \"x\" from 0; a logarithmic axis must begin above 0"
    );
    figure = one_line(sampled(0.0, 1.0, 5, |x| x));
    figure.caption = "word ".repeat(100_000);
    let error = figure.svg().unwrap_err();
    assert!(
        matches!(error.kind, PlotErrorKind::TooHigh { .. }),
        "{error}"
    );
}

/// A number of any size that figures meet.
fn value() -> impl Strategy<Value = f64> {
    prop_oneof![
        -2.0..2.0,
        Just(0.0),
        (-30.0..30.0).prop_map(|e: f64| 10f64.powf(e)),
        -1e300..1e300
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn any_curve_is_drawn_on_the_page_or_refused(
        points in prop::collection::vec((value(), prop::option::weighted(0.9, value())), 1..12),
        ranges in prop::collection::vec((value(), value()), 2),
        (ranged, logarithmic, mark) in (any::<[bool; 2]>(), any::<[bool; 2]>(), 0..3),
    ) {
        let mut figure = one_line(points);
        let panel = panel_of(&mut figure);
        panel.curves[0].mark = [Mark::Line(Dash::Dotted), Mark::Points(Symbol::Square), Mark::Area][mark as usize];
        for (index, axis) in [&mut panel.x, &mut panel.y].into_iter().enumerate() {
            axis.range = ranged[index].then_some(ranges[index]);
            if logarithmic[index] {
                axis.ticks = Ticks::Logarithmic;
            }
        }
        if let Ok(svg) = figure.svg() {
            check(&svg);
        }
    }
}
