//! Stores past the caches.
//!
//! An ordinary store reads its line into the cache first, and drives out another one that is read again soon. Where results
//! are more than the caches hold, both are in vain: a store past the caches writes a whole line to memory.

use fearless_simd::Simd;

use crate::pack::Pack;

/// How many numbers are a line of the cache.
pub(crate) const LINE: usize = 8;

/// A line of the cache.
#[repr(C, align(64))]
pub(crate) struct Line([f64; LINE]);

/// A stretch of the program that writes past the caches. When it ends, other threads may read what it wrote.
#[derive(Debug)]
pub(crate) struct Stream {
    #[cfg(target_arch = "x86_64")]
    avx512: Option<fearless_simd::Avx512>,
}

impl Stream {
    #[inline(always)]
    pub(crate) fn begin<S: Simd>(simd: S) -> Self {
        #[cfg(not(target_arch = "x86_64"))]
        let _ = simd;
        Self {
            #[cfg(target_arch = "x86_64")]
            avx512: simd.level().as_avx512(),
        }
    }

    /// The lines of a column, and how many rows stand before them. None where packs are no lines, or there is no
    /// instruction for stores past the caches.
    #[inline(always)]
    pub(crate) fn lines<'a>(&self, column: &'a mut [f64]) -> (usize, &'a mut [Line]) {
        #[cfg(target_arch = "x86_64")]
        if self.avx512.is_some() {
            #[expect(unsafe_code, reason = "a line has an alignment, numbers have not")]
            // SAFETY: a `Line` is eight numbers one after the other, and any bits are numbers.
            let (before, lines, _) = unsafe { column.align_to_mut::<Line>() };
            return (before.len(), lines);
        }
        #[cfg(not(target_arch = "x86_64"))]
        let _ = column;
        (0, &mut [])
    }

    /// Writes a pack to one of the [lines](Self::lines), past the caches.
    #[inline(always)]
    pub(crate) fn store<S: Simd>(&self, pack: Pack<S>, line: &mut Line) {
        #[cfg(target_arch = "x86_64")]
        if let Some(avx512) = self.avx512 {
            use fearless_simd::SimdBase;
            let numbers = fearless_simd::f64x8::from_slice(avx512, pack.as_slice());
            return avx512::store(avx512, numbers, line);
        }
        pack.store(&mut line.0);
    }
}

#[cfg(target_arch = "x86_64")]
impl Drop for Stream {
    #[inline(always)]
    fn drop(&mut self) {
        if let Some(avx512) = self.avx512 {
            avx512::fence(avx512);
        }
    }
}

#[cfg(target_arch = "x86_64")]
mod avx512 {
    use std::arch::x86_64::{_mm_sfence, _mm512_stream_pd};

    use fearless_simd::{Avx512, f64x8};

    use super::Line;

    fearless_simd::kernel!(
        /// Writes to a line; [`fence`] must follow before anything else is done with it.
        #[inline]
        pub(super) fn store(avx512: Avx512, numbers: f64x8<Avx512>, line: &mut Line) {
            #[expect(unsafe_code, reason = "the crate `fearless_simd` has no such store")]
            // SAFETY: these are 64 bytes that may be written, aligned as they must be. Only a `Stream` calls this, and it
            // fences when it is dropped, before the loop over the rows gives the results back.
            unsafe {
                _mm512_stream_pd(line.0.as_mut_ptr(), numbers.into());
            }
        }
    );

    fearless_simd::kernel!(
        /// Lets what was stored be read.
        #[inline]
        pub(super) fn fence(avx512: Avx512) {
            _mm_sfence();
        }
    );
}
