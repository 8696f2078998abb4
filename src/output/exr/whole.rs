//! Whether an EXR is all there.

use exr::block::UncompressedBlock;
use exr::block::reader::ChunksReader;
use exr::error::Result;
use std::io::{Read, Seek};

/// Whether `file` has all that its table of offsets promises, and all of it can be read.
pub(in crate::output) fn is_whole(file: impl Read + Seek) -> bool {
    read(file).is_ok()
}

fn read(file: impl Read + Seek) -> Result<()> {
    let chunks = exr::block::read(file, true)?.all_chunks(true)?;
    let meta_data = chunks.meta_data().clone();
    for chunk in chunks {
        UncompressedBlock::decompress_chunk(chunk?, &meta_data, true)?;
    }
    Ok(())
}
