//! Arrays and structs, within each other: values with the bits of the function as written, derivatives by whole parameters
//! beside differences, columns with the bits of the scalar forms.
#![allow(
    unreachable_pub,
    clippy::needless_range_loop,
    clippy::float_cmp,
    clippy::cast_precision_loss,
    clippy::map_identity,
    reason = "formulas are `pub` as in a library, and say what people say; numbers are compared bit by bit"
)]

mod shapes {
    pub use formulas::*;

    #[rotor_macros::symbolic]
    pub mod formulas {
        /// How many coefficients a polynomial has.
        pub const N: usize = 3;

        /// A point in space.
        #[derive(Clone, Copy, Debug)]
        pub struct Point {
            pub x: f64,
            pub y: f64,
            pub z: f64,
        }

        /// Where a camera is, and what it makes of directions.
        #[derive(Clone, Copy, Debug)]
        pub struct Camera {
            pub place: Point,
            pub turn: [[f64; 3]; 3],
            pub distortion: [f64; N - 1],
            pub focus: f64,
        }
    }
}

#[rotor_macros::symbolic(with(shapes))]
mod formulas {
    use super::shapes::{Camera, N, Point};

    const TWICE: usize = 2 * N;

    /// The Euclidean norm of what is weighted.
    #[generate(value, gradient(q), hessian(q), columns)]
    pub fn norm(q: [f64; TWICE], weights: &[f64; 6]) -> f64 {
        q.iter()
            .zip(weights)
            .map(|(x, w)| w * x * x)
            .sum::<f64>()
            .sqrt()
    }

    /// A determinant by the first row.
    #[generate(value, gradient(m), hessian(m[0], m[2][1]), columns)]
    pub fn determinant(m: [[f64; 3]; 3]) -> f64 {
        let mut sum = 0.0;
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            sum += m[0][i] * (m[1][j] * m[2][k] - m[1][k] * m[2][j]);
        }
        sum
    }

    /// What a camera sees of a point.
    #[generate(value, gradient(camera, point), hessian(camera.distortion, point), columns)]
    pub fn seen(camera: &Camera, point: Point) -> [f64; N - 1] {
        let Camera { place, turn, .. } = *camera;
        let Point { x, y, z: depth } = point;
        let from = [x - place.x, y - place.y, depth - place.z];
        let mut turned = [0.0; N];
        for (row, result) in turn.iter().zip([0, 1, 2]) {
            for k in 0..N {
                turned[result] += row[k] * from[k];
            }
        }
        let [a, b, depth] = turned;
        let (u, v) = (a / depth, b / depth);
        let radius = u * u + v * v;
        let factor = camera
            .distortion
            .iter()
            .rev()
            .fold(0.0, |sum, k| (sum + k) * radius);
        [u, v].map(|w| camera.focus * w * (1.0 + factor))
    }

    /// How far two points are from each other.
    #[generate(value, gradient)]
    pub fn distance(a: Point, b: &Point) -> f64 {
        let differences = [a.x - b.x, a.y - b.y, a.z - b.z];
        differences.iter().map(|d| d.powi(2)).sum::<f64>().sqrt()
    }

    /// The length of a way through points.
    #[generate(value, gradient(way), columns)]
    pub fn length(way: [Point; 3]) -> f64 {
        let mut sum = 0.0;
        for i in 1..way.len() {
            sum += distance(way[i - 1], &way[i]);
        }
        sum
    }

    /// Parts of a struct that are changed.
    #[generate(value, gradient(point))]
    pub fn moved(point: Point, by: f64) -> f64 {
        let mut moved = point;
        moved.x += by;
        let mut way = [moved, point, Point { z: by, ..moved }];
        way[1].y *= 2.0;
        let [first, rest @ ..] = way;
        let last = rest[1];
        first.x * way[1].y + last.z * last.x
    }
}

#[rotor_macros::symbolic]
mod replaced {
    /// A polynomial.
    #[specialise(parabola, c[3] = 0.0, generate(gradient(x, c)))]
    #[generate(d_c_1, d_x)]
    pub fn cubic(x: f64, c: [f64; 4]) -> f64 {
        c.iter().rev().fold(0.0, |sum, k| sum * x + k)
    }

