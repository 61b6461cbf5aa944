//! Combination regions of strong excitation, which run into others: their ends are where roots meet, or there are none.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking too")]

use rotor_core::equations::Coefficients;
use rotor_core::error::{Error, RegionError};
use rotor_core::jeffcott::exact::{combination_ends, squared_offsets};
use rotor_core::jeffcott::region::{Region, RegionKind};

/// How far from an end its two sides are looked at, in parts of the speed.
const ASIDE: f64 = 1e-6;

fn complex_roots(c: &Coefficients, speed: f64) -> usize {
    let roots = squared_offsets(c, speed).unwrap();
    roots.iter().filter(|root| root.im != 0.0).count()
}

fn ends(c: &Coefficients) -> Result<[f64; 2], Error> {
    let start = Region::of(RegionKind::Combination, c).unwrap().start();
    combination_ends(c, start).map(|ends| [ends.lower, ends.upper])
}

/// Where these rotors' regions would end, if followed from the start, a minor is zero: the product that is followed says nothing
/// of the roots there.
#[test]
fn where_a_minor_is_zero_is_no_end() {
    for c in [
        Coefficients {
            beta: 0.218_877_473_494_752_28,
            gamma: 0.100_878_270_066_356_16,
            delta: 1.432_513_323_556_012,
            epsilon_1: 0.820_248_910_980_482,
            epsilon_12: 0.512_428_471_981_872_5,
            epsilon_2: 0.490_555_970_761_388_24,
            disk_asymmetry: 0.374_149_456_068_419_43,
            crack_angle: 2.808_638_681_864_879_4,
        },
        Coefficients {
            beta: 0.598_823_537_919_37,
            gamma: -0.067_681_595_637_686_8,
            delta: 0.816_337_418_848_086_4,
            epsilon_1: -0.801_118_967_623_166_9,
            epsilon_12: 0.032_799_153_809_941_52,
            epsilon_2: 0.190_061_906_421_505_92,
            disk_asymmetry: 0.535_928_797_169_646_8,
            crack_angle: 2.240_036_289_678_155_6,
        },
        Coefficients {
            beta: 0.237_644_184_898_092_14,
            gamma: -0.130_262_271_755_323_04,
            delta: 1.065_889_321_392_650_1,
            epsilon_1: 0.466_034_341_387_718_7,
            epsilon_12: -0.004_173_572_997_008_887,
            epsilon_2: -0.138_356_482_493_635_55,
            disk_asymmetry: 0.311_683_425_538_774_04,
            crack_angle: 1.737_023_313_970_476_7,
        },
    ] {
        for end in ends(&c).unwrap() {
            let sides = [end * (1.0 - ASIDE), end * (1.0 + ASIDE)];
            let [below, above] = sides.map(|speed| complex_roots(&c, speed));
            assert_ne!(below, above, "no roots meet at {end} of {c:?}");
        }
    }
}

#[test]
fn a_region_within_others_has_no_ends_of_its_own() {
    let c = Coefficients {
        beta: 0.754_392_503_800_076_9,
        gamma: 0.024_077_825_422_570_243,
        delta: 0.187_130_134_831_418_35,
        epsilon_1: 0.807_988_412_393_827,
        epsilon_12: -0.531_475_696_064_667_4,
        epsilon_2: -0.352_605_819_674_590_7,
        disk_asymmetry: 0.107_438_181_148_449_83,
        crack_angle: 2.268_433_200_562_261,
    };
    let found = ends(&c);
    assert!(
        matches!(found, Err(Error::Region(RegionError::NoExactEnds { .. }))),
        "{found:?}"
    );
}
