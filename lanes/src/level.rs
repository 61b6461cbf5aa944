//! Which instructions a kernel runs on: found once, when the program runs.

use std::fmt;
use std::str::FromStr;
use std::sync::OnceLock;

use thiserror::Error;

/// The environment variable that forces a level, such as `LANES_LEVEL=baseline`.
const VARIABLE: &str = "LANES_LEVEL";

/// A set of instructions that kernels run on. Results have the same bits on every level.
///
/// ```
/// use lanes::Level;
///
/// let best = Level::best();
/// println!("kernels run on {best}");
/// assert!(best.is_available());
/// assert_eq!("avx2".parse(), Ok(Level::Avx2));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Level {
    /// The instructions that every machine of the target has: packs of 2 on x86-64 (SSE2) and ARM64.
    Baseline,
    /// AVX2 and FMA: packs of 4.
    Avx2,
    /// AVX-512 as in Ice Lake and Zen 4: packs of 8.
    Avx512,
}

/// Says that a name is no [`Level`].
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("there is no level {found:?}; levels are baseline, avx2, avx512")]
pub struct UnknownLevel {
    /// What was given.
    pub found: String,
}

impl Level {
    /// All levels, the narrowest first.
    pub const ALL: [Self; 3] = [Self::Baseline, Self::Avx2, Self::Avx512];

    /// Whether the machine has its instructions.
    pub fn is_available(self) -> bool {
        self <= widest()
    }

    /// The levels that the machine has, the narrowest first.
    pub fn available() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|level| level.is_available())
    }

    /// Finds the level to run on, once: the widest that the machine has, or a narrower one that the environment variable
    /// `LANES_LEVEL` names. A value of the variable that is no level is ignored.
    pub fn best() -> Self {
        static BEST: OnceLock<Level> = OnceLock::new();
        *BEST.get_or_init(|| {
            let forced = std::env::var(VARIABLE).ok();
            let forced = forced.and_then(|name| name.parse::<Self>().ok());
            forced.map_or_else(widest, Self::at_most_available)
        })
    }

    /// Narrows the level to the widest that the machine has.
    pub fn at_most_available(self) -> Self {
        self.min(widest())
    }

    /// The name, such as `avx2`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Level {
    type Err = UnknownLevel;

    fn from_str(text: &str) -> Result<Self, UnknownLevel> {
        let found = Self::ALL.into_iter().find(|level| level.name() == text);
        found.ok_or_else(|| UnknownLevel {
            found: text.to_owned(),
        })
    }
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
fn widest() -> Level {
    let found = fearless_simd::Level::new();
    if found.as_avx512().is_some() {
        Level::Avx512
    } else if found.as_avx2().is_some() {
        Level::Avx2
    } else {
        Level::Baseline
    }
}

#[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
fn widest() -> Level {
    Level::Baseline
}

/// A computation that is generic over the instructions it runs on.
pub(crate) trait Body {
    /// What comes of it.
    type Output;

    /// Runs it on the instructions that `simd` proves to be there.
    fn run<S: fearless_simd::Simd>(self, simd: S) -> Self::Output;
}

/// Runs a body on a level, or on the widest one below it that the machine has.
pub(crate) fn run<B: Body>(level: Level, body: B) -> B::Output {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        use fearless_simd::Simd;
        let found = fearless_simd::Level::new();
        if let Some(simd) = found.as_avx512().filter(|_| level == Level::Avx512) {
            return simd.vectorize(
                #[inline(always)]
                || on_lines(body, simd),
            );
        }
        if let Some(simd) = found.as_avx2().filter(|_| level >= Level::Avx2) {
            return simd.vectorize(
                #[inline(always)]
                || on_lines(body, simd),
            );
        }
    }
    // Elsewhere there is one level.
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    let _ = level;
    baseline(body)
}

/// Runs a body in a stack frame that starts at a line of the cache.
///
/// Packs for which no register is left are kept in the stack frame. The compiler does not align it for them, so that in half
/// of all processes each of these packs would lie in two lines of the cache: the gradients of the widths, with 700 such loads
/// and stores, took 15 % longer there. A frame that holds one aligned value is aligned as a whole.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
#[inline(always)]
fn on_lines<B: Body, S: fearless_simd::Simd>(body: B, simd: S) -> B::Output {
    #[repr(align(64))]
    struct Aligned(#[expect(dead_code, reason = "only its alignment counts")] u8);
    let mut aligned = Aligned(0);
    std::hint::black_box(&mut aligned);
    body.run(simd)
}

#[cfg(all(
    any(target_arch = "x86", target_arch = "x86_64"),
    target_feature = "fxsr",
    target_feature = "sse2"
))]
pub(crate) fn baseline<B: Body>(body: B) -> B::Output {
    use fearless_simd::Simd;
    // SSE2 is named here because a choice among all levels would compile the body once more for each.
    let Some(simd) = fearless_simd::Level::baseline().as_sse2() else {
        unreachable!("every machine of the target has SSE2");
    };
    simd.vectorize(
        #[inline(always)]
        || body.run(simd),
    )
}

#[cfg(not(all(
    any(target_arch = "x86", target_arch = "x86_64"),
    target_feature = "fxsr",
    target_feature = "sse2"
)))]
pub(crate) fn baseline<B: Body>(body: B) -> B::Output {
    fearless_simd::dispatch!(fearless_simd::Level::baseline(), simd => body.run(simd))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_read_back() {
        for level in Level::ALL {
            assert_eq!(level.to_string().parse(), Ok(level));
        }
        let error = "sse9".parse::<Level>().unwrap_err();
        assert!(error.to_string().contains("baseline, avx2, avx512"));
    }

    #[test]
    fn a_level_that_is_missing_gives_way_to_the_widest() {
        let widest = Level::available().last().unwrap();
        assert_eq!(Level::Avx512.at_most_available(), widest);
        assert_eq!(Level::Baseline.at_most_available(), Level::Baseline);
        assert!(Level::best().is_available());
    }
}
