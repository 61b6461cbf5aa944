//! The error function and its complement in twice the digits.

use super::DoubleDouble;
use crate::graph::{Function, NamedConstant};
use crate::interpret::Number;

/// Up to here the complement is 1 less the error function: it is above 1/1000, so that three digits are lost at most.
const NEAR: f64 = 2.0;

/// From here on the error function is 1 to more digits than twice those of an `f64`.
const FAR: f64 = 9.0;

/// Below this a complement has no second part that is a normal number.
const SMALLEST: f64 = 1e-280;

impl DoubleDouble {
    /// The error function or its complement, whose nearest `f64` is known.
    pub(super) fn error_function(self, function: Function, nearest: f64) -> Self {
        let one = Self::exact(1.0);
        if self.high < 0.0 {
            let mirrored = (-self).error_function(function, libm_of(function, -self.high));
            return match function {
                Function::Erf => -mirrored,
                _ => Self::exact(2.0).minus(mirrored),
            };
        }
        match function {
            Function::Erf if self.high > FAR => one,
            Function::Erf if self.high > NEAR => one.minus(self.complement(nearest)),
            Function::Erf => self.near_zero(),
            _ if self.high > NEAR => self.complement(nearest),
            _ => one.minus(self.near_zero()),
        }
    }

    /// 2/√π·e^(−x²)·Σ 2ⁿx^(2n+1)/(1·3·…·(2n+1)), all of whose terms have one sign.
    fn near_zero(self) -> Self {
        let square = self.times(self);
        let (mut term, mut sum) = (self, self);
        let mut divisor = 1.0;
        while term.high > sum.high * f64::EPSILON.powi(2) {
            divisor += 2.0;
            term = term.times(square).scaled(2.0).over(Self::exact(divisor));
            sum = sum.plus(term);
        }
        let root = Self::constant(NamedConstant::Pi).sqrt();
        sum.times((-square).exp()).scaled(2.0).over(root)
    }

    /// e^(−x²)/√π/(x + ½/(x + 1/(x + 3⁄2/(x + …)))), beyond [`NEAR`].
    fn complement(self, nearest: f64) -> Self {
        if nearest < SMALLEST {
            return Self::exact(nearest);
        }
        // With so many levels less than 1e-33 of it is left out, as seen from 2 to 25 beside 60 digits.
        let levels = (1600.0 / (self.high * self.high)).ceil() + 20.0;
        let mut below = self;
        let mut level = levels;
        while level > 0.0 {
            below = self.plus(Self::exact(0.5 * level).over(below));
            level -= 1.0;
        }
        let square = self.times(self);
        let root = Self::constant(NamedConstant::Pi).sqrt();
        (-square).exp().over(root.times(below))
    }
}

fn libm_of(function: Function, x: f64) -> f64 {
    match function {
        Function::Erf => libm::erf(x),
        _ => libm::erfc(x),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::decimal;

    /// Values in 36 digits, made with mpmath 1.3 in 60.
    const VALUES: [(f64, &str, &str); 7] = [
        (
            0.0009765625,
            "0.00110193243007181470417125349611857369",
            "0.998898067569928185295828746503881426",
        ),
        (
            0.375,
            "0.404116909434822298323825085919121768",
            "0.595883090565177701676174914080878232",
        ),
        (
            1.0,
            "0.842700792949714869341220635082609259",
            "0.157299207050285130658779364917390741",
        ),
        (
            1.9375,
            "0.993856806395213199993129862383607907",
            "0.00614319360478680000687013761639209334",
        ),
        (
            2.5,
            "0.999593047982555041060435784260025087",
            "0.00040695201744495893956421573997491272",
        ),
        (
            5.75,
            "0.999999999999999576786338257426237405",
            "4.23213661742573762594671985271897163e-16",
        ),
        (20.0, "1.0", "5.3958656116079009289349991679053456e-176"),
    ];

    #[test]
    fn values_have_twice_the_digits() {
        for (x, erf, erfc) in VALUES {
            for (function, expected) in [(Function::Erf, erf), (Function::Erfc, erfc)] {
                let expected = decimal(expected).unwrap();
                let expected = DoubleDouble::rational(&expected);
                for (x, right) in [
                    (x, expected),
                    (
                        -x,
                        match function {
                            Function::Erf => -expected,
                            _ => DoubleDouble::exact(2.0).minus(expected),
                        },
                    ),
                ] {
                    let found = DoubleDouble::exact(x).elementary(function);
                    let apart = found.minus(right).high.abs();
                    assert!(
                        apart <= 1e-28 * right.high.abs(),
                        "{function:?}({x}): {apart}"
                    );
                }
            }
        }
    }
}