    /// Partials of another formula at arrays.
    #[generate(value)]
    pub fn of_partials(x: f64) -> f64 {
        let c = [x, 2.0, x * x, 1.0];
        cubic::d_x(x, c) + cubic::d_c_1(x, [0.0; 4])
    }
}

use shapes::{Camera, Point};

/// Whether a derivative is what differences of a function make of it.
fn is_slope(slope: f64, function: impl Fn(f64) -> f64, x: f64) -> bool {
    let step = 2.0_f64.powi(-12) * x.abs().max(0.25);
    let at = |places: f64| function(x + places * step);
    // To the fourth order.
    let difference = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step);
    let size = at(0.0).abs().max(difference.abs()).max(1.0);
    (slope - difference).abs() <= 1e-8 * size
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 4.0 * f64::EPSILON * b.abs()
}

#[test]
fn a_gradient_by_an_array_has_its_elements_in_order() {
    let q = [0.5, -1.25, 2.0, 0.75, 1.5, -0.25];
    let weights = [1.0, 2.0, 0.5, 4.0, 0.25, 3.0];
    let (value, slopes, curvatures) = formulas::norm::hessian(q, &weights);
    assert!(close(value, formulas::norm(q, &weights)));
    assert_eq!(formulas::norm::gradient(q, &weights).1.len(), 6);
    for by in 0..6 {
        let at = |x: f64| {
            let mut q = q;
            q[by] = x;
            q
        };
        let of_value = |x: f64| formulas::norm(at(x), &weights);
        assert!(is_slope(slopes[by], of_value, q[by]), "{slopes:?}");
        for other in 0..6 {
            let slope = |x: f64| formulas::norm::gradient(at(x), &weights).1[other];
            assert!(is_slope(curvatures[by][other], slope, q[by]));
        }
    }
}

#[test]
fn a_gradient_by_a_matrix_goes_row_by_row() {
    let m = [[0.5, -1.25, 2.0], [0.75, 1.5, -0.25], [3.0, 0.125, 1.0]];
    let (value, slopes) = formulas::determinant::gradient(m);
    assert!(close(value, formulas::determinant(m)));
    for (by, slope) in slopes.iter().enumerate() {
        let of = |x: f64| {
            let mut m = m;
            m[by / 3][by % 3] = x;
            formulas::determinant(m)
        };
        assert!(is_slope(*slope, of, m[by / 3][by % 3]), "{by}: {slope}");
    }
    // By a row and one more.
    let (_, first, second) = formulas::determinant::hessian(m);
    assert_eq!(first.len(), 4);
    assert_eq!(first[..3], slopes[..3]);
    assert_eq!(first[3], slopes[7]);
    assert!(close(second[0][3], -m[1][2]) && close(second[2][3], m[1][0]));
}

fn camera() -> (Camera, Point) {
    let place = Point {
        x: 0.25,
        y: -0.5,
        z: -4.0,
    };
    let turn = [[0.8, -0.6, 0.0], [0.6, 0.8, 0.0], [0.0, 0.0, 1.0]];
    let distortion = [0.125, -0.0625];
    let focus = 1.5;
    let point = Point {
        x: 1.0,
        y: 0.5,
        z: 2.0,
    };
    let camera = Camera {
        place,
        turn,
        distortion,
        focus,
    };
    (camera, point)
}

/// The numbers of a camera and a point, in the order in which they are declared.
fn numbers(camera: &Camera, point: &Point) -> Vec<f64> {
    let of_point = |p: &Point| [p.x, p.y, p.z];
    let mut all = of_point(&camera.place).to_vec();
    all.extend(camera.turn.iter().flatten());
    all.extend(camera.distortion);
    all.push(camera.focus);
    all.extend(of_point(point));
    all
}

