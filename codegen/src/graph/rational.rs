//! Rational constants. Nearly all are 1, −1 and other small fractions, which are held without memory of their own.

mod large;

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::num::NonZeroU64;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub};
use std::sync::Arc;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{Pow, Signed, ToPrimitive};
use smallvec::{Array, SmallVec};

use large::{common_divisor, product, sum};

/// An exact rational constant.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Rational(Parts);

/// The parts of a fraction in lowest terms with a denominator above 0, the smaller kind wherever it holds them: equal numbers
/// have equal parts.
#[derive(Clone, Eq)]
enum Parts {
    /// Both magnitudes are at most [`i64::MAX`]. As the denominator is not zero, a number is no longer than its two parts.
    Small(i64, NonZeroU64),
    Large(Arc<BigRational>),
}

use Parts::{Large, Small};

/// The denominator of a whole number.
const WHOLE: NonZeroU64 = NonZeroU64::MIN;

impl PartialEq for Parts {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Small(a, b), Small(c, d)) => (a, b) == (c, d),
            // Their own comparison divides its way to the parts.
            (Large(left), Large(right)) => {
                Arc::ptr_eq(left, right)
                    || (left.numer() == right.numer() && left.denom() == right.denom())
            }
            _ => false,
        }
    }
}

impl Hash for Parts {
    fn hash<H: Hasher>(&self, state: &mut H) {
        match self {
            Small(numerator, denominator) => (numerator, denominator).hash(state),
            // Its own hash divides its way to the parts.
            Large(value) => (value.numer(), value.denom()).hash(state),
        }
    }
}

/// A whole number as a rational constant.
pub fn whole(value: i64) -> Rational {
    Rational::of_whole(value.into())
}

/// The quotient of two whole numbers as a rational constant; the denominator is not zero.
pub fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::reduced(numerator.into(), denominator.into())
}

impl Rational {
    /// The number 0.
    pub const ZERO: Self = Self(Small(0, WHOLE));

    /// The number 1.
    pub const ONE: Self = Self(Small(1, WHOLE));

    /// The quotient of two whole numbers; the denominator is not zero.
    pub fn new(numerator: BigInt, denominator: BigInt) -> Self {
        let divisor = common_divisor(&numerator, &denominator);
        let divisor = if denominator.is_negative() {
            -divisor
        } else {
            divisor
        };
        Self::of_big(BigRational::new_raw(
            numerator / &divisor,
            denominator / &divisor,
        ))
    }

    /// A whole number.
    pub fn from_integer(value: BigInt) -> Self {
        Self::of_big(BigRational::from_integer(value))
    }

    fn of_big(value: BigRational) -> Self {
        match (to_small(value.numer()), to_small(value.denom())) {
            (Some(numerator), Some(denominator)) => Self::of_small(numerator, denominator),
            _ => Self(Large(Arc::new(value))),
        }
    }

    /// A fraction in lowest terms whose parts are small, with a denominator above 0.
    fn of_small(numerator: i64, denominator: i64) -> Self {
        let denominator = NonZeroU64::new(denominator.unsigned_abs());
        Self(Small(numerator, denominator.unwrap_or(WHOLE)))
    }

    /// A whole number below 2¹²⁷ in magnitude.
    fn of_whole(value: i128) -> Self {
        match i64::try_from(value) {
            Ok(small) if small != i64::MIN => Self(Small(small, WHOLE)),
            _ => Self::from_integer(value.into()),
        }
    }

    /// A fraction in lowest terms, of parts below 2¹²⁷ in magnitude and a denominator that is not zero.
    fn reduced(numerator: i128, denominator: i128) -> Self {
        let divisor = match (
            u64::try_from(numerator.abs()),
            u64::try_from(denominator.abs()),
        ) {
            (Ok(numerator), Ok(denominator)) => numerator.gcd(&denominator).into(),
            _ => numerator.gcd(&denominator),
        };
        let divisor = divisor * denominator.signum();
        let (numerator, denominator) = if divisor == 1 {
            (numerator, denominator)
        } else {
            (numerator / divisor, denominator / divisor)
        };
        match (i64::try_from(numerator), i64::try_from(denominator)) {
            (Ok(numerator), Ok(denominator)) if numerator != i64::MIN => {
                Self::of_small(numerator, denominator)
            }
            _ => {
                let value = BigRational::new_raw(numerator.into(), denominator.into());
                Self(Large(Arc::new(value)))
            }
        }
    }

