//! Methods that are no formulas.

#[rotor_macros::symbolic]
mod formulas {
    #[derive(Clone, Copy)]
    pub struct Disk {
        pub mass: f64,
    }

    pub trait Inertia {
        fn inertia(&self) -> f64;
    }

    impl Inertia for Disk {
        #[generate(value)]
        fn inertia(&self) -> f64 {
            self.mass
        }
    }

    impl Disk {
        #[generate(value)]
        pub fn changed(&mut self, x: f64) -> f64 {
            self.mass += x;
            self.mass
        }

        #[generate(value, gradient(self.radius))]
        pub fn misspelt(&self) -> f64 {
            self.heavier(2.0) + self.mas + Self::UNKNOWN + Disk::unknown(1.0)
        }

        pub fn heavy(&self, factor: f64) -> f64 {
            self.mass * factor
        }

        pub fn arguments(&self) -> f64 {
            self.heavy() + self.heavy(*self) + Self::heavy(1.0, 2.0)
        }

        #[allow(unconditional_recursion)]
        pub fn again(&self) -> f64 {
            1.0 + self.and_again()
        }

        #[allow(unconditional_recursion)]
        pub fn and_again(&self) -> f64 {
            2.0 * self.again()
        }

        #[specialise(of_one, self.mass = 1.0)]
        #[generate(value, chain)]
        pub fn special(&self) -> f64 {
            self.mass
        }

        #[generate(value)]
        pub fn twice(&self) -> f64 {
            self.mass
        }
    }

    #[generate(value)]
    pub fn twice(x: f64) -> f64 {
        2.0 * x
    }
}

fn main() {}
