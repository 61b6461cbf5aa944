//! The points of a scan: the product of its axes.

use crate::input::Variable;

use super::axis::Axis;
use crate::error::{Error, StudyError};

/// The most points of a scan, $2^{53}$: up to there every count is exact as a double too.
pub const MOST_POINTS: u64 = 1 << 53;

/// The product of the axes, the last one innermost: point 1 differs from point 0 in its value of
/// the last axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Space {
    axes: Vec<Axis>,
    length: u64,
}

impl Space {
    /// The product of axes.
    ///
    /// # Errors
    /// Where there is no axis, two vary the same variable, or there are more points than
    /// [`MOST_POINTS`].
    pub fn new(axes: Vec<Axis>) -> Result<Self, Error> {
        for (index, axis) in axes.iter().enumerate() {
            let before = axes.get(..index).unwrap_or_default();
            let is_varied = |variable: &Variable| before.iter().any(|axis| axis.varies(*variable));
            if let Some(twice) = axis.variables().find(is_varied) {
                let input = twice.name();
                return Err(StudyError::VariedTwice { input }.into());
            }
        }
        if axes.is_empty() {
            return Err(StudyError::NoAxis.into());
        }
        let length = axes
            .iter()
            .try_fold(1_u64, |product, axis| product.checked_mul(axis.len()))
            .filter(|&length| length <= MOST_POINTS)
            .ok_or_else(|| {
                let lengths: Vec<_> = axes.iter().map(|axis| axis.len().to_string()).collect();
                StudyError::TooManyPoints {
                    lengths: lengths.join(" × "),
                    most: MOST_POINTS,
                }
            })?;
        Ok(Self { axes, length })
    }

    /// How many points there are, at least one.
    #[expect(clippy::len_without_is_empty, reason = "a space is never empty")]
    pub const fn len(&self) -> u64 {
        self.length
    }

    /// The axes, the innermost last.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// The axes but the innermost, and the innermost.
    pub(super) fn outer_and_inner(&self) -> Option<(&[Axis], &Axis)> {
        self.axes.split_last().map(|(inner, outer)| (outer, inner))
    }

    /// The points between two that differ by one in the axis number `axis`.
    pub fn stride(&self, axis: usize) -> u64 {
        let inside = self.axes.get(axis + 1..).unwrap_or_default();
        inside.iter().map(Axis::len).product()
    }

    /// The index along the axis number `axis` of a point.
    pub fn index(&self, axis: usize, point: u64) -> u64 {
        let length = self.axes.get(axis).map_or(1, Axis::len);
        point / self.stride(axis) % length
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::NumericInput;

    fn axis(name: &str, count: u64) -> Axis {
        Axis::linear(NumericInput::find(name).unwrap(), (0.1, 0.4), count).unwrap()
    }

    #[test]
    fn the_last_axis_is_innermost() {
        let space = Space::new(vec![axis("crack.depth_ratio", 3), axis("crack.angle", 4)]).unwrap();
        assert_eq!(space.len(), 12);
        let indices: Vec<_> = (0..12)
            .map(|point| (space.index(0, point), space.index(1, point)))
            .collect();
        assert_eq!(indices[..5], [(0, 0), (0, 1), (0, 2), (0, 3), (1, 0)]);
    }

    #[test]
    fn too_many_points_are_refused_and_not_wrapped() {
        let long = |name| axis(name, 1 << 40);
        let error = Space::new(vec![long("crack.depth_ratio"), long("crack.angle")]).unwrap_err();
        assert!(
            error.to_string().contains("1099511627776 × 1099511627776"),
            "{error}"
        );
        let twice = Space::new(vec![axis("crack.angle", 2), axis("crack.angle", 2)]);
        assert_eq!(
            twice.unwrap_err(),
            StudyError::VariedTwice {
                input: "crack_angle"
            }
            .into()
        );
        assert_eq!(Space::new(vec![]).unwrap_err(), StudyError::NoAxis.into());
    }
}
