//! The loops: results, tails, what is not wanted, consumers, and mismatched columns.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking too")]

use lanes::{ALL, Consumer, Groups, Kept, Kernel, Level, Pack, Simd, fold, once, store};

/// `a·x + y`, and `|x|` beside it.
struct Line;

impl Kernel<1, 2, 2> for Line {
    #[inline(always)]
    fn evaluate<S: Simd>(_: S, [a]: [Pack<S>; 1], [x, y]: [Pack<S>; 2]) -> [Pack<S>; 2] {
        [a * x + y, x.abs()]
    }
}

/// The same as [`Line`] in two parts, between which `a·x` and `x` are kept.
struct LineInParts;

impl Kernel<1, 2, 2> for LineInParts {
    #[inline(always)]
    fn evaluate<S: Simd>(simd: S, fixed: [Pack<S>; 1], along: [Pack<S>; 2]) -> [Pack<S>; 2] {
        Line::evaluate(simd, fixed, along)
    }

    #[inline(always)]
    fn for_each_pack<S: Simd>(
        simd: S,
        [a]: [Pack<S>; 1],
        [x, y]: [&[f64]; 2],
        mut take: impl FnMut(usize, [Pack<S>; 2]),
    ) {
        let mut kept = [Kept::empty(simd); 2];
        let mut groups = Groups::<S>::of(x.len());
        while let Some(group) = groups.next() {
            for pack in group.packs() {
                let x = group.load(simd, x, pack);
                kept[0].set(pack, a * x);
                kept[1].set(pack, x);
            }
            for pack in group.packs() {
                let y = group.load(simd, y, pack);
                let size = kept[1].get(pack).abs();
                take(group.row(pack), [kept[0].get(pack) + y, size]);
            }
        }
    }
}

#[test]
fn a_body_in_parts_gives_what_it_gives_in_one() {
    // Up to three groups of the longest packs, and a tail.
    for rows in (0..40).chain([63, 64, 65, 127, 128, 130, 200]) {
        let [x, y] = columns(rows);
        for level in Level::available() {
            let mut whole = [vec![f64::NAN; rows], vec![f64::NAN; rows]];
            let mut parts = whole.clone();
            let [first, second] = &mut whole;
            store::<Line, ALL, 1, 2, 2>(level, &[3.0], [&x, &y], [first, second]).unwrap();
            let [first, second] = &mut parts;
            store::<LineInParts, ALL, 1, 2, 2>(level, &[3.0], [&x, &y], [first, second]).unwrap();
            assert_eq!(parts, whole, "{rows} rows on {level}");
            let sum = fold::<LineInParts, Sum, 1, 2, 2>(level, &[3.0], [&x, &y], &mut Sum);
            assert_eq!(sum.unwrap(), whole[0].iter().sum::<f64>());
        }
    }
}

/// The sum of the first result.
struct Sum;

impl Consumer<2> for Sum {
    type Lanes<S: Simd> = f64;
    type Output = f64;

    #[inline(always)]
    fn begin<S: Simd>(&self, _: S) -> f64 {
        0.0
    }

    #[inline(always)]
    fn take<S: Simd>(&mut self, sum: &mut f64, _: usize, rows: usize, results: &[Pack<S>; 2]) {
        *sum += results[0].as_slice().iter().take(rows).sum::<f64>();
    }

    #[inline(always)]
    fn end<S: Simd>(&self, sum: f64) -> f64 {
        sum
    }
}

fn columns(rows: usize) -> [Vec<f64>; 2] {
    let x = (0..rows).map(|row| row as f64 - 7.0).collect();
    let y = (0..rows).map(|row| 0.25 * row as f64).collect();
    [x, y]
}

#[test]
fn every_row_of_every_length_on_every_level() {
    for rows in 0..40 {
        let [x, y] = columns(rows);
        for level in Level::available() {
            let mut results = [vec![f64::NAN; rows], vec![f64::NAN; rows]];
            let [first, second] = &mut results;
            store::<Line, ALL, 1, 2, 2>(level, &[3.0], [&x, &y], [first, second]).unwrap();
            for row in 0..rows {
                assert_eq!(results[0][row], 3.0 * x[row] + y[row]);
                assert_eq!(results[1][row], x[row].abs());
            }
            let sum = fold::<Line, Sum, 1, 2, 2>(level, &[3.0], [&x, &y], &mut Sum).unwrap();
            assert_eq!(sum, results[0].iter().sum::<f64>());
        }
    }
}

#[test]
fn one_row_has_the_bits_that_it_has_in_a_column() {
    let [x, y] = columns(67);
    for level in Level::available() {
        let mut results = [vec![f64::NAN; 67], vec![f64::NAN; 67]];
        let slices = results.each_mut().map(Vec::as_mut_slice);
        store::<Line, ALL, 1, 2, 2>(level, &[3.0], [&x, &y], slices).unwrap();
        for row in 0..67 {
            let alone = once::<Line, 1, 2, 2>(&[3.0], &[x[row], y[row]]);
            assert_eq!(
                alone.map(f64::to_bits),
                [0, 1].map(|place: usize| results[place][row].to_bits())
            );
        }
    }
}

#[test]
fn what_is_not_wanted_is_left_alone() {
    // Fewer rows than a pack has, and more.
    for rows in [5, 11] {
        let [x, y] = columns(rows);
        let mut second = vec![f64::NAN; rows];
        let results = [&mut [][..], &mut second];
        store::<Line, 2, 1, 2, 2>(Level::best(), &[3.0], [&x, &y], results).unwrap();
        assert!(second.iter().zip(&x).all(|(size, x)| *size == x.abs()));
        store::<Line, 0, 1, 2, 2>(Level::best(), &[3.0], [&x, &y], [&mut [], &mut []]).unwrap();
    }
}

#[test]
fn a_column_of_another_length_is_refused() {
    let [x, y] = columns(8);
    let mut first = [0.0; 8];
    let mut second = [0.0; 7];
    let level = Level::best();
    let results = [&mut first[..], &mut second[..]];
    let error = store::<Line, ALL, 1, 2, 2>(level, &[3.0], [&x, &y], results).unwrap_err();
    assert_eq!((error.column, error.length, error.expected), (3, 7, 8));
    let results = [&mut first[..], &mut [][..]];
    let error = store::<Line, 1, 1, 2, 2>(level, &[3.0], [&x, &y[..5]], results).unwrap_err();
    assert_eq!((error.column, error.length, error.expected), (1, 5, 8));
    let error = fold::<Line, Sum, 1, 2, 2>(level, &[3.0], [&x, &y[..5]], &mut Sum).unwrap_err();
    assert_eq!(
        error.to_string(),
        "column 1 has 5 rows; it must have 8, as the first one has"
    );
}
