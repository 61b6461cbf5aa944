//! Long bodies in parts, each of which goes over a few packs before the next one begins.
//!
//! A processor looks a few hundred instructions ahead for one that waits for no other. In a body of as many, in which roots,
//! quotients and sums wait for each other, one pack is under way at a time, and the multipliers are idle half of the time. In
//! parts of some forty instructions several packs are under way. What a part computes for a later one is kept meanwhile
//! ([`Kept`]), which costs a store and a load of the nearest cache. The generator cuts bodies where little is to be kept.

use std::marker::PhantomData;
use std::ops::Range;

use fearless_simd::Simd;

use crate::pack::Pack;

/// How many packs go through a part before the next part begins: as many as hide the ends of its loop. What a body of 250
/// operations keeps for them, some 25 numbers of each pack, fills a fifth of the nearest cache with packs of 4.
pub const GROUP: usize = 8;

/// A number that one part of a body computes and a later one takes, of each pack of a group.
#[derive(Clone, Copy, Debug)]
pub struct Kept<S: Simd>([Pack<S>; GROUP]);

impl<S: Simd> Kept<S> {
    /// Creates a place for a number.
    #[inline(always)]
    pub fn empty(simd: S) -> Self {
        Self([Pack::splat(simd, 0.0); GROUP])
    }

    /// Takes the number of a pack of the group.
    ///
    /// # Panics
    /// Where the group has no such pack.
    #[inline(always)]
    pub fn get(&self, pack: usize) -> Pack<S> {
        self.0[pack]
    }

    /// Keeps the number of a pack of the group.
    ///
    /// # Panics
    /// Where the group has no such pack.
    #[inline(always)]
    pub fn set(&mut self, pack: usize, number: Pack<S>) {
        self.0[pack] = number;
    }
}

/// Some consecutive packs of columns, at most [`GROUP`].
#[derive(Clone, Copy, Debug)]
pub struct Group<S> {
    first: usize,
    packs: usize,
    simd: PhantomData<S>,
}

impl<S: Simd> Group<S> {
    /// The numbers of its packs, from 0.
    #[inline(always)]
    pub fn packs(&self) -> Range<usize> {
        0..self.packs
    }

    /// The first row of a pack.
    #[inline(always)]
    pub const fn row(&self, pack: usize) -> usize {
        self.first + pack * Pack::<S>::LENGTH
    }

    /// Loads a pack of a column.
    ///
    /// # Panics
    /// Where the column ends before it.
    #[inline(always)]
    pub fn load(&self, simd: S, column: &[f64], pack: usize) -> Pack<S> {
        let row = self.row(pack);
        Pack::load(simd, &column[row..row + Pack::<S>::LENGTH])
    }
}

/// The whole packs of so many rows, group after group.
#[derive(Clone, Copy, Debug)]
pub struct Groups<S> {
    next: usize,
    rows: usize,
    simd: PhantomData<S>,
}

impl<S: Simd> Groups<S> {
    /// Divides so many rows, whole packs.
    #[inline(always)]
    pub const fn of(rows: usize) -> Self {
        Self {
            next: 0,
            rows,
            simd: PhantomData,
        }
    }

    /// Takes the next group, until there is none.
    #[expect(
        clippy::should_implement_trait,
        reason = "methods of iterators are not always inlined into the loops of kernels"
    )]
    #[inline(always)]
    pub fn next(&mut self) -> Option<Group<S>> {
        let left = (self.rows - self.next) / Pack::<S>::LENGTH;
        if left == 0 {
            return None;
        }
        let (first, packs) = (self.next, left.min(GROUP));
        self.next += packs * Pack::<S>::LENGTH;
        Some(Group {
            first,
            packs,
            simd: PhantomData,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_have_every_whole_pack_once_in_order() {
        struct Rows(usize);
        impl crate::level::Body for Rows {
            type Output = (Vec<usize>, usize);
            fn run<S: Simd>(self, _: S) -> (Vec<usize>, usize) {
                let (mut starts, mut groups) = (Vec::new(), Groups::<S>::of(self.0));
                while let Some(group) = groups.next() {
                    assert!(group.packs().len() <= GROUP);
                    starts.extend(group.packs().map(|pack| group.row(pack)));
                }
                (starts, Pack::<S>::LENGTH)
            }
        }
        for level in crate::Level::available() {
            for rows in [0, 8, 16, 64, 72, 256, 1000] {
                let (starts, length) = crate::level::run(level, Rows(rows));
                let expected: Vec<_> = (0..rows / length).map(|pack| pack * length).collect();
                assert_eq!(starts, expected, "{rows} rows on {level}");
            }
        }
    }
}
