//! Loops, assignments and whole numbers that are no part of a formula.

#[rotor_macros::symbolic]
mod formulas {
    pub const N: usize = 3;

    pub fn endless(x: f64) -> f64 {
        let mut y = x;
        while y > 1.0 {
            y *= 0.5;
        }
        y
    }

    pub fn left_early(x: f64) -> f64 {
        let mut y = x;
        for _ in 0..N {
            if y > 10.0 {
                break;
            }
            y *= 2.0;
        }
        y
    }

    pub fn early_end(x: f64) -> f64 {
        for _ in 0..N {
            if x > 10.0 {
                return x;
            }
        }
        1.0
    }

    pub fn by_steps_of_a_number(x: f64) -> f64 {
        let mut y = x;
        for i in 0.0..x {
            y += i;
        }
        for i in 0.. {
            y += i as f64;
        }
        for part in x {
            y += part;
        }
        y
    }

    pub fn changed_in_place(x: f64) -> f64 {
        let mut a = [x, 1.0];
        for part in &mut a {
            *part *= 2.0;
        }
        for part in a.iter_mut() {
            *part *= 2.0;
        }
        a[0]
    }

    pub fn too_long(x: f64) -> f64 {
        let mut y = x;
        for i in 0..1000 {
            for j in 0..1000 {
                y += (i * j) as f64;
            }
        }
        for _ in 0..200_000 {
            y += 1.0;
        }
        y
    }

    pub fn too_long_by_its_call(x: f64) -> f64 {
        too_long(x)
    }

    pub fn hidden_changes(x: f64) -> f64 {
        let mut y = x;
        let is_large = x > 1.0 && {
            y = 2.0;
            true
        };
        let sum: f64 = [1.0, 2.0]
            .iter()
            .map(|z| {
                y += z;
                y
            })
            .sum();
        if is_large { sum } else { y }
    }

    pub fn no_values(x: f64) -> f64 {
        let y = {
            let _z = x;
        };
        if x > 0.0 {
            x + 1.0;
        }
        x + y
    }

    pub fn no_value(mut x: f64) -> f64 {
        x += 1.0;
    }

    pub fn whole_numbers(x: f64) -> f64 {
        let n = 3;
        let largest = 2_000_000_000 + 2_000_000_000;
        let mixed = n * x + n as f64 * 2;
        let quotient = 1 / (n - 3);
        let small = 300 as u8;
        let root = n.sqrt();
        let single = n as f32;
        let power = x.powi(x) + x.powi(n * 1000);
        let rest = x % 2.0 + (n & 1) as f64;
        let mut counter = 0;
        counter += 1.0;
        let mut number = x;
        number += 1;
        number %= 2.0;
        let chosen = if x > 0.0 { n } else { 0 };
        if n > x {
            number = 0.0;
        }
        mixed + power + rest + root + number + chosen as f64 + counter as f64
    }

    pub fn places(x: f64) -> f64 {
        let mut a = [x, 1.0];
        a[2] = 1.0;
        a[x] += 2.0;
        a[0][1] = 3.0;
        a.first = 1.0;
        N = 4;
        2.0 = x;
        a *= 2.0;
        let mut b = a[0];
        b[0] = 3.0;
        a[N] + a[-1]
    }
}

fn main() {}