fn of_numbers(all: &[f64]) -> (Camera, Point) {
    let point = |at: usize| Point {
        x: all[at],
        y: all[at + 1],
        z: all[at + 2],
    };
    let row = |at: usize| [all[at], all[at + 1], all[at + 2]];
    let camera = Camera {
        place: point(0),
        turn: [row(3), row(6), row(9)],
        distortion: [all[12], all[13]],
        focus: all[14],
    };
    (camera, point(15))
}

#[test]
fn a_gradient_by_structs_has_all_their_numbers() {
    let (camera, point) = camera();
    let all = numbers(&camera, &point);
    let (value, slopes) = formulas::seen::gradient(&camera, point);
    let written = formulas::seen(&camera, point);
    let (_, of_some, curvatures) = formulas::seen::hessian(&camera, point);
    for result in 0..2 {
        assert!(close(value[result], written[result]));
        assert_eq!(slopes[result].len(), 18);
        for by in 0..18 {
            let of = |x: f64| {
                let mut all = all.clone();
                all[by] = x;
                let (camera, point) = of_numbers(&all);
                formulas::seen(&camera, point)[result]
            };
            assert!(is_slope(slopes[result][by], of, all[by]), "{by}");
        }
        let places = [12, 13, 15, 16, 17];
        for (row, place) in places.into_iter().enumerate() {
            assert!(close(of_some[result][row], slopes[result][place]));
            for column in 0..5 {
                let of = |x: f64| {
                    let mut all = all.clone();
                    all[place] = x;
                    let (camera, point) = of_numbers(&all);
                    formulas::seen::gradient(&camera, point).1[result][places[column]]
                };
                assert!(is_slope(curvatures[result][row][column], of, all[place]));
            }
        }
    }
}

#[test]
fn columns_of_structs_have_a_column_for_each_number() {
    let (camera, point) = camera();
    let inputs = formulas::seen::Columns {
        camera_place_x: &[camera.place.x],
        camera_place_y: &[camera.place.y],
        camera_place_z: &[camera.place.z],
        camera_turn_0_0: &[camera.turn[0][0]],
        camera_turn_0_1: &[camera.turn[0][1]],
        camera_turn_0_2: &[camera.turn[0][2]],
        camera_turn_1_0: &[camera.turn[1][0]],
        camera_turn_1_1: &[camera.turn[1][1]],
        camera_turn_1_2: &[camera.turn[1][2]],
        camera_turn_2_0: &[camera.turn[2][0]],
        camera_turn_2_1: &[camera.turn[2][1]],
        camera_turn_2_2: &[camera.turn[2][2]],
        camera_distortion_0: &[camera.distortion[0]],
        camera_distortion_1: &[camera.distortion[1]],
        camera_focus: &[camera.focus],
        point_x: &[point.x],
        point_y: &[point.y],
        point_z: &[point.z],
    };
    let (mut u, mut v) = ([0.0], [0.0]);
    formulas::seen::columns(&inputs, [&mut u, &mut v]).expect("columns of one length");
    assert_eq!([u[0], v[0]], formulas::seen::value(&camera, point));
    let m = [[0.5, -1.25, 2.0], [0.75, 1.5, -0.25], [3.0, 0.125, 1.0]];
    let column = |row: usize, column: usize| [m[row][column]];
    let inputs = formulas::determinant::Columns {
        m_0_0: &column(0, 0),
        m_0_1: &column(0, 1),
        m_0_2: &column(0, 2),
        m_1_0: &column(1, 0),
        m_1_1: &column(1, 1),
        m_1_2: &column(1, 2),
        m_2_0: &column(2, 0),
        m_2_1: &column(2, 1),
        m_2_2: &column(2, 2),
    };
    let mut determinant = [0.0];
    formulas::determinant::columns(&inputs, [&mut determinant]).expect("columns of one length");
    assert_eq!(determinant[0], formulas::determinant::value(m));
}

