//! Stores past the caches.
//!
//! An ordinary store reads its line into the cache first, and drives out another one that is read again soon. Where results
//! are more than the caches hold, both are in vain: a store past the caches writes a whole line to memory.

use fearless_simd::Simd;

use crate::pack::Pack;

/// How many numbers are a line of the cache.
const LINE: usize = 8;

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

    /// The first row of a column at which packs are lines; 0 where they are never.
    #[inline(always)]
    pub(crate) fn first_row<S: Simd>(column: &[f64]) -> usize {
        if Pack::<S>::LENGTH != LINE {
            return 0;
        }
        let row = column.as_ptr().align_offset(LINE * size_of::<f64>());
        if row < LINE { row } else { 0 }
    }

    /// Writes a pack to a slice as long; past the caches where it is a line and there is an instruction for it.
    #[inline(always)]
    pub(crate) fn store<S: Simd>(&self, pack: Pack<S>, slice: &mut [f64]) {
        #[cfg(target_arch = "x86_64")]
        if let Some(avx512) = self.avx512
            && let Ok(line) = <&mut [f64; LINE]>::try_from(&mut *slice)
            && avx512::is_line(line)
        {
            use fearless_simd::SimdBase;
            let numbers = fearless_simd::f64x8::from_slice(avx512, pack.as_slice());
            return avx512::store(avx512, numbers, line);
        }
        pack.store(slice);
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

    /// Where a line may stand.
    #[repr(align(64))]
    struct Line;

    /// Whether eight numbers are a line of the cache.
    #[inline(always)]
    pub(super) fn is_line(numbers: &[f64; 8]) -> bool {
        numbers.as_ptr().cast::<Line>().is_aligned()
    }

    fearless_simd::kernel!(
        /// Writes to a line; [`fence`] must follow before anything else is done with it.
        #[inline]
        pub(super) fn store(avx512: Avx512, numbers: f64x8<Avx512>, line: &mut [f64; 8]) {
            assert!(is_line(line));
            #[expect(unsafe_code, reason = "the crate `fearless_simd` has no such store")]
            // SAFETY: these are 64 bytes that may be written, aligned as they must be. Only a `Stream` calls this, and it
            // fences when it is dropped, before the loop over the rows gives the results back.
            unsafe {
                _mm512_stream_pd(line.as_mut_ptr(), numbers.into());
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
