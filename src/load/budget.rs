//! The memory that reading a file may take, checked before it is taken; and the time that its images took.

use super::{Model, Options, memory};
use crate::Error;
use crate::error::OutOfMemory;
use crate::mesh::Mesh;
use crate::texture::Pixels;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::time::{Duration, Instant};

/// How much memory a file and all that it names may take, and how much of it is taken. Clones share it.
#[derive(Clone, Debug)]
pub struct Budget {
    limit: u64,
    spent: Arc<AtomicU64>,
    /// In nanoseconds.
    decoding: Arc<AtomicU64>,
}

impl Budget {
    /// As much as the options allow.
    pub(super) fn of(options: &Options) -> Budget {
        Budget {
            limit: options.max_memory.unwrap_or_else(memory::usual_limit),
            spent: Arc::default(),
            decoding: Arc::default(),
        }
    }

    /// Takes `bytes`, before they are allocated.
    ///
    /// # Errors
    ///
    /// There are fewer left; nothing is taken then.
    pub(super) fn take(&self, bytes: u64) -> Result<(), OutOfMemory> {
        let within = |spent: u64| spent.checked_add(bytes).filter(|&all| all <= self.limit);
        let before = self.spent.fetch_update(Relaxed, Relaxed, within);
        before.map(drop).map_err(|spent| OutOfMemory {
            needs: bytes,
            left: self.limit.saturating_sub(spent),
        })
    }

    /// Finds whether `bytes` could be taken.
    ///
    /// # Errors
    ///
    /// There are fewer left.
    pub fn check(&self, bytes: u64) -> Result<(), OutOfMemory> {
        let left = self.left();
        if bytes > left {
            return Err(OutOfMemory { needs: bytes, left });
        }
        Ok(())
    }

    /// A model that `read` makes, of which only the model is kept.
    pub(super) fn reading(
        &self,
        read: impl FnOnce() -> Result<Model, Error>,
    ) -> Result<Model, Error> {
        let before = self.spent();
        let model = read()?;
        self.settle(before, bytes_of_model(&model));
        Ok(model)
    }

    /// How long images were decoded, by the clock on the wall.
    pub fn decoding(&self) -> Duration {
        Duration::from_nanos(self.decoding.load(Relaxed))
    }

    /// Adds to that what `decode` takes.
    pub(super) fn decode<T>(&self, decode: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let decoded = decode();
        let nanos = start.elapsed().as_nanos() as u64;
        self.decoding.fetch_add(nanos, Relaxed);
        decoded
    }

    /// What is not taken, in bytes.
    pub fn left(&self) -> u64 {
        self.limit.saturating_sub(self.spent())
    }

    /// What is taken, in bytes.
    pub(super) fn spent(&self) -> u64 {
        self.spent.load(Relaxed)
    }

    /// Gives back what was taken.
    pub(super) fn give_back(&self, bytes: u64) {
        let less = |spent: u64| Some(spent.saturating_sub(bytes));
        // It always is some.
        let _ = self.spent.fetch_update(Relaxed, Relaxed, less);
    }

    /// Gives back what was taken since `before` but for `kept` bytes: a file's own bytes and all that was made on the
    /// way from them are freed by now.
    pub(super) fn settle(&self, before: u64, kept: u64) {
        self.spent.store(before.saturating_add(kept), Relaxed);
    }
}

impl Default for Budget {
    /// As much as luch takes where nobody says how much.
    fn default() -> Budget {
        Budget::of(&Options::default())
    }
}

/// What the vertices, triangles and pixels of a model take, in bytes, and what places them.
pub(super) fn bytes_of_model(model: &Model) -> u64 {
    let meshes = model.meshes.iter().map(Mesh::bytes);
    let images = model.textures.iter().map(|texture| {
        let image = &texture.image;
        let all_bytes = match &image.pixels {
            Pixels::Eight(pixels) => size_of_val(pixels.as_slice()),
            Pixels::Sixteen(pixels) => size_of_val(pixels.as_slice()),
        };
        // Textures share images: each has its part.
        (all_bytes / Arc::strong_count(image)) as u64
    });
    let nodes = size_of_val(model.nodes.as_slice()) as u64;
    meshes.sum::<u64>() + images.sum::<u64>() + nodes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(bytes: u64) -> Budget {
        Budget::of(&Options {
            max_memory: Some(bytes),
            ..Options::default()
        })
    }

    #[test]
    fn what_is_left_can_be_taken_and_no_more() {
        let budget = of(10);
        assert_eq!(budget.take(6), Ok(()));
        assert_eq!(
            budget.clone().take(5),
            Err(OutOfMemory { needs: 5, left: 4 })
        );
        assert_eq!(budget.take(u64::MAX).map_err(|e| e.left), Err(4));
        assert_eq!(budget.check(4), Ok(()));
        assert_eq!(budget.take(4), Ok(()));
        budget.settle(0, 3);
        assert_eq!(budget.take(7), Ok(()));
        budget.give_back(2);
        assert_eq!(budget.left(), 2);
    }

    #[test]
    fn there_is_a_limit_where_none_is_given() {
        let limit = Budget::default().limit;
        assert!(limit > 1 << 20 && limit < 1 << 60, "{limit}");
    }

    #[test]
    fn a_lack_of_memory_is_told_with_its_way_out() {
        let problem = of(2_500_000).take(3_000_001).map_err(|e| e.to_string());
        let expected =
            "takes 4 MB of memory, 2 MB are left; make it smaller, or allow more with --max-memory";
        assert_eq!(problem, Err(expected.into()));
    }
}
