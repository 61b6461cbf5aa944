//! A heat map: cells of colour, contour lines, and the bar that says what the colours mean.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::canvas::{pixels, stroke, units};
use super::frame::{self, Frame, Layout};
use super::panel::{self, Drawing, Legend, Page};
use super::text::{self, Fonts, Shape};
use super::ticks::{Ends, Scale};
use super::{Axis, Figure, FigureError, Map, Ticks};

/// Distance of the colour bar from the frame and its width in pixels.
const BAR: (f64, f64) = (16.0, 14.0);
/// Shades of the colour scale.
const SHADES: usize = 64;
/// Size of a contour's label in pixels.
const LETTERS: f64 = 10.5;
/// Where the quantity does not exist.
const NOTHING: RGBColor = RGBColor(0xf0, 0xf0, 0xf0);

/// Lays a map out at a place of a size in pixels, its legend above not counted.
pub(super) fn layout(
    figure: &Figure,
    map: &Map,
    fonts: &Fonts,
    (at, size): ((f64, f64), (f64, f64)),
) -> Result<Layout, FigureError> {
    let of = |axis: &Axis, values: &[f64]| {
        frame::scale(figure, "", axis, values.iter().copied(), (Ends::Kept, 6.0))
    };
    let (x, y) = (of(&map.x, &map.x_values)?, of(&map.y, &map.y_values)?);
    let bar = bar_scale(map).map_or(0.0, |scale| BAR.0 + BAR.1 + Layout::beside(&scale, fonts));
    let left = Layout::beside(&y, fonts);
    let mut layout = Layout {
        at,
        size,
        margin: (0.0, bar.max(18.0)),
        x,
        y,
        left,
    };
    let legend = Legend::new(&map.title, &map.curves, fonts, layout.frame_width()).height();
    layout.margin.0 = legend + 8.0;
    layout.size.1 += legend;
    Ok(layout)
}

/// The scale of the colours; none if the quantity exists nowhere.
fn bar_scale(map: &Map) -> Option<Scale> {
    let existing = || map.values.iter().flatten().copied();
    let (low, high) = (existing().reduce(f64::min)?, existing().reduce(f64::max)?);
    // The contours are ticks of the bar, which goes on to the next ones.
    if let [first, second, ..] = map.levels[..] {
        let step = second - first;
        let (low, high) = ((low / step).floor() * step, (high / step).ceil() * step);
        let count = ((high - low) / step).round();
        return Some(Scale::new(low, high, Ticks::Decimal, Ends::Kept, count));
    }
    // A quantity that is the same everywhere has the middle of the colours.
    let around = if high > low {
        0.0
    } else {
        0.1 * low.abs().max(f64::from(low == 0.0))
    };
    // The colours of what is never negative do not begin below zero.
    let least = if low < 0.0 {
        low - around
    } else {
        (low - around).max(0.0)
    };
    Some(Scale::new(
        least,
        high + around,
        Ticks::Decimal,
        Ends::Kept,
        7.0,
    ))
}

/// Draws a map into a layout.
pub(super) fn draw(
    page: &Page<'_>,
    map: &Map,
    layout: &Layout,
    fonts: &Fonts,
) -> Result<(), Drawing> {
    let frame = frame::axes(page, (&map.x, &map.y), layout, false)?;
    let corners = [(frame.left(), frame.top()), (frame.right(), frame.bottom())];
    page.draw(&Rectangle::new(corners, NOTHING.filled()))?;
    let mut contour_labels = Vec::new();
    if let Some(scale) = bar_scale(map) {
        cells(page, &frame, map, &scale)?;
        bar(page, &frame, map, &scale)?;
        contour_labels = contours(page, &frame, map, (&scale, fonts))?;
    }
    panel::curves(page, &frame, &map.curves)?;
    frame.outline(page)?;
    let drawn = (&map.curves[..], &map.annotations[..]);
    frame::annotations(page, &frame, drawn, &contour_labels, fonts)?;
    frame::note(page, &frame, &map.note, fonts)?;
    Legend::new(&map.title, &map.curves, fonts, pixels(frame.width())).draw(page, &frame)
}

/// The shade of a value.
fn shade(scale: &Scale, value: f64) -> usize {
    let share = (value - scale.low) / (scale.high - scale.low);
    ((share * SHADES as f64) as usize).min(SHADES - 1)
}

/// The colour of a shade.
fn colour(shade: usize) -> RGBColor {
    ViridisRGB.get_color((shade as f64 + 0.5) / SHADES as f64)
}

