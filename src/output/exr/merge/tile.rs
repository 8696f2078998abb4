//! One tile: a file that is checked before anything of it is believed.

use crate::Error;
use crate::film::Window;
use exr::block::UncompressedBlock;
use exr::block::chunk::{Chunk, CompressedBlock};
use exr::math::Vec2;
use exr::meta::attribute::LineOrder;
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};
use exr::prelude::Compression;
use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

/// The most bytes of pixels, unpacked: as much as a film may take.
const MOST_BYTES: u64 = 4 << 30;
/// No zipped bytes become more than so many times as many.
const MOST_ZIPPED: u64 = 1_100;
/// What is left of very short blocks.
const SHORT: u64 = 1 << 16;

/// A tile, still packed.
pub(super) struct Tile {
    pub(super) file: PathBuf,
    pub(super) window: Window,
    /// Of one part, as [`Tile::read`] finds.
    meta: MetaData,
    /// Block by block from the top, each there.
    chunks: Vec<Chunk>,
}

impl Tile {
    /// Reads a file, and checks it.
    pub(super) fn read(file: &Path) -> Result<Tile, Error> {
        let is_file = fs::metadata(file)
            .map_err(Error::io(file, "open"))?
            .is_file();
        if !is_file {
            let problem = "is a folder, a device or a pipe, expected a file";
            return Err(Error::malformed(file, "", problem));
        }
        let bytes = fs::read(file).map_err(Error::io(file, "read"))?;
        let read = exr::block::read(Cursor::new(bytes), true).map_err(said(file, "its header"))?;
        let window = checked(file, read.headers())?;
        let meta = read.meta_data().clone();
        let found = read
            .all_chunks(true)
            .map_err(said(file, "its table of blocks"))?;
        let mut chunks: Vec<Chunk> = found
            .collect::<Result<_, _>>()
            .map_err(said(file, "its blocks"))?;
        chunks.sort_by_key(row_of);
        let tile = Tile {
            file: file.to_owned(),
            window,
            meta,
            chunks,
        };
        tile.check_chunks()?;
        Ok(tile)
    }

    /// Its only part's.
    pub(super) fn header(&self) -> &Header {
        &self.meta.headers[0]
    }

    fn lines(&self) -> usize {
        self.header().compression.scan_lines_per_block()
    }

    /// The block that has a row of the tile, and which of its lines that is.
    pub(super) fn block_of(&self, row: i64) -> (usize, usize) {
        let down = usize::try_from(row - i64::from(self.window.top)).unwrap_or(0);
        (down / self.lines(), down % self.lines())
    }

    /// The numbers of a block: line by line, channel by channel.
    pub(super) fn unpack(&self, number: usize) -> Result<Vec<u8>, Error> {
        let Some(chunk) = self.chunks.get(number) else {
            return Ok(Vec::new());
        };
        UncompressedBlock::decompress_chunk(chunk.clone(), &self.meta, true)
            .map(|block| block.data)
            .map_err(said(&self.file, &format!("block {number} of its pixels")))
    }

    /// Finds whether every block is there, once, and no shorter than it can be.
    fn check_chunks(&self) -> Result<(), Error> {
        let header = self.header();
        let lines = self.lines();
        let zipped = [Compression::ZIP1, Compression::ZIP16].contains(&header.compression);
        for (number, chunk) in self.chunks.iter().enumerate() {
            let expected = i64::from(self.window.top) + (number * lines) as i64;
            if row_of(chunk).map(i64::from) != Some(expected) {
                let problem = "is missing or there twice; render the tile again";
                let place = format!("the block from row {expected}");
                return Err(Error::malformed(&self.file, place, problem));
            }
            let CompressedBlock::ScanLine(block) = &chunk.compressed_block else {
                continue;
            };
            let most = block.compressed_pixels_le.len() as u64 * MOST_ZIPPED + SHORT;
            if zipped && header.max_block_byte_size() as u64 > most {
                let problem = "is too short for its pixels; render the tile again";
                let place = format!("the block from row {expected}");
                return Err(Error::malformed(&self.file, place, problem));
            }
        }
        Ok(())
    }
}

/// The first row of a block of scan lines.
fn row_of(chunk: &Chunk) -> Option<i32> {
    match &chunk.compressed_block {
        CompressedBlock::ScanLine(block) => Some(block.y_coordinate),
        _ => None,
    }
}

/// The data window of a file that luch could have written.
fn checked(file: &Path, headers: &[Header]) -> Result<Window, Error> {
    let unsupported = |what: &str| Error::Unsupported {
        file: file.to_owned(),
        what: what.into(),
        way_out: "merge takes tiles as luch renders them, of one part with scan lines".into(),
    };
    let [header] = headers else {
        return Err(unsupported("has several parts"));
    };
    if header.deep {
        return Err(unsupported("has several samples a pixel (deep)"));
    }
    if header.blocks != BlockDescription::ScanLines {
        return Err(unsupported("has blocks that are no scan lines"));
    }
    if header.line_order != LineOrder::Increasing {
        return Err(unsupported("has lines that do not go from the top down"));
    }
    let mut channels = header.channels.list.iter();
    if channels.any(|channel| channel.sampling != Vec2(1, 1)) {
        return Err(unsupported("has channels with fewer samples than pixels"));
    }
    check_bytes(file, header)?;
    window_of(header.data_window()).ok_or_else(|| unsupported("has a data window beyond reason"))
}

/// Finds whether the pixels of a file could ever be unpacked.
pub(super) fn check_bytes(file: &Path, header: &Header) -> Result<(), Error> {
    let Vec2(width, height) = header.layer_size;
    let pixels = (width as u64).saturating_mul(height as u64);
    let bytes = pixels.saturating_mul(header.channels.bytes_per_pixel as u64);
    if bytes <= MOST_BYTES {
        return Ok(());
    }
    let (found, most) = (bytes / 1_000_000, MOST_BYTES / 1_000_000);
    let problem = format!(
        "{width} x {height} pixels take {found} MB, more than the {most} MB allowed; render fewer layers or pixels"
    );
    Err(Error::malformed(file, "", problem))
}

/// A window of a file; `None` where its sides are no 32 bits.
pub(super) fn window_of(bounds: exr::meta::attribute::IntegerBounds) -> Option<Window> {
    Some(Window {
        left: bounds.position.x(),
        top: bounds.position.y(),
        width: u32::try_from(bounds.size.width()).ok()?,
        height: u32::try_from(bounds.size.height()).ok()?,
    })
}

/// What crate `exr` says of a file.
pub(super) fn said(file: &Path, place: &str) -> impl FnOnce(exr::error::Error) -> Error {
    let (file, place) = (file.to_owned(), place.to_owned());
    move |error| Error::Malformed {
        file,
        place,
        problem: "is not as in a whole EXR of luch; render the tile again".into(),
        source: Some(Box::new(error)),
    }
}
