//! From a file's bytes to its JSON text and its binary chunk (glTF 2.0, section 4).

use super::Warnings;
use crate::Error;
use std::path::Path;

const MAGIC: &[u8; 4] = b"glTF";
const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BINARY: u32 = u32::from_le_bytes(*b"BIN\0");

/// The parts of a `.gltf` or `.glb` file.
#[derive(Debug)]
pub(super) struct Container<'a> {
    /// The document.
    pub(super) json: &'a [u8],
    /// The first buffer of a GLB.
    pub(super) binary: Option<&'a [u8]>,
}

/// Takes a file apart. Its first bytes say whether it is a GLB; a file called `.glb` must be one.
///
/// # Errors
///
/// The file is empty, no GLB where its name says so, of another version, or cut off.
pub(super) fn open<'a>(
    file: &Path,
    bytes: &'a [u8],
    warnings: &mut Warnings,
) -> Result<Container<'a>, Error> {
    if bytes.is_empty() {
        return Err(Error::malformed(file, "", "is empty, expected glTF"));
    }
    if bytes.starts_with(MAGIC) {
        return glb(file, bytes, warnings);
    }
    if file
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("glb"))
    {
        return Err(Error::malformed(
            file,
            "",
            "does not begin with \"glTF\", so that it is no GLB; if it is JSON, call it .gltf",
        ));
    }
    Ok(Container {
        json: bytes,
        binary: None,
    })
}

fn glb<'a>(file: &Path, bytes: &'a [u8], warnings: &mut Warnings) -> Result<Container<'a>, Error> {
    let wrong = |place: &str, problem: String| Error::malformed(file, place, problem);
    let [Some(version), Some(length)] = [4, 8].map(|at| word(bytes, at)) else {
        let problem = format!("is {} bytes long, expected at least 12", bytes.len());
        return Err(wrong("GLB header", problem));
    };
    if version != 2 {
        return Err(Error::Unsupported {
            file: file.to_owned(),
            what: format!("is GLB version {version}, expected 2"),
            way_out: "export it as glTF 2.0".into(),
        });
    }
    let end = length as usize;
    if end > bytes.len() {
        let problem = format!("is cut off: {} bytes of {length}", bytes.len());
        return Err(wrong("", problem));
    }
    if end < bytes.len() {
        let more = bytes.len() - end;
        warnings.add(format!("{more} bytes after the end of the GLB are ignored"));
    }
    let (mut json, mut binary) = (None, None);
    let mut at = 12;
    let mut number = 0;
    while at < end {
        let place = format!("chunk {number}");
        let [Some(size), Some(kind)] = [at, at + 4].map(|at| word(&bytes[..end], at)) else {
            let problem = format!("its header has {} bytes, expected 8", end - at);
            return Err(wrong(&place, problem));
        };
        let start = at + 8;
        let Some(chunk) = bytes[start..end].get(..size as usize) else {
            let problem = format!("says {size} bytes, {} are left", end - start);
            return Err(wrong(&place, problem));
        };
        match (number, kind) {
            (0, JSON) => json = Some(chunk),
            (0, _) => {
                return Err(wrong(
                    &place,
                    format!("is of type 0x{kind:08x}, expected JSON"),
                ));
            }
            (1, BINARY) => binary = Some(chunk),
            _ => warnings.add(format!("chunk {number} of type 0x{kind:08x} is ignored")),
        }
        at = start + chunk.len();
        number += 1;
    }
    let json = json.ok_or_else(|| wrong("", "has no JSON chunk".into()))?;
    Ok(Container { json, binary })
}

/// The little-endian word at `at`.
fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let word = bytes.get(at..)?.first_chunk()?;
    Some(u32::from_le_bytes(*word))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chunk(kind: &[u8; 4], bytes: &[u8]) -> Vec<u8> {
        [&(bytes.len() as u32).to_le_bytes(), &kind[..], bytes].concat()
    }

    fn glb_of(version: u32, chunks: &[Vec<u8>]) -> Vec<u8> {
        let body = chunks.concat();
        let length = (12 + body.len()) as u32;
        [
            &MAGIC[..],
            &version.to_le_bytes(),
            &length.to_le_bytes(),
            &body,
        ]
        .concat()
    }

    fn error(bytes: &[u8]) -> String {
        open(Path::new("a.glb"), bytes, &mut Warnings::default())
            .map_or_else(|e| e.to_string(), |_| "none".into())
    }

    #[test]
    fn a_glb_has_json_and_a_binary_chunk() {
        let bytes = glb_of(
            2,
            &[chunk(b"JSON", b"{}  "), chunk(b"BIN\0", &[1, 2, 3, 4])],
        );
        let mut warnings = Warnings::default();
        let parts = open(Path::new("a.glb"), &bytes, &mut warnings)
            .map(|c| (c.json.to_vec(), c.binary.map(<[u8]>::to_vec)));
        assert!(
            matches!(parts, Ok((json, Some(binary))) if json == b"{}  " && binary == [1, 2, 3, 4])
        );
        assert_eq!(warnings, Warnings::default());
    }

    #[test]
    fn bytes_and_chunks_beyond_the_format_are_warned_of() {
        let mut bytes = glb_of(2, &[chunk(b"JSON", b"{}  "), chunk(b"WXYZ", &[])]);
        bytes.push(0);
        let mut warnings = Warnings::default();
        assert!(open(Path::new("a.glb"), &bytes, &mut warnings).is_ok());
        let said: Vec<String> = warnings.iter().map(ToString::to_string).collect();
        assert_eq!(
            said,
            [
                "1 bytes after the end of the GLB are ignored",
                "chunk 1 of type 0x5a595857 is ignored"
            ]
        );
    }

    #[test]
    fn every_wrong_byte_has_its_own_words() {
        let whole = glb_of(2, &[chunk(b"JSON", b"{}  ")]);
        let mut long_chunk = whole.clone();
        long_chunk[12] = 9;
        let mut short_header = whole.clone();
        short_header.extend([0; 3]);
        short_header[8] += 3;
        for (bytes, expected) in [
            (vec![], "a.glb: is empty, expected glTF"),
            (
                b"{}".to_vec(),
                "a.glb: does not begin with \"glTF\", so that it is no GLB; if it is JSON, call it .gltf",
            ),
            (
                whole[..8].to_vec(),
                "a.glb: GLB header: is 8 bytes long, expected at least 12",
            ),
            (
                glb_of(1, &[]),
                "a.glb: is GLB version 1, expected 2; export it as glTF 2.0",
            ),
            (whole[..20].to_vec(), "a.glb: is cut off: 20 bytes of 24"),
            (long_chunk, "a.glb: chunk 0: says 9 bytes, 4 are left"),
            (
                short_header,
                "a.glb: chunk 1: its header has 3 bytes, expected 8",
            ),
            (
                glb_of(2, &[chunk(b"BIN\0", &[])]),
                "a.glb: chunk 0: is of type 0x004e4942, expected JSON",
            ),
            (glb_of(2, &[]), "a.glb: has no JSON chunk"),
        ] {
            assert_eq!(error(&bytes), expected);
        }
    }
}
