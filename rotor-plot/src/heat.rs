//! A map: cells of colour, contour lines, and the bar that says what the colours mean.

use std::collections::BTreeMap;

use crate::axes::{AXIS_LETTERS, Axes, TICK, TICK_LETTERS};
use crate::contour;
use crate::figure::{Map, Ticks};
use crate::geometry::{Point, Rect, distance, hatch};
use crate::label::Fonts;
use crate::scale::{Ends, Scale, round_step};
use crate::svg::{AXIS, Anchor, Path, Svg, Text, WHITE, fill, stroke};

/// Distance of the colour bar from the frame and its width in pixels.
pub(crate) const BAR: (f64, f64) = (16.0, 14.0);
/// How many shades the colour scale has: more cannot be told apart.
const SHADES: usize = 64;
/// Size of the letters on contour lines in pixels.
const LETTERS: f64 = 10.5;
/// Colours of the ground and of its hatching where the quantity does not exist.
const NOTHING: (&str, &str) = ("#f0f0f0", "#c4c4c4");
/// How far cells reach under their right and lower neighbours in pixels, so that no viewer shows a seam.
const OVERLAP: f64 = 0.6;
/// The colour scale viridis of matplotlib at ten even steps; printed without colours its steps stay even.
const VIRIDIS: [u32; 10] = [
    0x44_01_54, 0x48_28_78, 0x3e_4a_89, 0x31_68_8e, 0x26_82_8e, 0x1f_9e_89, 0x35_b7_79, 0x6d_cd_59,
    0xb4_de_2c, 0xfd_e7_25,
];

/// Picks about `count` round values between the smallest and the largest value of a map, as levels of its contour lines;
/// none where all values are equal or there is no value.
///
/// ```
/// let values = [Some(0.5), None, Some(10.0)];
/// assert_eq!(rotor_plot::levels(&values, 5.0), [2.0, 4.0, 6.0, 8.0]);
/// ```
#[must_use]
pub fn levels(values: &[Option<f64>], count: f64) -> Vec<f64> {
    let existing = || values.iter().flatten().copied();
    let (Some(least), Some(most)) = (existing().reduce(f64::min), existing().reduce(f64::max))
    else {
        return Vec::new();
    };
    let step = round_step(most - least, count);
    let first = (least / step).floor();
    // More lines than these would be a grey area; where values nearly agree, all multiples may be the same number.
    let multiples = (0..1_000).map(|index| (first + f64::from(index)) * step);
    let levels = multiples.take_while(|&level| level < most);
    levels
        .filter(|&level| level > least && step > 0.0)
        .collect()
}

