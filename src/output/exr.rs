//! EXR: every layer in linear light, for compositing.
//!
//! One part, scan lines from the top, ZIPS: what every reader shows. The parts of crate `exr` are put together here: its
//! writer stores custom attributes in the order of a hash map, another one each run, and compresses on threads of its
//! own.

mod attributes;
mod camera;
mod facts;
mod mattes;
mod merge;
mod moment;
mod samples;
mod whole;

pub(super) use whole::is_whole;

pub use merge::merge;

use super::Options;
use super::rows::map_rows;
use crate::film::{Film, Precision};
use exr::block::{BlockIndex, UncompressedBlock};
use exr::error::Result;
use exr::math::Vec2;
use exr::meta::attribute::{self, AttributeValue, ChannelDescription, LineOrder, SampleType, Text};
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData, magic_number, sequence_end};
use exr::prelude::Compression;
use std::io::{self, Write};

/// Writes every layer of `film`.
pub(super) fn write(film: &Film, options: &Options, out: &mut dyn Write) -> io::Result<()> {
    write_parts(film, options, out).map_err(|error| match error {
        exr::error::Error::Io(error) => error,
        other => io::Error::other(other),
    })
}

fn write_parts(film: &Film, options: &Options, out: &mut dyn Write) -> Result<()> {
    let channels = channels_of(film);
    let headers = [header(film, &channels, options)];
    let chunks = map_rows(film, |y| {
        packed(&headers, y, samples::line(film, &channels, y))
    });
    let chunks: Vec<Vec<u8>> = chunks.into_iter().collect::<Result<_>>()?;
    finish(&headers, &chunks, out)
}

/// Writes a whole file, whose blocks are ready.
fn finish(headers: &[Header; 1], chunks: &[Vec<u8>], out: &mut dyn Write) -> Result<()> {
    let head = head(headers)?;
    out.write_all(&head)?;
    let mut offset = (head.len() + chunks.len() * size_of::<u64>()) as u64;
    for chunk in chunks {
        out.write_all(&offset.to_le_bytes())?;
        offset += chunk.len() as u64;
    }
    for chunk in chunks {
        out.write_all(chunk)?;
    }
    out.flush()?;
    Ok(())
}

/// A channel of the file and where the film keeps it.
struct Channel {
    name: String,
    precision: Precision,
    /// An index into the film's layers.
    layer: usize,
    /// An index into the layer's channels.
    component: usize,
}

/// Every channel, in the order of the format: by name.
fn channels_of(film: &Film) -> Vec<Channel> {
    let mut channels = Vec::new();
    for (layer, of) in film.layers.iter().enumerate() {
        for (component, channel) in of.channels.iter().enumerate() {
            let name = match &*of.name {
                "" => (*channel).to_owned(),
                layer => format!("{layer}.{channel}"),
            };
            channels.push(Channel {
                name,
                precision: of.precision,
                layer,
                component,
            });
        }
    }
    channels.sort_by(|a, b| a.name.cmp(&b.name));
    channels
}

fn header(film: &Film, channels: &[Channel], options: &Options) -> Header {
    let size = Vec2(film.width as usize, film.height as usize);
    let display = Vec2(film.display_width as usize, film.display_height as usize);
    let described = channels.iter().map(|channel| {
        let sample_type = match channel.precision {
            Precision::Half => SampleType::F16,
            Precision::Float => SampleType::F32,
        };
        ChannelDescription::named(attributes::text(&channel.name), sample_type)
    });
    let mut own = attributes::own(film, display, options);
    for (name, value) in film.manifests.iter().flat_map(mattes::attributes) {
        let value = AttributeValue::Text(attributes::text(&value));
        own.other.insert(attributes::text(&name), value);
    }
    Header::new(Text::default(), size, described.collect())
        .with_encoding(
            Compression::ZIP1,
            BlockDescription::ScanLines,
            LineOrder::Increasing,
        )
        .with_shared_attributes(attributes::shared(display, options))
        .with_attributes(own)
        .with_position(Vec2(film.left, film.top))
}

/// All that stands before the table of offsets.
fn head(headers: &[Header; 1]) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let requirements = MetaData::validate(headers, true)?;
    magic_number::write(&mut bytes)?;
    requirements.write(&mut bytes)?;
    for header in headers {
        let mut attributes: Vec<_> = header.all_named_attributes().collect();
        attributes.sort_by_key(|(name, _)| *name);
        for (name, value) in &attributes {
            attribute::write(name, value, &mut bytes)?;
        }
        sequence_end::write(&mut bytes)?;
    }
    Ok(bytes)
}

/// The block that begins with row `y` of the data window, compressed; `data` is its lines, one after another, each channel
/// after channel.
fn packed(headers: &[Header; 1], y: usize, data: Vec<u8>) -> Result<Vec<u8>> {
    let [header] = headers;
    let (size, lines) = (header.layer_size, header.compression.scan_lines_per_block());
    let block = UncompressedBlock {
        index: BlockIndex {
            layer: 0,
            pixel_position: Vec2(0, y),
            pixel_size: Vec2(size.width(), lines.min(size.height() - y)),
            level: Vec2(0, 0),
        },
        data,
    };
    let mut bytes = Vec::new();
    block
        .compress_to_chunk(headers)?
        .write(&mut bytes, headers.len())?;
    // All rows wait in memory for the table that stands before them.
    bytes.shrink_to_fit();
    Ok(bytes)
}
