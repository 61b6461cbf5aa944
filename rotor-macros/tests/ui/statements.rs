//! What is valid Rust, but no part of a formula.

#[rotor_macros::symbolic]
mod formulas {
    pub struct Pair {
        pub first: f64,
        pub second: f64,
    }

    pub struct Place(pub f64);

    pub fn statements(x: f64) -> f64 {
        let y;
        y = x;
        let mut z = y;
        z += 1.0;
        let [a, b] = [x, z];
        println!("{a}");
        return a * b;
    }

    pub fn expressions(x: f64) -> f64 {
        let branch = if x > 0.0 { x } else { 1.0 };
        let chosen = match x {
            _ => x,
        };
        let _logical = !(x > 0.0);
        let counted = loop {
            break 1.0;
        };
        let cast = 3 as f64;
        let made = std::convert::identity(x);
        let _text = "x".len();
        let closure = |t: f64| t * x;
        let called = (closure)(x);
        let _range = 0.0..x;
        let mut changed;
        let _assigned = changed = x;
        let remainder = x % 2.0;
        let _of_text = format!("{x}").len();
        branch + chosen + counted + cast + made + called + remainder
    }

    pub fn numbers(x: f64) -> f64 {
        let _whole = 2 * 3;
        let _single = 1.5_f32;
        let large = 1e9999;
        let power = x.powi(1 + 1) + x.powi(2000);
        let towers = x.powi(1000).powi(1000).powi(1000);
        let small = (1e-40 * x).powi(10) + 1e200 * 1e200;
        large + power + towers + small
    }

    pub fn made_of_parts(x: f64) -> Pair {
        let place = Place { 0: x };
        Pair { first: place.0, ..x }
    }

    #[generate(value)]
    pub fn caller(x: f64) -> f64 {
        statements(x) + expressions(x) + numbers(x) + made_of_parts(x).first
    }

    #[allow(unreachable_code)]
    pub fn two_ends(x: f64) -> f64 {
        return x;
        x + 1.0
    }

    pub fn early_end(x: f64) -> f64 {
        let _y = {
            return x;
        };
    }

    #[allow(unconditional_recursion)]
    #[generate(value)]
    pub fn recursive(x: f64) -> f64 {
        x * recursive(x - 1.0)
    }

    #[allow(unconditional_recursion)]
    #[generate(value)]
    pub fn there(x: f64) -> f64 {
        1.0 + back(x)
    }

    #[allow(unconditional_recursion)]
    #[generate(value)]
    pub fn back(x: f64) -> f64 {
        2.0 * there(x) * unheard_of
    }

    #[approximate(x = 0.0..=1.0, tolerance = 1e-3)]
    #[generate(value)]
    pub fn table_of_helper(x: f64) -> f64 {
        1.0 + helper(x)
    }

    pub fn helper(x: f64) -> f64 {
        table_of_helper::d_x(x)
    }

    pub const FIRST: f64 = 2.0 * SECOND;
    pub const SECOND: f64 = FIRST;

    #[generate(value)]
    pub fn of_a_cycle(x: f64) -> f64 {
        x * FIRST
    }

    pub fn large_power(x: f64) -> f64 {
        x.powi(1000)
    }

    #[generate(value)]
    pub fn larger_power(x: f64) -> f64 {
        large_power(large_power(large_power(x)))
    }
}

fn main() {
    let _: f64 = formulas::caller::value(1.0);
}
