//! Choices, sides and products that are rounded once: in packs the numbers of the standard library, on every level, also where
//! operands are zeros, infinities and what is no number.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking too")]

use lanes::{ALL, Kernel, Level, Pack, Simd, store};

struct Choices;

impl Kernel<0, 3, 7> for Choices {
    #[inline(always)]
    fn evaluate<S: Simd>(_: S, _: [Pack<S>; 0], [a, b, c]: [Pack<S>; 3]) -> [Pack<S>; 7] {
        [
            a.min(b),
            a.max(b),
            a.side(),
            a.select_eq(b, c, a),
            a.mul_add(b, c),
            a.at_most(b),
            a.at_least(b),
        ]
    }
}

const NUMBERS: [f64; 11] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
    5e-324,
    f64::MAX,
    0.1,
    -0.3,
];

/// The same bits; any of two numbers that are none; zeros of any sign where the standard library leaves it open.
fn are_same(found: f64, right: f64) -> bool {
    found.to_bits() == right.to_bits()
        || (found.is_nan() && right.is_nan())
        || (found == 0.0 && right == 0.0)
}

#[test]
fn they_are_those_of_the_standard_library() {
    let triples = NUMBERS.iter().flat_map(|a| {
        let pairs = NUMBERS
            .iter()
            .flat_map(|b| NUMBERS.iter().map(move |c| (*b, *c)));
        pairs.map(move |(b, c)| (*a, b, c))
    });
    let triples: Vec<(f64, f64, f64)> = triples.collect();
    let column = |part: fn(&(f64, f64, f64)) -> f64| triples.iter().map(part).collect::<Vec<_>>();
    let [a, b, c] = [column(|it| it.0), column(|it| it.1), column(|it| it.2)];
    for level in Level::available() {
        let mut results = [(); 7].map(|()| vec![f64::NAN; a.len()]);
        let slices = results.each_mut().map(Vec::as_mut_slice);
        store::<Choices, ALL, 0, 3, 7>(level, &[], [&a, &b, &c], slices).unwrap();
        for (row, (a, b, c)) in triples.iter().enumerate() {
            let right = [
                a.min(*b),
                a.max(*b),
                1.0_f64.copysign(a + 0.0),
                if a == b { *c } else { *a },
                a.mul_add(*b, *c),
                if a < b { *a } else { *b },
                if a > b { *a } else { *b },
            ];
            for (column, right) in results.iter().zip(right) {
                let found = column[row];
                // The sign of what is no number says nothing of its side.
                let is_open = a.is_nan() && right.abs() == 1.0 && found.abs() == 1.0;
                assert!(
                    is_open || are_same(found, right),
                    "{level:?}: {found} beside {right} at {a}, {b}, {c}"
                );
            }
        }
    }
}
