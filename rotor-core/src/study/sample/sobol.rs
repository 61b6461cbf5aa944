//! Sobol's sequence in base 2, to 64 bits.

/// The primitive polynomial of a dimension (degree, inner coefficients) and its first direction
/// numbers, from `new-joe-kuo-6.21201` (Joe & Kuo, SIAM J. Sci. Comput. 30, 2635, 2008). The first
/// dimension is the van der Corput sequence and has none. Twelve more are one for each input, and one for the speed.
const JOE_KUO: [(u32, u64, &[u64]); 12] = [
    (1, 0, &[1]),
    (2, 1, &[1, 3]),
    (3, 1, &[1, 3, 1]),
    (3, 2, &[1, 1, 1]),
    (4, 1, &[1, 1, 3, 3]),
    (4, 4, &[1, 3, 5, 13]),
    (5, 2, &[1, 1, 5, 5, 17]),
    (5, 4, &[1, 1, 5, 5, 5]),
    (5, 7, &[1, 1, 7, 11, 19]),
    (5, 11, &[1, 1, 5, 1, 1]),
    (5, 13, &[1, 1, 1, 3, 11]),
    (5, 14, &[1, 3, 5, 5, 31]),
];

/// Direction numbers of every dimension.
static DIRECTIONS: [[u64; 64]; JOE_KUO.len() + 1] = directions();

const fn directions() -> [[u64; 64]; JOE_KUO.len() + 1] {
    let mut all = [[0; 64]; JOE_KUO.len() + 1];
    let mut bit = 0;
    while bit < 64 {
        all[0][bit] = 1 << (63 - bit);
        bit += 1;
    }
    let mut dimension = 1;
    while dimension < all.len() {
        let (degree, inner, first) = JOE_KUO[dimension - 1];
        let degree = degree as usize;
        let mut bit = 0;
        while bit < 64 {
            all[dimension][bit] = if bit < degree {
                first[bit] << (63 - bit)
            } else {
                let back = all[dimension][bit - degree];
                let mut number = back ^ (back >> degree);
                let mut k = 1;
                while k < degree {
                    if (inner >> (degree - 1 - k)) & 1 == 1 {
                        number ^= all[dimension][bit - k];
                    }
                    k += 1;
                }
                number
            };
            bit += 1;
        }
        dimension += 1;
    }
    all
}

/// The coordinate `dimension`, below 13, of the point `index`, in units of $2^{-64}$. Points stand in the order of
/// the Gray code, as in most other programs.
pub(super) fn coordinate(index: u64, dimension: u32) -> u64 {
    let directions = &DIRECTIONS[dimension as usize % DIRECTIONS.len()];
    let mut gray = index ^ (index >> 1);
    let mut coordinate = 0;
    while gray != 0 {
        coordinate ^= directions[gray.trailing_zeros() as usize];
        gray &= gray - 1;
    }
    coordinate
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_those_of_other_programs() {
        // Of scipy.stats.qmc.Sobol(13, scramble=False, bits=32), in units of 2^-32.
        let expected = [
            (
                5,
                [7, 7, 1, 3, 7, 5, 7, 3, 3, 1, 3, 7, 7].map(|eighths| eighths << 29),
            ),
            (
                37,
                [59, 41, 37, 59, 49, 19, 11, 51, 39, 11, 1, 5, 37].map(|parts| parts << 26),
            ),
        ];
        for (index, coordinates) in expected {
            for (dimension, expected) in (0..).zip(coordinates) {
                assert_eq!(coordinate(index, dimension) >> 32, expected, "{dimension}");
            }
        }
    }

    #[test]
    fn every_dimension_is_stratified() {
        for dimension in 0..13 {
            let mut cells: Vec<u64> = (0..256)
                .map(|index| coordinate(index, dimension) >> 56)
                .collect();
            cells.sort_unstable();
            assert_eq!(cells, (0..256).collect::<Vec<_>>(), "{dimension}");
        }
    }

    #[test]
    fn pairs_of_neighbouring_dimensions_are_stratified() {
        // A (0, m, 2) net: one point in each elementary interval of the first two dimensions.
        let mut cells: Vec<u64> = (0..256)
            .map(|index| (coordinate(index, 0) >> 60) << 4 | coordinate(index, 1) >> 60)
            .collect();
        cells.sort_unstable();
        assert_eq!(cells, (0..256).collect::<Vec<_>>());
    }
}
