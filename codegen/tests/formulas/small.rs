mod small {
    /// A point of the plane.
    pub struct Point {
        pub x: f64,
        pub y: f64,
    }

    /// Polar coordinates: a struct in, a struct out.
    #[generate(value, gradient)]
    pub fn turned(p: &Point, angle: f64) -> Point {
        let (s, c) = (angle.sin(), angle.cos());
        Point { x: c * p.x - s * p.y, y: s * p.x + c * p.y }
    }

    /// The smaller and larger of two, and a size.
    #[generate(value, gradient)]
    pub fn clamped(x: f64, low: f64, high: f64) -> f64 {
        x.max(low).min(high) + (x - low).abs()
    }

    /// One division for all.
    #[generate(value, gradient, hessian)]
    pub fn quotient(a: f64, b: f64) -> f64 {
        (a - b) / (a + b)
    }

    /// Two divisors that several quotients share.
    #[generate(value)]
    pub fn fractions(x: [f64; 2], a: f64, b: f64) -> (f64, f64, f64) {
        (x[0] / (a * b), x[1] / a, (x[0] + x[1]) / b)
    }

    /// A circle's equation, and its value on the diagonal.
    #[generate(value)]
    #[specialise(circle_on_diagonal, y = x, generate(value, gradient))]
    pub fn circle(x: f64, y: f64, r: f64) -> f64 {
        x.powi(2) + y.powi(2) - r.powi(2)
    }

    /// What takes long to compute.
    #[approximate(x = 0.0..=1.0, factor = x, tolerance = 1e-2)]
    fn slow(x: f64) -> f64 {
        x * (1.0 + 0.25 * x).exp()
    }

    /// A table at two places.
    #[generate(value, gradient)]
    pub fn tabulated(x: f64, y: f64) -> f64 {
        slow(x) - y * slow(x * y)
    }

    /// Inputs that are named as the generated code would name its own.
    #[generate(gradient, columns)]
    pub fn in_columns(row: f64, inputs: &Point) -> f64 {
        row * inputs.x / inputs.y.sqrt()
    }

    /// The resultant of two forces that turn against each other, in stages along the angle.
    #[domain(scale > 0.0)]
    #[generate(stage(angle), stage(a, scale))]
    pub fn resultant(scale: f64, a: f64, b: f64, angle: f64) -> f64 {
        3.0 * scale * (((a + b) * angle.cos()).powi(2) + ((a - b) * angle.sin()).powi(2)).sqrt()
    }
}