    fn to_big(&self) -> BigRational {
        match &self.0 {
            Small(numerator, denominator) => {
                BigRational::new_raw((*numerator).into(), denominator.get().into())
            }
            Large(value) => BigRational::clone(value),
        }
    }

    /// The numerator of the fraction in lowest terms; it has the number's sign.
    pub fn numerator(&self) -> BigInt {
        match &self.0 {
            Small(numerator, _) => (*numerator).into(),
            Large(value) => value.numer().clone(),
        }
    }

    /// Binary digits of the longer of numerator and denominator.
    pub fn bits(&self) -> u64 {
        match &self.0 {
            Small(numerator, denominator) => {
                let longer = numerator.unsigned_abs().max(denominator.get());
                u64::from(u64::BITS - longer.leading_zeros())
            }
            Large(value) => value.numer().bits().max(value.denom().bits()),
        }
    }

    /// The number, where it is whole and small.
    pub fn to_i64(&self) -> Option<i64> {
        match &self.0 {
            Small(numerator, WHOLE) => Some(*numerator),
            _ => None,
        }
    }

    /// The denominator of the fraction in lowest terms, above 0.
    pub fn denominator(&self) -> BigInt {
        match &self.0 {
            Small(_, denominator) => denominator.get().into(),
            Large(value) => value.denom().clone(),
        }
    }

    /// Whether it is 0.
    pub fn is_zero(&self) -> bool {
        *self == Self::ZERO
    }

    /// Whether it is 1.
    pub fn is_one(&self) -> bool {
        *self == Self::ONE
    }

    /// Whether it is 1 or −1.
    pub fn is_unit(&self) -> bool {
        matches!(self.0, Small(1 | -1, WHOLE))
    }

    /// Whether it is a whole number.
    pub fn is_integer(&self) -> bool {
        match &self.0 {
            Small(_, denominator) => *denominator == WHOLE,
            Large(value) => value.is_integer(),
        }
    }

    /// Whether it is above 0.
    pub fn is_positive(&self) -> bool {
        match &self.0 {
            Small(numerator, _) => *numerator > 0,
            Large(value) => value.is_positive(),
        }
    }

    /// Whether it is below 0.
    pub fn is_negative(&self) -> bool {
        !self.is_positive() && !self.is_zero()
    }

    /// Its magnitude.
    pub fn abs(&self) -> Self {
        if self.is_negative() {
            -self
        } else {
            self.clone()
        }
    }

    /// 1, 0 or −1.
    pub fn signum(&self) -> Self {
        match (self.is_positive(), self.is_zero()) {
            (true, _) => Self::ONE,
            (_, true) => Self::ZERO,
            _ => -Self::ONE,
        }
    }

    /// Its power; a number that is 0 has none below 0.
    pub fn pow(&self, exponent: i32) -> Self {
        match exponent {
            1 => self.clone(),
            -1 => Self::ONE / self,
            _ => Self::of_big(Pow::pow(&self.to_big(), exponent)),
        }
    }

    /// The number that a number of double precision is; `None` if that is not finite.
    pub fn of_f64(value: f64) -> Option<Self> {
        BigRational::from_float(value).map(Self::of_big)
    }

    /// The nearest number of double precision.
    pub fn to_f64(&self) -> Option<f64> {
        match &self.0 {
            // Below 2⁵³ every whole number is one of double precision.
            Small(numerator, denominator)
                if (numerator.unsigned_abs() | denominator.get()) >> 53 == 0 =>
            {
                Some(*numerator as f64 / denominator.get() as f64)
            }
            _ => self.to_big().to_f64(),
        }
    }

    /// Numerator and denominator in lowest terms, where both are small.
    pub fn small_parts(&self) -> Option<(i64, u64)> {
        match &self.0 {
            Small(numerator, denominator) => Some((*numerator, denominator.get())),
            Large(_) => None,
        }
    }

    /// Whether it is a number of double precision.
    pub fn is_f64(&self) -> bool {
        match &self.0 {
            Small(numerator, denominator) => {
                let odd = numerator.unsigned_abs() >> numerator.trailing_zeros().min(63);
                denominator.is_power_of_two() && odd < 1 << 53
            }
            Large(value) if value.denom().magnitude().count_ones() > 1 => false,
            Large(_) => {
                let nearest = self.to_f64().and_then(Self::of_f64);
                nearest.is_some_and(|nearest| nearest == *self)
            }
        }
    }

