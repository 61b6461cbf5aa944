//! Arrays, structs and iterators that are no part of a formula.

const OUTSIDE: usize = 3;

#[rotor_macros::symbolic]
mod formulas {
    use super::OUTSIDE;

    pub const N: usize = 3;

    pub struct Point {
        pub x: f64,
        pub y: f64,
    }

    pub struct Way {
        pub points: [Point; N],
        pub weights: [f64; 2],
    }

    pub fn of_unknown_length(q: [f64; OUTSIDE], r: &[f64], s: [u8; 2], t: &mut [f64; 2]) -> f64 {
        q[0]
    }

    pub fn of_many(q: [[f64; 100]; 100]) -> f64 {
        q[0][0]
    }

    #[generate(gradient(way.points[3], way.points.x, way.weights[0].x, way.point), hessian(way.points[1].z))]
    #[domain(way.weights > 0.0)]
    #[specialise(first, way.points[0] = Point { x: 1.0, y: 2.0 }, generate(value))]
    pub fn parts(way: &Way) -> f64 {
        let Way { points, .. } = way;
        points[3].x + points[0].z + points.x + way.points[1][0] + way.weights[N] + points[0]
    }

    pub fn patterns(q: [f64; N]) -> f64 {
        let [a, b] = q;
        let [c, .., d, e, f] = q;
        let (g, h) = q;
        let Point { x, z } = Point { x: 1.0, y: 2.0 };
        let Point { x: i, .. } = q[0];
        let ref j = q;
        let [k, rest @ ..] = q;
        a + b + c + d + e + f + g + h + x + z + i + j[0] + k + rest[0]
    }

    pub fn iterators(q: [f64; N]) -> f64 {
        let sum = q.iter().map(f64::sqrt).sum::<f64>();
        let pairs: f64 = q.iter().zip(q).sum();
        let largest = q.iter().copied().reduce(f64::max).unwrap_or(0.0);
        let first = q.iter().step_by(0).map(|x, y| x).product::<f64>();
        let mean = q.iter().sum::<f64>() / q.len();
        let zipped = q.iter().zip(1.0).skip(1.5).count() as f64;
        let sorted = q.iter() + 1.0;
        sum + pairs + largest + first + mean + zipped + sorted
    }

    pub fn other_arguments(way: &Way, q: [f64; N]) -> f64 {
        inner(way.weights) + inner(q[0]) + inner([q, q, q])
    }

    pub fn inner(q: [f64; N]) -> f64 {
        q[0]
    }

    #[generate(jacobian(q), columns)]
    pub fn of_one_number(q: [f64; N]) -> f64 {
        q[0]
    }

    pub fn too_many_elements(x: f64) -> f64 {
        let a = [[x; 1000]; 1000];
        let b = [x; -1];
        a[0][0]
    }
}

fn main() {
    let _ = formulas::of_one_number::jacobian([0.0; 3]);
}
