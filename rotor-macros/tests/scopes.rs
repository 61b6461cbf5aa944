//! Formulas over types of other modules, and names that meet once a field's dot is gone.
#![allow(unreachable_pub, reason = "a formula is `pub` as in a library")]

/// A rectangle's sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sides {
    /// Width, m.
    pub width: f64,
    /// Height, m.
    pub height: f64,
}

#[rotor_macros::symbolic]
mod formulas {
    /// A rectangle's diagonal, m, from its sides and its height once more.
    #[generate(value, gradient, columns)]
    pub fn diagonal(s: &super::Sides, s_height: f64) -> f64 {
        (s.width.powi(2) + s.height * s_height).sqrt()
    }

    /// A rectangle of twice the size.
    #[generate(value)]
    pub fn doubled(s: &super::Sides) -> super::Sides {
        super::Sides {
            width: 2.0 * s.width,
            height: 2.0 * s.height,
        }
    }

    /// A size of this module.
    pub struct Size {
        /// Area, m².
        pub area: f64,
    }

    /// Area of a rectangle.
    #[generate(value)]
    pub fn size(s: &super::Sides) -> self::Size {
        self::Size {
            area: s.width * s.height,
        }
    }
}

const SIDES: Sides = Sides {
    width: 3.0,
    height: 4.0,
};

#[test]
fn types_of_the_module_around_it_are_found() {
    assert_eq!(formulas::diagonal::value(&SIDES, 4.0), 5.0);
    let doubled = formulas::doubled::value(&SIDES);
    assert_eq!((doubled.width, doubled.height), (6.0, 8.0));
    assert_eq!(formulas::size::value(&SIDES).area, 12.0);
    assert_eq!(formulas::size(&SIDES).area, 12.0);
}

#[test]
fn names_that_meet_stay_two_columns() {
    let inputs = formulas::diagonal::Columns {
        s_width: &[3.0, 0.0],
        s_height: &[4.0, 2.0],
        s_height_: &[4.0, 8.0],
    };
    let mut diagonal = [0.0; 2];
    let outcome = formulas::diagonal::columns(&inputs, [&mut diagonal]);
    assert_eq!((outcome, diagonal), (Ok(()), [5.0, 4.0]));
}