/// The scale of a map's colours; none if the quantity exists nowhere.
pub(crate) fn scale(map: &Map) -> Option<Scale> {
    let existing = || map.values.iter().flatten().copied();
    let (low, high) = (existing().reduce(f64::min)?, existing().reduce(f64::max)?);
    // The ticks of the bar are at the contours, and the bar reaches to the next tick at both ends.
    if let [first, second, ..] = map.levels[..] {
        let step = second - first;
        let (low, high) = ((low / step).floor() * step, (high / step).ceil() * step);
        let count = ((high - low) / step).round();
        return Some(Scale::new(low, high, Ticks::Decimal, Ends::Kept, count));
    }
    // A quantity that has one value everywhere is drawn in the middle of the colours.
    let around = if high > low {
        0.0
    } else {
        0.1 * low.abs().max(f64::from(low == 0.0))
    };
    // Where no value is negative, the colours do not begin below zero.
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

/// The colour of a shade.
fn colour(shade: usize) -> String {
    let place = (shade as f64 + 0.5) / SHADES as f64 * (VIRIDIS.len() - 1) as f64;
    let (below, part) = (place.floor() as usize, place.fract());
    let at = |index: usize, shift: u32| {
        let colour = VIRIDIS.get(index).copied().unwrap_or_default();
        f64::from((colour >> shift) & 0xff)
    };
    let [red, green, blue] = [16, 8, 0].map(|shift| {
        let (from, to) = (at(below, shift), at(below + 1, shift));
        (from + part * (to - from)).round() as u8
    });
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// A map in its frame.
pub(crate) struct Heat<'a> {
    pub(crate) map: &'a Map,
    pub(crate) axes: &'a Axes<'a>,
    pub(crate) frame: &'a Rect,
    pub(crate) fonts: &'a Fonts,
}

impl Heat<'_> {
    /// Draws the cells over a hatched ground, the bar and the contours; answers with the places of the contours'
    /// labels, which stay away from the points to keep clear.
    pub(crate) fn draw(&self, svg: &mut Svg, scale: Option<&Scale>, clear: &[Point]) -> Vec<Rect> {
        if !self.is_covered() {
            svg.path(&Path::of_rectangle(self.frame), &fill(NOTHING.0));
            let mut lines = Path::default();
            for segment in hatch(&self.frame.corners(), 6.0, true) {
                lines.line(&segment);
            }
            svg.path(&lines, &stroke(NOTHING.1, 0.8));
        }
        let Some(scale) = scale else {
            return Vec::new();
        };
        self.cells(svg, scale);
        self.bar(svg, scale);
        self.contours(svg, scale, clear)
    }

    /// Whether the cells cover the whole frame.
    fn is_covered(&self) -> bool {
        let reach = |values: &[f64], low: f64, high: f64| {
            values.first().is_some_and(|first| *first <= low)
                && values.last().is_some_and(|last| *last >= high)
        };
        let window = self.axes.window();
        self.map.values.iter().all(Option::is_some)
            && reach(&self.map.x_values, window.left, window.right)
            && reach(&self.map.y_values, window.top, window.bottom)
    }

    /// Edges of the cells about positions on the page: half way to the neighbours, and at the frame's ends.
    fn edges(positions: &[f64], (least, most): (f64, f64)) -> Vec<f64> {
        let between = positions
            .iter()
            .zip(positions.iter().skip(1))
            .map(|(a, b)| 0.5 * (a + b));
        let ends = (positions.first().copied(), positions.last().copied());
        let all = ends.0.into_iter().chain(between).chain(ends.1);
        all.map(|edge| edge.max(least).min(most)).collect()
    }

    /// Draws the cells, a path for each shade; neighbours in a row that share a shade are one rectangle.
    fn cells(&self, svg: &mut Svg, scale: &Scale) {
        let (map, frame, window) = (self.map, self.frame, self.axes.window());
        let x = map
            .x_values
            .iter()
            .map(|&x| self.axes.at((x, window.top), frame).0);
        let y = map
            .y_values
            .iter()
            .map(|&y| self.axes.at((window.left, y), frame).1);
        let x = Self::edges(&x.collect::<Vec<_>>(), (frame.left, frame.right));
        let y = Self::edges(&y.collect::<Vec<_>>(), (frame.top, frame.bottom));
        let shade = |value: f64| ((scale.share(value) * SHADES as f64) as usize).min(SHADES - 1);
        let mut shades: BTreeMap<usize, Path> = BTreeMap::new();
        let rows = y
            .iter()
            .zip(y.iter().skip(1))
            .zip(map.values.chunks(map.x_values.len()));
        for ((&bottom, &top), row) in rows {
            let cells = x.iter().zip(x.iter().skip(1)).zip(row);
            let cells: Vec<_> = cells
                .map(|((a, b), value)| (*a, *b, value.map(shade)))
                .collect();
            for same in cells.chunk_by(|a, b| a.2 == b.2) {
                let (Some(&(left, _, Some(shade))), Some(&(_, right, _))) =
                    (same.first(), same.last())
                else {
                    continue;
                };
                if left < right && top < bottom {
                    let (right, bottom) = (
                        (right + OVERLAP).min(frame.right),
                        (bottom + OVERLAP).min(frame.bottom),
                    );
                    shades
                        .entry(shade)
                        .or_default()
                        .rectangle(&Rect::new(left, top, right, bottom));
                }
            }
        }
        for (shade, path) in shades {
            svg.path(&path, &crisp(shade));
        }
    }

    /// Draws the colour bar with its ticks and its label.
    fn bar(&self, svg: &mut Svg, scale: &Scale) {
        let left = self.frame.right + BAR.0;
        let bar = Rect {
            left,
            right: left + BAR.1,
            ..*self.frame
        };
        let at = |share: f64| bar.bottom - share * (bar.bottom - bar.top);
        for shade in 0..SHADES {
            let share = |k: usize| k as f64 / SHADES as f64;
            let bottom = (at(share(shade)) + OVERLAP).min(bar.bottom);
            let step = Rect {
                top: at(share(shade + 1)),
                bottom,
                ..bar
            };
            svg.path(&Path::of_rectangle(&step), &crisp(shade));
        }
        let mut ticks = Path::default();
        for &tick in &scale.ticks {
            let y = at(scale.share(tick));
            ticks.line(&[(bar.right, y), (bar.right + TICK, y)]);
            let label = scale.write(tick);
            svg.write(
                &label,
                (bar.right + 2.0 * TICK, y),
                TICK_LETTERS,
                Anchor::Start,
            );
        }
        svg.path(&Path::of_rectangle(&bar), &stroke(AXIS, 1.0));
        svg.path(&ticks, &stroke(AXIS, 1.0));
        let at = (
            self.frame.right + self.axes.beside.1 - 0.5 * AXIS_LETTERS - 2.0,
            bar.centre().1,
        );
        let label = Text::new(&self.map.value_label, at, AXIS_LETTERS, Anchor::Middle);
        svg.text(&Text {
            upwards: true,
            ..label
        });
    }

    /// Draws the contour lines and, where there is room, their labels; answers with the places of these.
    fn contours(&self, svg: &mut Svg, scale: &Scale, clear: &[Point]) -> Vec<Rect> {
        let mut labels: Vec<(String, Rect)> = Vec::new();
        let mut clear = clear.to_vec();
        for &level in &self.map.levels {
            let mut path = Path::default();
            let mut points = Vec::new();
            for line in contour::lines(self.map, level, &self.axes.window()) {
                let line: Vec<_> = line
                    .into_iter()
                    .map(|point| self.axes.at(point, self.frame))
                    .collect();
                path.line(&line);
                points.extend(line);
            }
            svg.path(&path, &stroke(WHITE, 1.1));
            let label = scale.write(level);
            let size = (self.fonts.width(&label, LETTERS) + 4.0, LETTERS + 3.0);
            let boxes = points.iter().map(|&point| Rect::around(point, size));
            let free = boxes.filter(|place| labels.iter().all(|(_, other)| !place.meets(other)));
            if let Some(place) = self.roomiest(free, &clear) {
                clear.push(place.centre());
                labels.push((label, place));
            }
        }
        for (label, place) in &labels {
            svg.path(&Path::of_rectangle(place), &fill(WHITE));
            svg.write(label, place.centre(), LETTERS, Anchor::Middle);
        }
        labels.into_iter().map(|label| label.1).collect()
    }

    /// The place inside the frame that is farthest from the points to keep clear.
    fn roomiest(&self, places: impl Iterator<Item = Rect>, clear: &[Point]) -> Option<Rect> {
        let [first, _, last, _] = self.frame.corners();
        let inside = places.filter(|place| {
            // Places at the edge are left out: a label there would hide the frame.
            place.left > first.0 + 3.0
                && place.top > first.1 + 3.0
                && place.right < last.0 - 3.0
                && place.bottom < last.1 - 3.0
        });
        let room = |place: &Rect| {
            let nearest = clear
                .iter()
                .map(|&point| distance(point, place.centre()))
                .reduce(f64::min);
            // Where there is no point to keep clear of, the middle of the frame is best.
            nearest.unwrap_or(-distance(self.frame.centre(), place.centre()))
        };
        inside
            .map(|place| (room(&place), place))
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .map(|best| best.1)
    }
}

/// Attributes of a cell: smoothed edges would show as seams between neighbours.
fn crisp(shade: usize) -> String {
    format!("{} shape-rendering=\"crispEdges\"", fill(&colour(shade)))
}
