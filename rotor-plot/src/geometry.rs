//! Plane geometry on the page: rectangles, the part of a curve inside one, hatching.

/// A point of the page in pixels, or of a plot in the units of its axes.
pub(crate) type Point = (f64, f64);

/// A curve's points; where the second number is missing the curve has a gap.
pub(crate) type Gapped = [(f64, Option<f64>)];

/// A rectangle with sides along the axes; `top` is the smaller vertical coordinate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rect {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) right: f64,
    pub(crate) bottom: f64,
}

impl Rect {
    /// Creates a rectangle from its edges.
    pub(crate) fn new(left: f64, top: f64, right: f64, bottom: f64) -> Self {
        Self {
            left,
            top,
            right,
            bottom,
        }
    }

    /// Creates a rectangle of a size about its middle.
    pub(crate) fn around((x, y): Point, (width, height): (f64, f64)) -> Self {
        let (left, top) = (x - 0.5 * width, y - 0.5 * height);
        Self::at((left, top), (width, height))
    }

    /// Creates a rectangle of a size from its upper left corner.
    pub(crate) fn at((left, top): Point, (width, height): (f64, f64)) -> Self {
        Self::new(left, top, left + width, top + height)
    }

    /// Whether a point lies inside or on the edge.
    pub(crate) fn holds(&self, (x, y): Point) -> bool {
        (self.left..=self.right).contains(&x) && (self.top..=self.bottom).contains(&y)
    }

    /// The point inside that is nearest to another one.
    pub(crate) fn nearest(&self, (x, y): Point) -> Point {
        (
            x.max(self.left).min(self.right),
            y.max(self.top).min(self.bottom),
        )
    }

    /// Distance from a point to the nearest point inside.
    pub(crate) fn distance(&self, at: Point) -> f64 {
        distance(self.nearest(at), at)
    }

    /// Whether two rectangles overlap.
    pub(crate) fn meets(&self, other: &Self) -> bool {
        self.left <= other.right
            && other.left <= self.right
            && self.top <= other.bottom
            && other.top <= self.bottom
    }

    /// The middle.
    pub(crate) fn centre(&self) -> Point {
        (
            0.5 * (self.left + self.right),
            0.5 * (self.top + self.bottom),
        )
    }

    /// The corners, from the upper left one clockwise.
    pub(crate) fn corners(&self) -> [Point; 4] {
        let Self {
            left,
            top,
            right,
            bottom,
        } = *self;
        [(left, top), (right, top), (right, bottom), (left, bottom)]
    }
}

/// Distance of two points.
pub(crate) fn distance(a: Point, b: Point) -> f64 {
    (a.0 - b.0).hypot(a.1 - b.1)
}

/// The connected parts of a curve inside a window, cut at its edges. A point with gaps on both sides is a part of its
/// own.
pub(crate) fn visible_parts(points: &Gapped, window: &Rect) -> Vec<Vec<Point>> {
    let mut parts: Vec<Vec<Point>> = Vec::new();
    let mut before: Option<Point> = None;
    // Whether the last part ends at the point `before`; then the next segment continues it.
    let mut connected = false;
    for (index, &(x, y)) in points.iter().enumerate() {
        let here = y.map(|y| (x, y));
        match (before, here) {
            (Some(from), Some(to)) => {
                let clipped = clip(from, to, window);
                if let Some((start, end)) = clipped {
                    match parts.last_mut() {
                        Some(part) if connected => part.push(end),
                        _ => parts.push(vec![start, end]),
                    }
                }
                connected = clipped.is_some_and(|(_, end)| end == to);
            }
            (None, Some(to)) => {
                connected = false;
                let alone = points.get(index + 1).is_none_or(|next| next.1.is_none());
                if alone && window.holds(to) {
                    parts.push(vec![to]);
                }
            }
            (_, None) => connected = false,
        }
        before = here;
    }
    parts
}

/// The part of a segment inside a window (Liang and Barsky's method).
fn clip(from: Point, to: Point, window: &Rect) -> Option<(Point, Point)> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    let edges = [
        (-dx, from.0 - window.left),
        (dx, window.right - from.0),
        (-dy, from.1 - window.top),
        (dy, window.bottom - from.1),
    ];
    for (outwards, room) in edges {
        if outwards == 0.0 && room < 0.0 {
            return None;
        }
        if outwards < 0.0 {
            enter = enter.max(room / outwards);
        } else if outwards > 0.0 {
            leave = leave.min(room / outwards);
        }
    }
    let at = |t: f64| (from.0 + t * dx, from.1 + t * dy);
    let start = if enter == 0.0 { from } else { at(enter) };
    let end = if leave == 1.0 { to } else { at(leave) };
    (enter <= leave).then_some((start, end))
}

/// The part of a polygon inside a window (Sutherland and Hodgman's method: cut at one edge after the other).
pub(crate) fn clip_polygon(polygon: &[Point], window: &Rect) -> Vec<Point> {
    // How far a point lies inside of each edge; negative outside.
    let edges: [&dyn Fn(Point) -> f64; 4] = [
        &|p| p.0 - window.left,
        &|p| window.right - p.0,
        &|p| p.1 - window.top,
        &|p| window.bottom - p.1,
    ];
    let mut corners = polygon.to_vec();
    for inside in edges {
        let mut kept = Vec::with_capacity(corners.len() + 4);
        for (&from, &to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let (a, b) = (inside(from), inside(to));
            if a >= 0.0 {
                kept.push(from);
            }
            if (a >= 0.0) != (b >= 0.0) {
                let t = a / (a - b);
                kept.push((from.0 + t * (to.0 - from.0), from.1 + t * (to.1 - from.1)));
            }
        }
        corners = kept;
    }
    corners
}

/// Diagonal lines across a polygon at a distance from each other: rising to the right, or falling.
pub(crate) fn hatch(polygon: &[Point], spacing: f64, rising: bool) -> Vec<[Point; 2]> {
    // Along a rising line of the page x + y is constant, along a falling one x − y.
    let sign = if rising { 1.0 } else { -1.0 };
    let across = |p: Point| p.0 + sign * p.1;
    let step = spacing * std::f64::consts::SQRT_2;
    let least = polygon
        .iter()
        .copied()
        .map(across)
        .fold(f64::INFINITY, f64::min);
    let most = polygon
        .iter()
        .copied()
        .map(across)
        .fold(f64::NEG_INFINITY, f64::max);
    let lines = (0_u32..).map(|k| ((least / step).floor() + 1.0 + f64::from(k)) * step);
    let mut segments = Vec::new();
    for line in lines.take_while(|&line| line < most) {
        let mut crossings = Vec::new();
        for (&from, &to) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
            let (a, b) = (across(from) - line, across(to) - line);
            if (a < 0.0) != (b < 0.0) {
                let t = a / (a - b);
                crossings.push((from.0 + t * (to.0 - from.0), from.1 + t * (to.1 - from.1)));
            }
        }
        crossings.sort_by(|p, q| p.0.total_cmp(&q.0));
        segments.extend(crossings.as_chunks::<2>().0);
    }
    segments
}