/// Edges of the cells about the values of an axis: half way to the neighbours, and at the window's ends.
fn edges(values: &[f64], window: (f64, f64)) -> Vec<f64> {
    let between = values
        .iter()
        .zip(values.iter().skip(1))
        .map(|(a, b)| 0.5 * (a + b));
    let ends = (values.first().copied(), values.last().copied());
    let all = ends.0.into_iter().chain(between).chain(ends.1);
    all.map(|edge| edge.clamp(window.0, window.1)).collect()
}

/// Draws the cells, shade by shade; neighbours in a row that share a shade are one rectangle.
fn cells(page: &Page<'_>, frame: &Frame<'_>, map: &Map, scale: &Scale) -> Result<(), Drawing> {
    let (x_window, y_window) = frame.window();
    let (x, y) = (
        edges(&map.x_values, x_window),
        edges(&map.y_values, y_window),
    );
    let mut spans: Vec<(usize, Segment)> = Vec::new();
    let rows = y
        .iter()
        .zip(y.iter().skip(1))
        .zip(map.values.chunks(map.x_values.len()));
    for ((&low, &high), row) in rows {
        let mut before = None;
        for ((&left, &right), value) in x.iter().zip(x.iter().skip(1)).zip(row) {
            let here = value.map(|value| shade(scale, value));
            match (here, spans.last_mut()) {
                (Some(_), Some(span)) if here == before => span.1.1.0 = right,
                (Some(here), _) => spans.push((here, ((left, low), (right, high)))),
                (None, _) => {}
            }
            before = here;
        }
    }
    spans.sort_by_key(|span| span.0);
    for (shade, (from, to)) in spans {
        let ((left, bottom), (right, top)) = (frame.at(from), frame.at(to));
        if left < right && top < bottom {
            page.draw(&Rectangle::new(
                [(left, top), (right, bottom)],
                colour(shade).filled(),
            ))?;
        }
    }
    Ok(())
}

/// Draws the colour bar.
fn bar(page: &Page<'_>, frame: &Frame<'_>, map: &Map, scale: &Scale) -> Result<(), Drawing> {
    let left = frame.right() + units(BAR.0);
    let right = left + units(BAR.1);
    let (top, height) = (frame.top(), frame.bottom() - frame.top());
    let at = |share: f64| top + ((1.0 - share) * f64::from(height)).round() as i32;
    for shade in 0..SHADES {
        let share = |k: usize| k as f64 / SHADES as f64;
        let corners = [(left, at(share(shade + 1))), (right, at(share(shade)))];
        page.draw(&Rectangle::new(corners, colour(shade).filled()))?;
    }
    let line = frame::AXIS.stroke_width(stroke(1.0));
    page.draw(&Rectangle::new([(left, top), (right, top + height)], line))?;
    for &tick in &scale.ticks {
        let y = at((tick - scale.low) / (scale.high - scale.low));
        page.draw(&PathElement::new(
            vec![(right, y), (right + units(frame::TICK), y)],
            line,
        ))?;
    }
    for &tick in &scale.ticks {
        let y = at((tick - scale.low) / (scale.high - scale.low));
        let beside = (right + units(2.0 * frame::TICK), y);
        frame::write(
            page,
            &scale.write(tick),
            beside,
            frame::TICK_LETTERS,
            FontStyle::Normal,
        )?;
    }
    let font = ("sans-serif", units(frame::AXIS_LETTERS)).into_font();
    let style = TextStyle::from(font.transform(FontTransform::Rotate270)).color(&frame::INK);
    let style = style.pos(Pos::new(HPos::Center, VPos::Bottom));
    let edge = page.dim_in_pixel().0.cast_signed() - units(10.0);
    page.draw_text(&map.value_label, &style, (edge, top + height / 2))
}

/// Draws the contour lines and, where there is room, their labels; answers with points along the
/// labels.
fn contours(
    page: &Page<'_>,
    frame: &Frame<'_>,
    map: &Map,
    (scale, fonts): (&Scale, &Fonts),
) -> Result<Vec<(i32, i32)>, Drawing> {
    let line = WHITE.mix(0.9).stroke_width(stroke(1.1));
    let mut taken = frame::along_curves(frame, &map.curves);
    taken.extend(map.annotations.iter().map(|note| frame.at(note.at)));
    let mut labels = Vec::new();
    for &level in &map.levels {
        let segments = contour(map, level, frame.window());
        let on_page: Vec<_> = segments
            .iter()
            .map(|&(from, to)| [frame.at(from), frame.at(to)])
            .collect();
        for segment in &on_page {
            page.draw(&PathElement::new(segment.to_vec(), line))?;
        }
        let label = scale.write(level);
        let width = units(fonts.width(&text::parse(&label, Shape::Upright), LETTERS) + 4.0);
        if let Some(at) = roomiest(&on_page, frame, width, &taken) {
            taken.push(at);
            labels.push((label, at, width));
        }
    }
    let mut covered = Vec::new();
    for (label, (x, y), width) in labels {
        let height = units(LETTERS + 3.0);
        let corners = [
            (x - width / 2, y - height / 2),
            (x + width / 2, y + height / 2),
        ];
        page.draw(&Rectangle::new(corners, WHITE.mix(0.75).filled()))?;
        let left = (x - width / 2 + units(2.0), y);
        frame::write(page, &label, left, LETTERS, FontStyle::Normal)?;
        covered.extend([x - width / 2, x, x + width / 2].map(|x| (x, y)));
    }
    Ok(covered)
}

