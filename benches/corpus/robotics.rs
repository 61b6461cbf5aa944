//! Robotics: arms, rotations, cameras and vehicles.

pub use formulas::*;

/// This module's own source text, which is what the tools compared read.
pub const SOURCE: &str = include_str!("robotics.rs");

#[rotor_macros::symbolic(sizes = 1e-9..=1e9)]
mod formulas {
    /// Position of the tip of a planar arm of two links, m; its gradient by the angles is the arm's Jacobian. Lengths in m,
    /// joint angles in rad.
    ///
    /// Spong, Hutchinson, Vidyasagar, *Robot Modeling and Control*, section 3.2.
    #[generate(value, gradient)]
    pub fn two_link_position(l: [f64; 2], q: [f64; 2]) -> [f64; 2] {
        [
            l[0] * q[0].cos() + l[1] * (q[0] + q[1]).cos(),
            l[0] * q[0].sin() + l[1] * (q[0] + q[1]).sin(),
        ]
    }

    /// Position of the tip of a planar arm of three links and the direction of its hand, m and rad.
    ///
    /// Craig, *Introduction to Robotics*, section 3.6.
    #[generate(value, gradient)]
    pub fn three_link_pose(l: [f64; 3], q: [f64; 3]) -> [f64; 3] {
        let elbow = q[0] + q[1];
        let hand = q[0] + q[1] + q[2];
        [
            l[0] * q[0].cos() + l[1] * elbow.cos() + l[2] * hand.cos(),
            l[0] * q[0].sin() + l[1] * elbow.sin() + l[2] * hand.sin(),
            hand,
        ]
    }

    /// Joint torques of a planar arm of two links, N m: inertia, Coriolis and gravity. `m` masses in kg, `i` inertias about
    /// the centres of mass in kg m², `l` the first link's length and the distances of both centres of mass from their joints in
    /// m, `q` angles, `v` their speeds, `a` their accelerations, `g` in m/s².
    ///
    /// Spong, Hutchinson, Vidyasagar, *Robot Modeling and Control*, section 7.3.2.
    #[generate(value, gradient(q[0], q[1], v[0], v[1], a[0], a[1]))]
    pub fn two_link_torques(
        m: [f64; 2],
        i: [f64; 2],
        l: [f64; 3],
        q: [f64; 2],
        v: [f64; 2],
        a: [f64; 2],
        g: f64,
    ) -> [f64; 2] {
        let coupling = m[1] * l[0] * l[2] * q[1].cos();
        let d22 = m[1] * l[2].powi(2) + i[1];
        let d12 = d22 + coupling;
        let d11 = m[0] * l[1].powi(2) + m[1] * l[0].powi(2) + i[0] + d22 + 2.0 * coupling;
        let coriolis = m[1] * l[0] * l[2] * q[1].sin();
        let hand = m[1] * l[2] * g * (q[0] + q[1]).cos();
        let arm = (m[0] * l[1] + m[1] * l[0]) * g * q[0].cos();
        [
            d11 * a[0] + d12 * a[1] - coriolis * (2.0 * v[0] * v[1] + v[1].powi(2)) + arm + hand,
            d12 * a[0] + d22 * a[1] + coriolis * v[0].powi(2) + hand,
        ]
    }

    /// A vector turned by a unit quaternion (x, y, z, w).
    ///
    /// Diebel, *Representing Attitude*, 2006, Eq. (125).
    #[generate(value, gradient)]
    pub fn quaternion_rotation(q: [f64; 4], v: [f64; 3]) -> [f64; 3] {
        [
            (1.0 - 2.0 * (q[1].powi(2) + q[2].powi(2))) * v[0]
                + 2.0 * (q[0] * q[1] - q[3] * q[2]) * v[1]
                + 2.0 * (q[0] * q[2] + q[3] * q[1]) * v[2],
            2.0 * (q[0] * q[1] + q[3] * q[2]) * v[0]
                + (1.0 - 2.0 * (q[0].powi(2) + q[2].powi(2))) * v[1]
                + 2.0 * (q[1] * q[2] - q[3] * q[0]) * v[2],
            2.0 * (q[0] * q[2] - q[3] * q[1]) * v[0]
                + 2.0 * (q[1] * q[2] + q[3] * q[0]) * v[1]
                + (1.0 - 2.0 * (q[0].powi(2) + q[1].powi(2))) * v[2],
        ]
    }

