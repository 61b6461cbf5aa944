/// Example of a fit.
///
/// Piecewise polynomial for 0.0 ≤ x ≤ 1.1: 3 pieces of degree 3.
/// The fit: relative error 2.0e-14 at most where measured, tolerance 1.0e-13.
/// Relative error of the fit's first derivative, by |f'| and |f|/width: about 3.0e-12.
/// Outside that interval the outer piece is continued.
///
/// Operations: 4 add, 4 mul, 0 div, 0 sqrt, 0 call; 2 comparisons find the piece.
#[inline]
fn example_fit(x: f64) -> f64 {
    /// Per piece: its middle, 2 / its width, and the coefficients of t⁰, t¹, ….
    const PIECES: &[[f64; 6]; 3] = &[
        [
            0.125,
            8.0,
            0.30000000000000004,
            -0.3333333333333333,
            1.2345678901234567e-17,
            -0.0,
        ],
        [0.375, 8.0, 2.0, 1e22, -5e-324, 0.7],
        [0.8, 3.333333333333333, -1.0, 0.25, 0.02040816326530612, 3.5],
    ];
    /// Where the second and each further piece begins.
    const BREAKPOINTS: &[f64; 2] = &[0.25, 0.5];
    let begun = BREAKPOINTS.iter().map(|&breakpoint| usize::from(x >= breakpoint));
    let piece = begun.sum::<usize>().min(2);
    let [center, scale, a0, a1, a2, a3] = PIECES[piece];
    let t = (x - center) * scale;
    let value = a3;
    let value = value * t + a2;
    let value = value * t + a1;
    value * t + a0
}
/// Example of a fit.
///
/// Piecewise polynomial for 0.0 ≤ x ≤ 1.1: 3 pieces of degree 2.
/// Exact derivative of order 1 of a fit, with relative error 2.0e-14 at most where measured, tolerance 1.0e-13.
/// Relative error of the fit's first derivative, by |f'| and |f|/width: about 3.0e-12.
/// Outside that interval the outer piece is continued.
///
/// Operations: 3 add, 3 mul, 0 div, 0 sqrt, 0 call; 2 comparisons find the piece.
#[inline]
fn example_slope(x: f64) -> f64 {
    /// Per piece: its middle, 2 / its width, and the coefficients of t⁰, t¹, ….
    const PIECES: &[[f64; 5]; 3] = &[
        [0.125, 8.0, -2.6666666666666665, 1.9753086241975307e-16, -0.0],
        [0.375, 8.0, 8e22, -8e-323, 16.799999999999997],
        [0.8, 3.333333333333333, 0.8333333333333333, 0.13605442176870747, 35.0],
    ];
    /// Where the second and each further piece begins.
    const BREAKPOINTS: &[f64; 2] = &[0.25, 0.5];
    let begun = BREAKPOINTS.iter().map(|&breakpoint| usize::from(x >= breakpoint));
    let piece = begun.sum::<usize>().min(2);
    let [center, scale, a0, a1, a2] = PIECES[piece];
    let t = (x - center) * scale;
    let value = a2;
    let value = value * t + a1;
    value * t + a0
}
/// Example of a fit.
///
/// Piecewise polynomial for 0.0 ≤ x ≤ 1.0: 1 piece of degree 1.
/// The fit: relative error 2.0e-14 at most where measured, tolerance 1.0e-13.
/// Relative error of the fit's first derivative, by |f'| and |f|/width: about 3.0e-12.
/// Outside that interval the outer piece is continued.
///
/// Operations: 2 add, 2 mul, 0 div, 0 sqrt, 0 call.
#[inline]
fn example_line(x: f64) -> f64 {
    /// Per piece: its middle, 2 / its width, and the coefficients of t⁰, t¹, ….
    const PIECES: &[[f64; 4]; 1] = &[[0.5, 2.0, 1.0, 0.5]];
    let piece = 0;
    let [center, scale, a0, a1] = PIECES[piece];
    let t = (x - center) * scale;
    let value = a1;
    value * t + a0
}
