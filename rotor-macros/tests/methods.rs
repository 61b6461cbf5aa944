//! Methods: formulas in `impl` blocks of structs, which call each other, within a module and from one that links it.
#![allow(
    unreachable_pub,
    clippy::float_cmp,
    reason = "formulas are `pub` as in a library; numbers are compared bit by bit"
)]

mod springs {
    pub use formulas::*;

    #[rotor_macros::symbolic]
    pub mod formulas {
        /// A spring that hardens.
        #[derive(Clone, Copy, Debug, Default)]
        pub struct Spring {
            pub stiffness: f64,
            pub hardening: f64,
        }

        impl Spring {
            /// The part of the energy that is stored at the ends.
            pub const SHARE: f64 = 0.5;
            const ORDER: usize = 2;

            /// A spring without hardening.
            pub fn linear(stiffness: f64) -> Self {
                Self {
                    stiffness,
                    hardening: 0.0,
                }
            }

            /// Energy at a length.
            #[generate(value, gradient(self, x), hessian(x, self.hardening), columns)]
            pub fn energy(&self, x: f64) -> f64 {
                Self::SHARE * self.stiffness * x.powi(Self::ORDER as i32) * self.factor(x)
            }

            /// What hardening adds.
            fn factor(self, x: f64) -> f64 {
                1.0 + self.hardening * x.powi(2)
            }

            /// The stiffer of two.
            pub fn stiffer(self, other: &Spring) -> Spring {
                if self.stiffness > other.stiffness {
                    Self { ..self.clone_of() }
                } else {
                    other.clone_of()
                }
            }

            fn clone_of(&self) -> Self {
                Spring {
                    stiffness: self.stiffness,
                    hardening: self.hardening,
                }
            }
        }

        impl std::fmt::Display for Spring {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(f, "{}", self.stiffness)
            }
        }
    }
}

#[rotor_macros::symbolic(with(springs))]
mod formulas {
    use super::springs::Spring;

    pub struct Pair {
        pub springs: [Spring; 2],
    }

    impl Pair {
        /// Energy of both, the first of which hardens twice as much.
        #[generate(value, gradient(self, x), stage(x))]
        pub fn energies(&self, x: f64) -> f64 {
            let mut first = self.springs[0];
            first.hardening *= 2.0;
            first.energy(x) + Spring::energy(&self.springs[1], x - Spring::SHARE)
        }
    }

    /// Of a struct that is made, and of one that is chosen.
    #[generate(value, gradient(x))]
    pub fn made(x: f64, other: Spring) -> f64 {
        let spring = Spring::linear(x * x);
        spring.energy(x) + spring.stiffer(&other).energy(2.0)
    }
}

use formulas::Pair;
use springs::Spring;

const SPRING: Spring = Spring {
    stiffness: 3.0,
    hardening: 0.125,
};

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 4.0 * f64::EPSILON * b.abs()
}

#[test]
fn a_method_has_forms_like_a_function() {
    use springs::energy;
    let x = 1.5;
    let (value, [by_stiffness, by_hardening, by_x]) = energy::gradient(&SPRING, x);
    assert!(close(value, SPRING.energy(x)) && close(energy::value(&SPRING, x), value));
    assert!(close(by_stiffness, 0.5 * x * x * (1.0 + 0.125 * x * x)));
    assert!(close(by_hardening, 1.5 * x.powi(4)));
    assert!(close(by_x, 3.0 * x + 4.0 * 1.5 * 0.125 * x.powi(3)));
    let (_, [again, _], [[curvature, mixed], _]) = energy::hessian(&SPRING, x);
    assert!(close(again, by_x) && close(curvature, 3.0 + 12.0 * 1.5 * 0.125 * x * x));
    assert!(close(mixed, 6.0 * x.powi(3)));
    let inputs = energy::Columns {
        self_stiffness: &[3.0, 1.0],
        self_hardening: &[0.125, 0.0],
        x: &[1.5, 2.0],
    };
    let mut energies = [0.0; 2];
    energy::columns(&inputs, [&mut energies]).expect("columns of one length");
    assert_eq!(energies, [energy::value(&SPRING, x), 2.0]);
}

#[test]
fn methods_are_called_by_name_and_by_path() {
    let other = Spring {
        stiffness: 2.0,
        hardening: 0.5,
    };
    let pair = Pair {
        springs: [SPRING, other],
    };
    let x = 1.25;
    let (value, slopes) = formulas::energies::gradient(&pair, x);
    assert!(close(value, pair.energies(x)));
    let hardened = Spring {
        hardening: 0.25,
        ..SPRING
    };
    let (_, of_first) = springs::energy::gradient(&hardened, x);
    let (_, of_second) = springs::energy::gradient(&other, x - 0.5);
    assert!(close(slopes[0], of_first[0]) && close(slopes[1], 2.0 * of_first[1]));
    assert!(close(slopes[2], of_second[0]) && close(slopes[3], of_second[1]));
    assert!(close(slopes[4], of_first[2] + of_second[2]));
}

#[test]
fn a_struct_that_a_method_gives_has_methods() {
    for x in [1.0, 2.0] {
        let (value, [slope]) = formulas::made::gradient(x, SPRING);
        assert!(close(value, formulas::made(x, SPRING)));
        let chosen = if x * x > 3.0 { 4.0 * x } else { 0.0 };
        assert!(close(slope, 2.0 * x.powi(3) + chosen), "{x}: {slope}");
    }
    assert_eq!(SPRING.to_string(), "3");
}
