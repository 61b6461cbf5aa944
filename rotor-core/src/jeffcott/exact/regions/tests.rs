use super::*;

fn polynomial(coefficients: &[i64]) -> Whole {
    Whole::new(coefficients.iter().copied().map(BigInt::from).collect())
}

/// The product of x − root / 2^places, times 2^places each.
fn with_roots(roots: &[(i64, u64)]) -> Whole {
    roots
        .iter()
        .fold(polynomial(&[1]), |product, (root, places)| {
            product.times(&Whole::new(vec![
                BigInt::from(-root),
                BigInt::from(1) << *places,
            ]))
        })
}

fn roots_of(polynomial: &Whole) -> Vec<(f64, usize)> {
    let roots = positive_roots(polynomial, None);
    roots.iter().map(|root| (root.value, root.count)).collect()
}

#[test]
fn positive_roots_alone_are_found() {
    // Zero, −3, 5/8 and 7, with x² + 1.
    let real = with_roots(&[(0, 0), (-3, 0), (5, 3), (7, 0)]);
    let found = roots_of(&real.times(&polynomial(&[1, 0, 1])));
    assert_eq!(found.len(), 2, "{found:?}");
    for ((value, count), expected) in found.into_iter().zip([0.625, 7.0]) {
        assert!(
            (value / expected - 1.0_f64).abs() < 4.0 * f64::EPSILON,
            "{value}"
        );
        assert_eq!(count, 1);
    }
    assert_eq!(roots_of(&polynomial(&[1, 0, 1])), []);
}

#[test]
fn roots_of_all_sizes_have_their_digits() {
    // 3·2^−200 and 5·2^120 from x − 3·2^−200 and x·2^−120 − 5, and 3·2^−200 (1 + 2^−100).
    let tiny = Whole::new(vec![BigInt::from(-3), BigInt::from(1) << 200_u64]);
    let beside = Whole::new(vec![
        BigInt::from(-3) * ((BigInt::from(1) << 100_u64) + 1),
        BigInt::from(1) << 300_u64,
    ]);
    let huge = Whole::new(vec![BigInt::from(-5) << 120_u64, BigInt::from(1)]);
    let found = roots_of(&tiny.times(&huge).times(&beside));
    let expected = [
        3.0 * 2.0_f64.powi(-200),
        3.0 * 2.0_f64.powi(-200),
        5.0 * 2.0_f64.powi(120),
    ];
    assert_eq!(found.len(), 3, "{found:?}");
    for ((value, count), expected) in found.into_iter().zip(expected) {
        assert!(
            (value / expected - 1.0).abs() < 4.0 * f64::EPSILON,
            "{value:e}"
        );
        assert_eq!(count, 1);
    }
}

#[test]
fn a_double_root_is_a_cluster_of_two() {
    // At a third, which no halving meets, and at a half, which one does.
    for root in [
        vec![BigInt::from(-1), BigInt::from(3)],
        vec![BigInt::from(-1), BigInt::from(2)],
    ] {
        let single = Whole::new(root);
        let found = roots_of(&single.times(&single).times(&polynomial(&[-2, 1])));
        let expected = if single == polynomial(&[-1, 3]) {
            1.0 / 3.0
        } else {
            0.5
        };
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(
            (found[0].0 - expected).abs() < 1e-16 && found[0].1 == 2,
            "{found:?}"
        );
        assert!((found[1].0 - 2.0).abs() < 1e-15, "{found:?}");
    }
}

#[test]
fn there_is_room_between_neighbours() {
    // 2^−1 and (1 + 2^−90)/2 beside it, in both orders of what is met by halving.
    let near = Whole::new(vec![
        BigInt::from(-1) - (BigInt::from(1) << 90_u64),
        BigInt::from(1) << 91_u64,
    ]);
    let below = Whole::new(vec![
        BigInt::from(1) - (BigInt::from(1) << 90_u64),
        BigInt::from(1) << 91_u64,
    ]);
    let roots = positive_roots(&with_roots(&[(1, 1)]).times(&near).times(&below), None);
    assert_eq!(roots.len(), 3);
    let all = between(&roots);
    for (sample, root) in all.iter().zip(&roots) {
        assert!(!root.low.is_less(sample), "{sample:?} {root:?}");
    }
    for (sample, root) in all.iter().skip(1).zip(&roots) {
        assert!(!sample.is_less(&root.high), "{sample:?} {root:?}");
    }
}

#[test]
fn the_discriminant_is_the_product_of_squared_differences() {
    // (x − 1)(x − 2)(x − 4)(x − 7).
    let constants = with_roots(&[(1, 0), (2, 0), (4, 0), (7, 0)]);
    let each: Vec<Whole> = constants
        .coefficients()
        .iter()
        .map(|coefficient| Whole::new(vec![coefficient.clone()]))
        .collect();
    let quartic = Quartic(each.try_into().unwrap());
    let differences: i64 = [1_i64, 3, 6, 2, 5, 3]
        .iter()
        .map(|apart| apart * apart)
        .product();
    assert_eq!(quartic.discriminant(), polynomial(&[27 * differences]));
}
