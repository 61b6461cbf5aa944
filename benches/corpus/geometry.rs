//! Geometry: triangles, determinants, surfaces.

pub use formulas::*;

/// This module's own source text, which is what the tools compared read.
pub const SOURCE: &str = include_str!("geometry.rs");

#[rotor_macros::symbolic(sizes = 1e-9..=1e9)]
mod formulas {
    /// Area of a triangle of these sides.
    ///
    /// Heron of Alexandria, *Metrica*.
    #[domain(a > 0.0, b > 0.0, c > 0.0)]
    #[generate(value, gradient)]
    pub fn heron(a: f64, b: f64, c: f64) -> f64 {
        let s = (a + b + c) / 2.0;
        (s * (s - a) * (s - b) * (s - c)).sqrt()
    }

    /// Radius of the circle around a triangle of these sides.
    ///
    /// Coxeter, Greitzer, *Geometry Revisited*, section 1.5.
    #[domain(a > 0.0, b > 0.0, c > 0.0)]
    #[generate(value, gradient)]
    pub fn circumradius(a: f64, b: f64, c: f64) -> f64 {
        a * b * c / ((a + b + c) * (b + c - a) * (c + a - b) * (a + b - c)).sqrt()
    }

    /// Squared sine of half the angle between two places on a sphere, by latitude and longitude in rad.
    ///
    /// Inman, *Navigation and Nautical Astronomy*, 1835: the haversine.
    #[generate(value, gradient)]
    pub fn haversine(latitude: [f64; 2], longitude: [f64; 2]) -> f64 {
        ((latitude[1] - latitude[0]) / 2.0).sin().powi(2)
            + latitude[0].cos()
                * latitude[1].cos()
                * ((longitude[1] - longitude[0]) / 2.0).sin().powi(2)
    }

    /// Determinant of a matrix of three rows, given one after the other.
    ///
    /// Sarrus, *Finck's Éléments d'algèbre*, 1846.
    #[generate(value, gradient)]
    pub fn determinant_3(m: [f64; 9]) -> f64 {
        m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6])
            + m[2] * (m[3] * m[7] - m[4] * m[6])
    }

    /// Determinant of a matrix of four rows, given one after the other, by the minors of its first and last two rows.
    ///
    /// Laplace, *Recherches sur le calcul intégral*, 1772.
    #[generate(value, gradient)]
    pub fn determinant_4(m: [f64; 16]) -> f64 {
        (m[0] * m[5] - m[1] * m[4]) * (m[10] * m[15] - m[11] * m[14])
            - (m[0] * m[6] - m[2] * m[4]) * (m[9] * m[15] - m[11] * m[13])
            + (m[0] * m[7] - m[3] * m[4]) * (m[9] * m[14] - m[10] * m[13])
            + (m[1] * m[6] - m[2] * m[5]) * (m[8] * m[15] - m[11] * m[12])
            - (m[1] * m[7] - m[3] * m[5]) * (m[8] * m[14] - m[10] * m[12])
            + (m[2] * m[7] - m[3] * m[6]) * (m[8] * m[13] - m[9] * m[12])
    }

    /// Volume of a tetrahedron of these corners, with the sign of their order.
    ///
    /// Lagrange, *Solutions analytiques de quelques problèmes sur les pyramides triangulaires*, 1773.
    #[generate(value, gradient)]
    pub fn tetrahedron_volume(a: [f64; 3], b: [f64; 3], c: [f64; 3], d: [f64; 3]) -> f64 {
        determinant_3([
            a[0] - d[0],
            a[1] - d[1],
            a[2] - d[2],
            b[0] - d[0],
            b[1] - d[1],
            b[2] - d[2],
            c[0] - d[0],
            c[1] - d[1],
            c[2] - d[2],
        ]) / 6.0
    }

    /// Distance along a ray of the direction `u` to the nearer point of a sphere of the radius `r`, from `o`, the ray's
    /// origin as seen from the sphere's centre.
    ///
    /// Whitted, *An Improved Illumination Model for Shaded Display*, 1980.
    #[domain(r > 0.0)]
    #[generate(value, gradient)]
    pub fn ray_sphere(o: [f64; 3], u: [f64; 3], r: f64) -> f64 {
        let a = u[0].powi(2) + u[1].powi(2) + u[2].powi(2);
        let b = o[0] * u[0] + o[1] * u[1] + o[2] * u[2];
        let c = o[0].powi(2) + o[1].powi(2) + o[2].powi(2) - r.powi(2);
        (-b - (b.powi(2) - a * c).sqrt()) / a
    }

    /// Signed distance of a point from a torus about the third axis: `ring` the radius of its circle, `tube` of its tube.
    ///
    /// Hart, *Sphere Tracing*, 1996, appendix A.
    #[domain(ring > 0.0, tube > 0.0)]
    #[generate(value, gradient)]
    pub fn torus_distance(p: [f64; 3], ring: f64, tube: f64) -> f64 {
        let outwards = (p[0].powi(2) + p[1].powi(2)).sqrt() - ring;
        (outwards.powi(2) + p[2].powi(2)).sqrt() - tube
    }
}
