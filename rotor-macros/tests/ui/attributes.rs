//! What attributes can't say.

#[rotor_macros::symbolic]
mod formulas {
    #[generate]
    pub fn no_form(x: f64) -> f64 {
        x * x
    }

    #[generate("value", values, laplacian)]
    pub fn other_forms(x: f64) -> f64 {
        x * x
    }

    #[generate(stage, stage(z))]
    pub fn no_stage(x: f64, y: f64) -> f64 {
        x * y
    }

    #[generate(gradient(x + 1.0))]
    pub fn by_no_name(x: f64) -> f64 {
        x * x
    }

    #[generate(gradient(y, x[0], c.x))]
    pub fn by_unknown_names(x: f64) -> f64 {
        x * x
    }

    #[generate(value, budget)]
    pub fn empty_budget(x: f64) -> f64 {
        x * x
    }

    #[generate(value, budget(operations, mul = 1.5, multiplications = 3, div = 99999999999999999999999))]
    pub fn wrong_budget(x: f64) -> f64 {
        x * x
    }

    #[generate(budget(operations = 0))]
    pub fn budget_of_nothing(x: f64) -> f64 {
        x * x
    }

    #[generate(value, budget(operations = 1, operations = 5))]
    pub fn two_budgets(x: f64) -> f64 {
        x * x
    }

    #[generate(value, budget(operations = 1, div = 0))]
    pub fn small_budget(x: f64, y: f64) -> f64 {
        (x * x + y) / (1.0 + x)
    }

    #[generate(value value)]
    pub fn no_list(x: f64) -> f64 {
        x * x
    }

    #[generate(value)]
    #[generate(gradient(x))]
    pub fn generated_twice(x: f64) -> f64 {
        x * x
    }

    #[generate(gradient(x), gradient(y))]
    pub fn two_gradients(x: f64, y: f64) -> f64 {
        x * y
    }

    #[domain(x > 1.0, y > 0.0, x.abs() > 0.0, x == 0.0)]
    #[generate(value)]
    pub fn wrong_domain(x: f64) -> f64 {
        x * x
    }

    #[domain(0.0 < x < 1.0)]
    #[approximate(x = 0.0..=1.0 tolerance = 1e-3)]
    #[specialise(chained x = 1.0)]
    pub fn no_lists(x: f64) -> f64 {
        x * x
    }

    pub struct Crack {
        pub beta: f64,
        pub mu: f64,
    }

    #[domain(c.bta > 0.0, c > 0.0, c[0] > 0.0, x.y > 0.0, a[7] > 0.0, none[0] > 0.0)]
    #[generate(value, gradient(c.depth_ratio, c.beto, omga))]
    pub fn of_no_numbers(c: &Crack, x: f64, a: [f64; 2], none: [f64; 0], omega: f64) -> f64 {
        let _ = none;
        c.beta * c.mu * x * a[0] * omega
    }

    #[domain(c > 0.0, c.unheard_of > 0.0)]
    #[generate(gradient(c.unheard_of))]
    pub fn of_an_outer_struct(c: &super::Outer) -> f64 {
        c.depth
    }

    #[generate(gradient(x))]
    pub fn of_nothing() -> f64 {
        1.0
    }

    #[domain(x > 0.0, y >= 0.0, x < 0.0, y <= 0.0)]
    #[generate(value)]
    pub fn contradiction(x: f64, y: f64) -> f64 {
        x.abs() * y
    }
}

pub struct Outer {
    pub depth: f64,
}

fn main() {
    // What could not be generated has its signature all the same.
    let _: (f64, [f64; 1]) = formulas::by_no_name::gradient(1.0);
    let _: f64 = formulas::small_budget::value(1.0, 2.0) + formulas::wrong_domain::value(1.0);
}
