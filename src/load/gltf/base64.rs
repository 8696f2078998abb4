//! Base64 (RFC 4648, section 4), as data URIs have it in the wild: padding may lack, white space may stand anywhere,
//! and the URL alphabet (section 5) is read as well.

/// The bytes that `text` encodes.
///
/// # Errors
///
/// A byte is in neither alphabet, or the text ends within a byte.
pub(super) fn decode(text: &[u8]) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 3);
    // Bits that are read and not yet written, the newest lowest.
    let (mut bits, mut count) = (0u32, 0);
    let end = text
        .iter()
        .rposition(|&c| c != b'=' && !c.is_ascii_whitespace())
        .map_or(0, |last| last + 1);
    for (at, &character) in text[..end].iter().enumerate() {
        if character.is_ascii_whitespace() {
            continue;
        }
        let value = value(character)
            .ok_or_else(|| format!("byte {at} of its base64 is 0x{character:02x}"))?;
        bits = (bits << 6) | u32::from(value);
        count += 6;
        if count >= 8 {
            count -= 8;
            bytes.push((bits >> count) as u8);
        }
    }
    // Six bits are no byte; two or four are what padding stands for.
    if count == 6 {
        Err("its base64 is cut off".into())
    } else {
        Ok(bytes)
    }
}

fn value(character: u8) -> Option<u8> {
    match character {
        b'A'..=b'Z' => Some(character - b'A'),
        b'a'..=b'z' => Some(character - b'a' + 26),
        b'0'..=b'9' => Some(character - b'0' + 52),
        b'+' | b'-' => Some(62),
        b'/' | b'_' => Some(63),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::decode;

    #[test]
    fn the_vectors_of_rfc_4648_are_read() {
        for (plain, encoded) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(
                decode(encoded.as_bytes()),
                Ok(plain.as_bytes().to_vec()),
                "{encoded}"
            );
        }
    }

    #[test]
    fn padding_white_space_and_alphabet_may_differ() {
        assert_eq!(decode(b"Zm9v\nYg"), Ok(b"foob".to_vec()));
        assert_eq!(decode(b"-_+/"), decode(b"+/-_"));
    }

    #[test]
    fn what_is_no_base64_is_named() {
        assert_eq!(
            decode(b"Zm9!"),
            Err("byte 3 of its base64 is 0x21".to_owned())
        );
        assert_eq!(decode(b"Zm9vY"), Err("its base64 is cut off".to_owned()));
        assert_eq!(
            decode(b"Zm=v"),
            Err("byte 2 of its base64 is 0x3d".to_owned())
        );
    }
}