/// The middle of the segment that is farthest from what is taken and not at the edge of the frame.
fn roomiest(
    segments: &[[(i32, i32); 2]],
    frame: &Frame<'_>,
    width: i32,
    taken: &[(i32, i32)],
) -> Option<(i32, i32)> {
    let middles = segments
        .iter()
        .map(|[a, b]| ((a.0 + b.0) / 2, (a.1 + b.1) / 2));
    let inside = middles.filter(|&(x, y)| {
        (frame.left() + width..frame.right() - width).contains(&x)
            && (frame.top() + units(LETTERS)..frame.bottom() - units(LETTERS)).contains(&y)
    });
    let room = |&(x, y): &(i32, i32)| {
        let away = |&(x1, y1): &(i32, i32)| (i64::from(x - x1)).pow(2) + (i64::from(y - y1)).pow(2);
        // Without a neighbour the middle of the frame is best.
        let centre = (
            (frame.left() + frame.right()) / 2,
            (frame.top() + frame.bottom()) / 2,
        );
        taken.iter().map(away).min().unwrap_or(-away(&centre))
    };
    inside.max_by_key(room)
}

/// Two points of the plot: the ends of a straight piece of a contour line, or opposite corners.
pub(super) type Segment = ((f64, f64), (f64, f64));

/// The contour line of a level in pieces, by marching squares with linear interpolation. Squares with a corner where
/// the quantity does not exist, or outside the window, have none.
pub(super) fn contour(
    map: &Map,
    level: f64,
    (x_window, y_window): ((f64, f64), (f64, f64)),
) -> Vec<Segment> {
    let columns = map.x_values.len();
    let value = |i: usize, j: usize| map.values.get(j * columns + i).copied().flatten();
    let corner = |i: usize, j: usize| {
        let at = (*map.x_values.get(i)?, *map.y_values.get(j)?);
        let within =
            (x_window.0..=x_window.1).contains(&at.0) && (y_window.0..=y_window.1).contains(&at.1);
        within.then_some((at, value(i, j)?))
    };
    let mut segments = Vec::new();
    for j in 0..map.y_values.len() {
        for i in 0..columns {
            // Round the square: each side's first corner is the last side's second one.
            let square = [
                corner(i, j),
                corner(i + 1, j),
                corner(i + 1, j + 1),
                corner(i, j + 1),
            ];
            if let [Some(a), Some(b), Some(c), Some(d)] = square {
                segments.extend(in_square([a, b, c, d], level));
            }
        }
    }
    segments
}

/// A corner of a square with its value.
type Corner = ((f64, f64), f64);

/// The pieces of a contour line in one square.
fn in_square([a, b, c, d]: [Corner; 4], level: f64) -> Vec<Segment> {
    let crossing = |from: Corner, to: Corner| {
        let t = (level - from.1) / (to.1 - from.1);
        let along = |u: f64, v: f64| u + t * (v - u);
        ((from.1 < level) != (to.1 < level))
            .then(|| (along(from.0.0, to.0.0), along(from.0.1, to.0.1)))
    };
    let sides = [
        crossing(a, b),
        crossing(b, c),
        crossing(c, d),
        crossing(d, a),
    ];
    if let [Some(ab), Some(bc), Some(cd), Some(da)] = sides {
        // A saddle: the mean decides which two corners belong together.
        let high_middle = 0.25 * (a.1 + b.1 + c.1 + d.1) >= level;
        return if (a.1 >= level) == high_middle {
            vec![(ab, bc), (cd, da)]
        } else {
            vec![(da, ab), (bc, cd)]
        };
    }
    let found: Vec<(f64, f64)> = sides.into_iter().flatten().collect();
    if let [from, to] = found[..] {
        vec![(from, to)]
    } else {
        Vec::new()
    }
}
