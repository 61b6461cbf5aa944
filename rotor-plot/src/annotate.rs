//! Labelled points, and where their labels stand so that they cover least.

use crate::geometry::{Point, Rect, distance};
use crate::label::Fonts;
use crate::svg::{AXIS, Anchor, INK, Path, Svg, WHITE, fill, stroke};

/// Size of the letters in pixels.
const LETTERS: f64 = 11.5;
/// Distances of a label from its point in pixels.
const DISTANCES: [f64; 6] = [7.0, 20.0, 38.0, 60.0, 90.0, 130.0];
/// A label at least this far away in pixels has a line to its point.
const FAR: f64 = 12.0;

/// What a label should not cover.
pub(crate) struct Around<'a> {
    /// The frame, which no label leaves.
    pub(crate) frame: &'a Rect,
    /// Points every few pixels along the curves.
    pub(crate) curves: &'a [Point],
    /// Labels that are on the page already.
    pub(crate) labels: &'a [Rect],
}

/// Draws labelled points of the page.
pub(crate) fn draw(svg: &mut Svg, notes: &[(&str, Point)], around: &Around<'_>, fonts: &Fonts) {
    let points: Vec<Point> = notes.iter().map(|note| note.1).collect();
    let mut placed: Vec<Rect> = around.labels.to_vec();
    for &(label, at) in notes {
        let places = places(at, fonts.width(label, LETTERS));
        let costs = places
            .iter()
            .map(|place| cost(place, at, &points, around, &placed));
        let best = places.iter().zip(costs).min_by_key(|(_, cost)| *cost);
        let Some((&place, _)) = best else { continue };
        if place.distance(at) > FAR {
            let mut line = Path::default();
            line.line(&[at, place.nearest(at)]);
            svg.path(&line, &stroke(WHITE, 2.4));
            svg.path(&line, &stroke(AXIS, 0.9));
        }
        svg.path(&Path::of_rectangle(&place), &fill(WHITE));
        svg.write(label, place.centre(), LETTERS, Anchor::Middle);
        placed.push(place);
    }
    for (colour, radius) in [(WHITE, 4.6), (INK, 3.4)] {
        let mut dots = Path::default();
        points.iter().for_each(|&at| dots.circle(at, radius));
        svg.path(&dots, &fill(colour));
    }
}

/// Weighs what is wrong with a place for the label of the point `at`: curves that it covers or that its line to the point
/// crosses, a point that is nearer than its own, other labels and points under it, and corners outside the frame.
fn cost(place: &Rect, at: Point, points: &[Point], around: &Around<'_>, placed: &[Rect]) -> usize {
    let covered = around
        .curves
        .iter()
        .filter(|&&point| place.holds(point))
        .count();
    let to = place.nearest(at);
    let crossed = around
        .curves
        .iter()
        .filter(|&&point| crosses(point, at, to))
        .count();
    let astray = points
        .iter()
        .any(|&other| place.distance(other) < place.distance(at));
    let over = points.iter().filter(|&&other| place.holds(other)).count()
        + placed.iter().filter(|other| place.meets(other)).count();
    let [first, _, last, _] = place.corners();
    let outside = [first, last]
        .iter()
        .filter(|&&corner| !around.frame.holds(corner))
        .count();
    covered + 3 * crossed + 60 * usize::from(astray) + 1_000 * over + 10_000 * outside
}

/// Whether a point of a curve lies on the line from an annotated point to its label, away from the annotated point.
fn crosses(point: Point, from: Point, to: Point) -> bool {
    let along = (to.0 - from.0, to.1 - from.1);
    let away = (point.0 - from.0, point.1 - from.1);
    let length = distance(from, to);
    if length < FAR {
        return false;
    }
    let forward = (along.0 * away.0 + along.1 * away.1) / length;
    let aside = (along.0 * away.1 - along.1 * away.0).abs() / length;
    (6.0..length).contains(&forward) && aside < 3.0
}

/// Lists the places about a point for a label of this width, the nearest first.
fn places((x, y): Point, width: f64) -> Vec<Rect> {
    let size = (width + 6.0, LETTERS + 6.0);
    let beside = |distance: f64, length: f64| [distance, -distance - length];
    let mut places = Vec::new();
    for (index, aside) in DISTANCES.into_iter().enumerate() {
        for (other, above) in DISTANCES.into_iter().enumerate() {
            for left in beside(aside, size.0) {
                // Of two places as near as each other the one above comes first.
                let tops = beside(above, size.1).into_iter().rev();
                places.extend(tops.map(|top| (2 * (index + other), left, top)));
            }
        }
        // These come a little after the places at a corner that are as near.
        places.extend(beside(aside, size.0).map(|left| (4 * index + 1, left, -0.5 * size.1)));
        places.extend(beside(aside, size.1).map(|top| (4 * index + 1, -0.5 * size.0, top)));
    }
    places.sort_by_key(|(far, ..)| *far);
    let place = |(_, left, top)| Rect::at((x + left, y + top), size);
    places.into_iter().map(place).collect()
}
