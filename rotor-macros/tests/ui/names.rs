//! What rustc reports too, with what the generator has to say to it.

#[rotor_macros::symbolic]
mod formulas {
    use super::SPEED;
    use std::f64::consts;

    pub struct Pair {
        pub first: f64,
        pub second: f64,
    }

    pub fn product(x: f64, y: f64) -> f64 {
        x * y
    }

    pub fn both(x: f64) -> (f64, f64) {
        (x, x)
    }

    pub fn of_pair(c: &Pair) -> f64 {
        c.first * c.second
    }

    pub fn of_sides(s: &super::Sides) -> f64 {
        s.width * s.height
    }

    pub fn unknown(omega: f64) -> f64 {
        omga + unheard_of + prodct(omega, 1.0) + far_away(omega)
    }

    pub fn constants_from_outside(x: f64) -> f64 {
        x * SPEED + super::SPEED + consts::PI + E + f64::sqrt(x)
    }

    pub fn methods(x: f64) -> f64 {
        x.sqr() + x.powf(1.5) + x.to_degrees() + x.min()
    }

    pub fn arguments(x: f64, c: &Pair) -> f64 {
        product(x) + product([x, x], c) + of_pair(x)
    }

    pub fn arguments_of_unknown(x: f64) -> f64 {
        far_away(unknown_1) + product(unknown_2) + x.sinh(unknown_3) + x.max(unknown_4, unknown_5)
    }

    pub fn ambiguous_pair(a: f64, b_c: f64, a_b: f64, c: f64) -> f64 {
        a * b_c + a_b * c
    }

    pub fn ambiguous_name(x: f64, y: f64, x_y: f64) -> f64 {
        x * y * x_y
    }

    pub fn ambiguous_field(c: &Pair, c_first: f64) -> f64 {
        c.first * c_first
    }

    #[generate(value)]
    pub fn ambiguous(x: f64, c: &Pair) -> f64 {
        ambiguous_pair::d_a_b_c(x, x, x, x)
            + ambiguous_name::d_x_y(x, x, x)
            + ambiguous_field::d_c_first(c, x)
    }

    pub fn shapes(x: f64) -> f64 {
        let a = [x, x];
        let (b, c) = a;
        let t = (x, x);
        let p = Pair { first: x, second: x };
        a[2] + a[0 + 1] + x[0] + t.2 + p.third + x.y + t.sqrt() + b + c
    }

    pub fn partials(x: f64) -> f64 {
        product::d_z(x, x) + both::d_x(x) + of_sides::d_s_width(&super::Sides { width: x }) + product::d_xy(x, x)
    }

    pub fn no_value(x: f64) -> f64 {
        let _y = x;
    }

    #[generate(value, gradient)]
    pub fn caller(x: f64) -> f64 {
        unknown(x) + methods(x) + shapes(x) + no_value(x)
    }

    #[generate(gradient, columns)]
    pub fn of_outer_structs(x: f64, c: &Pair, d: [f64; 2]) -> super::Sides {
        let width = unknown(x) + c.first * c.second + d[0] + d[1];
        super::Sides { width, height: x }
    }
}

pub const SPEED: f64 = 3.0;

pub struct Sides {
    pub width: f64,
    pub height: f64,
}

fn main() {
    let _: (f64, [f64; 1]) = formulas::caller::gradient(1.0);
    let c = formulas::Pair { first: 1.0, second: 2.0 };
    let _: (Sides, [[f64; 5]; 2]) = formulas::of_outer_structs::gradient(1.0, &c, [0.0; 2]);
    let (x, mut width, mut height) = ([1.0; 3], [0.0; 3], [0.0; 3]);
    let inputs = formulas::of_outer_structs::Columns {
        x: &x,
        c_first: &x,
        c_second: &x,
        d_0: &x,
        d_1: &x,
    };
    let _: Result<(), formulas::ColumnLengthError> =
        formulas::of_outer_structs::columns(&inputs, [&mut width, &mut height]);
}