#[test]
fn arrays_of_structs_are_called_with_and_derived_by() {
    let way = [[0.0, 0.5, 1.0], [2.0, -1.0, 0.25], [1.5, 3.0, -2.0]];
    let points = |way: [[f64; 3]; 3]| way.map(|[x, y, z]| Point { x, y, z });
    let (value, slopes) = formulas::length::gradient(points(way));
    assert!(close(value, formulas::length(points(way))));
    for (by, slope) in slopes.iter().enumerate() {
        let of = |x: f64| {
            let mut way = way;
            way[by / 3][by % 3] = x;
            formulas::length(points(way))
        };
        assert!(is_slope(*slope, of, way[by / 3][by % 3]), "{by}: {slope}");
    }
    let [a, b, _] = points(way);
    assert!(close(formulas::distance::gradient(a, &b).1[3], -slopes[0]));
}

#[test]
fn parts_that_are_changed_leave_the_others() {
    let point = Point {
        x: 0.5,
        y: -1.25,
        z: 2.0,
    };
    let (value, slopes) = formulas::moved::gradient(point, 0.75);
    assert!(close(value, formulas::moved(point, 0.75)));
    // (x + b)·2y + b·(x + b)
    assert_eq!(slopes, [2.0 * point.y + 0.75, 2.0 * (point.x + 0.75), 0.0]);
}

#[test]
fn elements_are_replaced_and_partials_are_by_them() {
    let c = [0.5, -1.25, 2.0, 100.0];
    let (value, [by_x, by_c @ ..]) = replaced::parabola::gradient(1.5, c);
    assert_eq!(value, 0.5 - 1.25 * 1.5 + 2.0 * 1.5 * 1.5);
    assert_eq!(by_x, -1.25 + 2.0 * 2.0 * 1.5);
    assert_eq!(by_c, [1.0, 1.5, 2.25, 0.0]);
    let x = 0.75_f64;
    let expected = 2.0 + 2.0 * x.powi(3) + 3.0 * x.powi(2) + x;
    assert!(close(replaced::of_partials::value(x), expected));
}

#[rotor_macros::symbolic]
mod arms {
    const JOINTS: usize = 3;
    const LENGTHS: [f64; JOINTS] = [1.0, 0.75, 0.5];

    /// Where a hand in a plane is, and how it is turned, by the angles of its joints.
    #[generate(jacobian(angles), columns)]
    pub fn hand(angles: [f64; JOINTS]) -> [f64; 3] {
        let (mut x, mut y, mut turned) = (0.0, 0.0, 0.0);
        for (angle, length) in angles.iter().zip(LENGTHS) {
            turned += angle;
            let (sine, cosine) = turned.sin_cos();
            x += length * cosine;
            y += length * sine;
        }
        [x, y, turned]
    }

    /// Two points, of which the second is mirrored.
    #[generate(gradient(x), jacobian)]
    pub fn points(x: f64, y: f64) -> ([f64; 2], f64) {
        ([x * y, x - y], y)
    }
}

#[test]
fn a_jacobian_has_a_row_for_each_number_of_the_result() {
    let angles = [0.5, -1.25, 2.0];
    let (hand, rows) = arms::hand::jacobian(angles);
    let written = arms::hand(angles);
    for result in 0..3 {
        assert!(close(hand[result], written[result]));
        for by in 0..3 {
            let of = |x: f64| {
                let mut angles = angles;
                angles[by] = x;
                arms::hand(angles)[result]
            };
            assert!(is_slope(rows[result][by], of, angles[by]), "{rows:?}");
        }
    }
    let inputs = arms::hand::Columns {
        angles_0: &[0.5],
        angles_1: &[-1.25],
        angles_2: &[2.0],
    };
    let mut all = [[0.0]; 12];
    arms::hand::jacobian_columns(&inputs, all.each_mut().map(|column| column.as_mut_slice()))
        .expect("columns of one length");
    let in_order: Vec<f64> = hand.into_iter().chain(rows.into_iter().flatten()).collect();
    assert_eq!(all.map(|[x]| x).to_vec(), in_order);
    let (value, rows) = arms::points::jacobian(2.0, 3.0);
    assert_eq!(value, ([6.0, -1.0], 3.0));
    assert_eq!(rows, [[3.0, 2.0], [1.0, -1.0], [0.0, 1.0]]);
    assert_eq!(arms::points::gradient(2.0, 3.0).1, [[3.0], [1.0], [0.0]]);
}