    /// Error of a point's image, pixels: a pinhole camera of focal length `f` and centre `c` with two coefficients `k` of
    /// radial distortion sees the point `p` (in its own axes, m) at `seen`.
    ///
    /// Brown, *Decentering Distortion of Lenses*, 1966; as in bundle adjustment (Agarwal et al., *BAL*).
    #[domain(p[2] > 0.0, f > 0.0)]
    #[generate(value, gradient)]
    pub fn reprojection_error(
        p: [f64; 3],
        f: f64,
        c: [f64; 2],
        k: [f64; 2],
        seen: [f64; 2],
    ) -> [f64; 2] {
        let x = p[0] / p[2];
        let y = p[1] / p[2];
        let r2 = x.powi(2) + y.powi(2);
        let distortion = 1.0 + k[0] * r2 + k[1] * r2.powi(2);
        [
            f * distortion * x + c[0] - seen[0],
            f * distortion * y + c[1] - seen[1],
        ]
    }

    /// Residual of a preintegrated position of an inertial unit, m: `q` the attitude (x, y, z, w) and `v` the speed at the
    /// start, `d` the way between the two positions, `g` gravity, `dt` the time between them in s, `measured` the
    /// preintegrated position.
    ///
    /// Forster, Carlone, Dellaert, Scaramuzza, *On-Manifold Preintegration*, 2017, Eq. (45).
    #[generate(value, gradient)]
    pub fn inertial_position_residual(
        q: [f64; 4],
        v: [f64; 3],
        d: [f64; 3],
        g: [f64; 3],
        dt: f64,
        measured: [f64; 3],
    ) -> [f64; 3] {
        let back = [-q[0], -q[1], -q[2], q[3]];
        let way = [
            d[0] - v[0] * dt - 0.5 * g[0] * dt.powi(2),
            d[1] - v[1] * dt - 0.5 * g[1] * dt.powi(2),
            d[2] - v[2] * dt - 0.5 * g[2] * dt.powi(2),
        ];
        let turned = quaternion_rotation(back, way);
        [
            turned[0] - measured[0],
            turned[1] - measured[1],
            turned[2] - measured[2],
        ]
    }

    /// Error of a measured relative pose in the plane: `a` and `b` are poses (x, y, angle), `z` the second as seen from the
    /// first.
    ///
    /// Grisetti, Kümmerle, Stachniss, Burgard, *A Tutorial on Graph-Based SLAM*, 2010.
    #[generate(value, gradient)]
    pub fn relative_pose_error(a: [f64; 3], b: [f64; 3], z: [f64; 3]) -> [f64; 3] {
        let dx = b[0] - a[0];
        let dy = b[1] - a[1];
        let x = a[2].cos() * dx + a[2].sin() * dy - z[0];
        let y = a[2].cos() * dy - a[2].sin() * dx - z[1];
        [
            z[2].cos() * x + z[2].sin() * y,
            z[2].cos() * y - z[2].sin() * x,
            b[2] - a[2] - z[2],
        ]
    }

    /// Rates of a vehicle with one steered axle (x and y in m/s, heading in rad/s) about its centre of mass: `speed` in m/s,
    /// `slip` and `heading` in rad, `rear` distance of the rear axle in m.
    ///
    /// Rajamani, *Vehicle Dynamics and Control*, section 2.2.
    #[domain(rear > 0.0)]
    #[generate(value, gradient)]
    pub fn bicycle_rates(speed: f64, heading: f64, slip: f64, rear: f64) -> [f64; 3] {
        [
            speed * (heading + slip).cos(),
            speed * (heading + slip).sin(),
            speed * slip.sin() / rear,
        ]
    }
}
