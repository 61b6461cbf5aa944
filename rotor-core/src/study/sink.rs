//! Where the chunks of a scan go.

use std::convert::Infallible;

use super::chunk::{Chunk, Counts};

/// A place for chunks, such as a file.
///
/// Chunks are encoded on the threads that computed them, many at once and in any order, and taken
/// on the calling thread, one after the other in the order of the scan. At most a few chunks per
/// thread are in memory.
pub trait Sink: Sync {
    /// What is made of a chunk.
    type Encoded: Send;
    /// Why a chunk could not be encoded or taken.
    type Error: Send;

    /// The counts of a chunk that is there already, from a run before: it is not computed again.
    fn finished(&self, _number: u64) -> Option<Counts> {
        None
    }

    /// Encodes a chunk.
    ///
    /// # Errors
    /// The sink's own; it ends the scan.
    fn encode(&self, chunk: &Chunk<'_>) -> Result<Self::Encoded, Self::Error>;

    /// Takes the next encoded chunk.
    ///
    /// # Errors
    /// The sink's own; it ends the scan.
    fn take(&self, number: u64, encoded: Self::Encoded) -> Result<(), Self::Error>;
}

/// Keeps nothing: for scans that are only timed or counted.
#[derive(Clone, Copy, Debug, Default)]
pub struct Discard;

impl Sink for Discard {
    type Encoded = ();
    type Error = Infallible;

    fn encode(&self, _chunk: &Chunk<'_>) -> Result<(), Infallible> {
        Ok(())
    }

    fn take(&self, _number: u64, _encoded: ()) -> Result<(), Infallible> {
        Ok(())
    }
}