    /// The number, if it is a whole one of 32 bits.
    pub fn to_i32(&self) -> Option<i32> {
        match &self.0 {
            Small(numerator, WHOLE) => (*numerator).try_into().ok(),
            _ => None,
        }
    }
}

fn to_small(value: &BigInt) -> Option<i64> {
    value.to_i64().filter(|small| *small != i64::MIN)
}

impl Default for Rational {
    fn default() -> Self {
        Self::ZERO
    }
}

impl fmt::Display for Rational {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.to_big(), formatter)
    }
}

impl fmt::Debug for Rational {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, formatter)
    }
}

impl Ord for Rational {
    fn cmp(&self, other: &Self) -> Ordering {
        match (&self.0, &other.0) {
            (Small(a, b), Small(c, d)) if b == d => a.cmp(c),
            (Small(a, b), Small(c, d)) => {
                (i128::from(*a) * i128::from(d.get())).cmp(&(i128::from(*c) * i128::from(b.get())))
            }
            _ => {
                let left = self.numerator() * other.denominator();
                left.cmp(&(other.numerator() * self.denominator()))
            }
        }
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Neg for &Rational {
    type Output = Rational;

    fn neg(self) -> Rational {
        match &self.0 {
            Small(numerator, denominator) => Rational(Small(-numerator, *denominator)),
            Large(value) => Rational(Large(Arc::new(-&**value))),
        }
    }
}

impl Neg for Rational {
    type Output = Rational;

    fn neg(self) -> Rational {
        -&self
    }
}

impl Add<&Rational> for &Rational {
    type Output = Rational;

    fn add(self, other: &Rational) -> Rational {
        match (&self.0, &other.0) {
            (Small(a, WHOLE), Small(c, WHOLE)) => {
                Rational::of_whole(i128::from(*a) + i128::from(*c))
            }
            (Small(a, b), Small(c, d)) => {
                let [a, c] = [a, c].map(|part| i128::from(*part));
                let [b, d] = [b, d].map(|part| i128::from(part.get()));
                if b == d {
                    Rational::reduced(a + c, b)
                } else {
                    Rational::reduced(a * d + c * b, b * d)
                }
            }
            _ => sum(&self.to_big(), &other.to_big()),
        }
    }
}

impl Mul<&Rational> for &Rational {
    type Output = Rational;

    fn mul(self, other: &Rational) -> Rational {
        match (&self.0, &other.0) {
            (Small(1, WHOLE), _) => other.clone(),
            (_, Small(1, WHOLE)) => self.clone(),
            (Small(a, WHOLE), Small(c, WHOLE)) => {
                Rational::of_whole(i128::from(*a) * i128::from(*c))
            }
            (Small(a, b), Small(c, d)) => {
                let [a, c] = [a, c].map(|part| i128::from(*part));
                let [b, d] = [b, d].map(|part| i128::from(part.get()));
                Rational::reduced(a * c, b * d)
            }
            _ => product(&self.to_big(), &other.to_big()),
        }
    }
}

impl Sub<&Rational> for &Rational {
    type Output = Rational;

    fn sub(self, other: &Rational) -> Rational {
        self + &-other
    }
}

impl Div<&Rational> for &Rational {
    type Output = Rational;

    /// The divisor is not zero.
    fn div(self, other: &Rational) -> Rational {
        match (&self.0, &other.0) {
            (_, Small(1, WHOLE)) => self.clone(),
            (_, Small(-1, WHOLE)) => -self,
            (Large(a), Large(b)) if a == b => Rational::ONE,
            (Small(a, b), Small(c, d)) if *c != 0 => {
                let [a, c] = [a, c].map(|part| i128::from(*part));
                let [b, d] = [b, d].map(|part| i128::from(part.get()));
                Rational::reduced(a * d, b * c)
            }
            _ => product(&self.to_big(), &other.to_big().recip()),
        }
    }
}

/// The operators for numbers that are given away.
macro_rules! owned {
    ($($trait:ident $method:ident),*) => {$(
        impl $trait<Rational> for Rational {
            type Output = Rational;

            fn $method(self, other: Rational) -> Rational {
                $trait::$method(&self, &other)
            }
        }

        impl $trait<&Rational> for Rational {
            type Output = Rational;

            fn $method(self, other: &Rational) -> Rational {
                $trait::$method(&self, other)
            }
        }

        impl $trait<Rational> for &Rational {
            type Output = Rational;

            fn $method(self, other: Rational) -> Rational {
                $trait::$method(self, &other)
            }
        }
    )*};
}

owned!(Add add, Sub sub, Mul mul, Div div);

impl AddAssign<&Rational> for Rational {
    fn add_assign(&mut self, other: &Rational) {
        *self = &*self + other;
    }
}

impl MulAssign<&Rational> for Rational {
    fn mul_assign(&mut self, other: &Rational) {
        *self = &*self * other;
    }
}

/// Makes one term of those with the same operand, or one power of those with the same factor, by ascending operand, and
/// drops those that come to nothing.
pub(crate) fn collect<A, K, N>(terms: &mut SmallVec<A>)
where
    A: Array<Item = (K, N)>,
    K: Ord,
    N: Default + PartialEq + for<'a> AddAssign<&'a N>,
{
    terms.sort_by(|left, right| left.0.cmp(&right.0));
    terms.dedup_by(|later, first| {
        let same = later.0 == first.0;
        if same {
            first.1 += &later.1;
        }
        same
    });
    terms.retain(|(_, number)| *number != N::default());
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Parts of which many are so large that sums and products do not fit into the small kind.
    fn part() -> impl Strategy<Value = i64> {
        prop_oneof![
            -12_i64..=12,
            any::<i64>(),
            Just(i64::MAX),
            Just(i64::MIN),
            Just(i64::MIN + 1)
        ]
    }

    fn number() -> impl Strategy<Value = (Rational, BigRational)> {
        let parts = (
            part(),
            part().prop_filter("a denominator", |part| *part != 0),
        );
        parts.prop_map(|(n, d)| (ratio(n, d), BigRational::new(n.into(), d.into())))
    }

    /// The number is the big one, in the kind that its size asks for.
    fn is(number: &Rational, big: &BigRational) -> bool {
        let is_small = to_small(big.numer()).is_some() && to_small(big.denom()).is_some();
        number.to_big() == *big && matches!(number.0, Small(..)) == is_small
    }

    proptest! {
        #[test]
        fn arithmetic_is_that_of_big_numbers((a, big_a) in number(), (b, big_b) in number()) {
            prop_assert!(is(&a, &big_a));
            prop_assert!(is(&(&a + &b), &(&big_a + &big_b)));
            prop_assert!(is(&(&a - &b), &(&big_a - &big_b)));
            prop_assert!(is(&(&a * &b), &(&big_a * &big_b)));
            if !b.is_zero() {
                prop_assert!(is(&(&a / &b), &(&big_a / &big_b)));
                prop_assert!(is(&b.pow(-3), &Pow::pow(&big_b, -3)));
            }
            prop_assert!(is(&-&a, &-&big_a));
            prop_assert!(is(&a.abs(), &big_a.abs()));
            prop_assert!(is(&a.signum(), &big_a.signum()));
            prop_assert_eq!(a.cmp(&b), big_a.cmp(&big_b));
            prop_assert_eq!(a == b, big_a == big_b);
            prop_assert_eq!(a.to_f64(), big_a.to_f64());
            prop_assert_eq!(a.is_integer(), big_a.is_integer());
            let nearest = big_a.to_f64().and_then(BigRational::from_float);
            prop_assert_eq!(a.is_f64(), nearest == Some(big_a.clone()));
            prop_assert_eq!(a.to_i32(), big_a.is_integer().then(|| big_a.to_i32()).flatten());
        }
    }

    #[test]
    fn a_small_number_is_no_longer_than_its_parts() {
        assert_eq!(size_of::<Rational>(), 2 * size_of::<i64>());
    }

    #[test]
    fn terms_of_the_same_operand_are_one() {
        let terms = [
            (2, whole(3)),
            (1, whole(1)),
            (2, ratio(1, 2)),
            (1, whole(-1)),
        ];
        let mut terms = SmallVec::from(terms);
        collect(&mut terms);
        assert_eq!(terms[..], [(2, ratio(7, 2))]);
    }
}
