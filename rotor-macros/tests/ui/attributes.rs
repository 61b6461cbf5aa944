//! What attributes can't say.

#[rotor_macros::symbolic]
mod formulas {
    #[generate]
    pub fn no_form(x: f64) -> f64 {
        x * x
    }

    #[generate("value", values, jacobian)]
    pub fn other_forms(x: f64) -> f64 {
        x * x
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
}

fn main() {
    // What could not be generated has its signature all the same.
    let _: (f64, [f64; 1]) = formulas::by_no_name::gradient(1.0);
    let _: f64 = formulas::small_budget::value(1.0, 2.0) + formulas::wrong_domain::value(1.0);
}
