//! Tiles of a picture become the picture: the file that one run would have given.
//!
//! Numbers are copied as they are stored: a half stays the half that it was. Only blocks that are under way are
//! unpacked, so that memory follows the files, not what they claim to hold.

mod same;
mod tile;
mod whole;

use super::{attributes, finish, packed};
use crate::Error;
use crate::film::Window;
use exr::math::Vec2;
use exr::meta::attribute::AttributeValue;
use exr::meta::header::Header;
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use tile::Tile;

/// The bytes of the EXR that `files`, tiles of one picture, make together. Where there are `comments`, they stand before
/// those of the first tile; all else that a run for the whole picture would say is said.
///
/// # Errors
///
/// A file cannot be read, is no EXR as luch writes it or not a whole one; it is not of the same picture as the first, or of
/// another kind; two overlap; together they do not cover the picture, with the same margin on each side.
pub fn merge(files: &[PathBuf], comments: Option<&str>) -> Result<Vec<u8>, Error> {
    let tiles: Vec<Result<Tile, Error>> = files.par_iter().map(|file| Tile::read(file)).collect();
    let tiles: Vec<Tile> = tiles.into_iter().collect::<Result<_, _>>()?;
    let Some(first) = tiles.first() else {
        return Err(Error::malformed(
            Path::new("merge"),
            "",
            "no tiles, expected at least one",
        ));
    };
    for tile in &tiles[1..] {
        same::check(first, tile)?;
    }
    let window = whole::window_of(&tiles)?;
    let headers = [header(first, &tiles, window, comments)];
    tile::check_bytes(&first.file, &headers[0])?;

    let lines = headers[0].compression.scan_lines_per_block();
    let blocks = (window.height as usize).div_ceil(lines);
    let chunks: Vec<Result<Vec<u8>, Error>> = (0..blocks)
        .into_par_iter()
        .map(|number| {
            let data = unpacked(&tiles, &headers[0], window, number * lines)?;
            packed(&headers, number * lines, data).map_err(tile::said(&first.file, "when packed"))
        })
        .collect();
    let chunks: Vec<Vec<u8>> = chunks.into_iter().collect::<Result<_, _>>()?;
    let mut bytes = Vec::new();
    let written = finish(&headers, &chunks, &mut bytes);
    written.map_err(tile::said(&first.file, "its header"))?;
    Ok(bytes)
}

/// The first tile's header, for all pixels.
fn header(first: &Tile, tiles: &[Tile], window: Window, comments: Option<&str>) -> Header {
    let mut header = first.header().clone();
    for (name, value) in &mut header.own_attributes.other {
        if let AttributeValue::F64(sum) = value
            && same::is_counted(name.as_slice())
        {
            let of = |tile: &Tile| tile.header().own_attributes.other.get(name).cloned();
            let counts = tiles.iter().filter_map(of);
            *sum = counts.fold(0.0, |sum, count| match count {
                AttributeValue::F64(count) => sum + count,
                _ => sum,
            });
        }
    }
    header.layer_size = Vec2(window.width as usize, window.height as usize);
    if let Some(comments) = comments {
        let of_first = header.own_attributes.comments.as_ref();
        let of_first = of_first.map(|text| String::from_utf8_lossy(text.as_slice()).into_owned());
        let all = [Some(comments.to_owned()), of_first];
        let all: Vec<String> = all.into_iter().flatten().collect();
        header.own_attributes.comments = Some(attributes::text(&all.join("\n")));
    }
    let (compression, blocks, order) = (header.compression, header.blocks, header.line_order);
    header
        .with_position(Vec2(window.left, window.top))
        .with_encoding(compression, blocks, order)
}

/// The block that begins with row `start` of the window: line by line, channel by channel, as crate `exr` takes it.
fn unpacked(
    tiles: &[Tile],
    header: &Header,
    window: Window,
    start: usize,
) -> Result<Vec<u8>, Error> {
    let lines = header.compression.scan_lines_per_block();
    let height = lines.min(window.height as usize - start);
    let line = window.width as usize * header.channels.bytes_per_pixel;
    let mut data = vec![0; line * height];
    // Rows of the whole picture: no more than 31 bits, as is checked of every window.
    let rows = i64::from(window.top) + start as i64;
    let rows = rows..rows + height as i64;
    for tile in tiles {
        let of_tile = tile.window;
        let shared = rows.start.max(of_tile.top.into())..rows.end.min(of_tile.bottom());
        if shared.is_empty() {
            continue;
        }
        let across = of_tile.left.abs_diff(window.left) as usize;
        let mut block = None;
        for row in shared {
            let (number, within) = tile.block_of(row);
            if block.as_ref().is_none_or(|(known, _)| *known != number) {
                block = Some((number, tile.unpack(number)?));
            }
            let found = block.as_ref().map_or(&[][..], |(_, data)| data);
            let to = (row - rows.start) as usize * line;
            let length = of_tile.width as usize * header.channels.bytes_per_pixel;
            let from = found.get(within * length..(within + 1) * length);
            let into = data.get_mut(to..to + line);
            if let (Some(from), Some(into)) = (from, into) {
                put(from, into, across, header, [of_tile.width, window.width]);
            }
        }
    }
    Ok(data)
}

/// Puts a tile's line into one of the whole picture, so many pixels from its left.
fn put(from: &[u8], into: &mut [u8], across: usize, header: &Header, widths: [u32; 2]) {
    let [narrow, wide] = widths.map(|width| width as usize);
    let (mut source, mut target) = (0, 0);
    for channel in &header.channels.list {
        let bytes = channel.sample_type.bytes_per_sample();
        let start = target + across * bytes;
        let from = from.get(source..source + narrow * bytes);
        let into = into.get_mut(start..start + narrow * bytes);
        if let (Some(from), Some(into)) = (from, into) {
            into.copy_from_slice(from);
        }
        source += narrow * bytes;
        target += wide * bytes;
    }
}
