mod matrices {
    /// Determinant of a symmetric 4×4 matrix by the 2×2 minors of its upper and its lower two rows.
    #[generate(gradient(a, b, c, d, e, f, g, h, i, j), columns, budget(operations = 96))]
    pub fn determinant(a: f64, b: f64, c: f64, d: f64, e: f64, f: f64, g: f64, h: f64, i: f64, j: f64) -> f64 {
        let s0 = a * e - b * b;
        let s1 = a * f - b * c;
        let s2 = a * g - b * d;
        let s3 = b * f - c * e;
        let s4 = b * g - d * e;
        let s5 = c * g - d * f;
        let c5 = h * j - i * i;
        let c4 = f * j - g * i;
        let c3 = f * i - g * h;
        let c2 = c * j - d * i;
        let c1 = c * i - d * h;
        let c0 = c * g - d * f;
        s0 * c5 - s1 * c4 + s2 * c3 + s3 * c2 - s4 * c1 + s5 * c0
    }
}
