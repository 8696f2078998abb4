//! What a text comes to once it is read, in bytes, at most: found from single bytes of it, before any is read as what it
//! means. Each figure was found with the smallest texts that take the most (November 2026).

/// Of the JSON of a glTF file: the typed document has a kilobyte and more for an object such as a material, values that
/// luch does not know have 32 bytes each, twice over and in lists that double, texts are copied and those of data URIs
/// decoded.
pub(super) fn of_json(text: &[u8]) -> u64 {
    let each = text.iter().map(|byte| match byte {
        b'{' => 1280,
        b',' | b'[' => 192,
        _ => 0,
    });
    each.sum::<u64>() + 3 * text.len() as u64
}

/// Of a scene file: a table has a node of a tree for itself, be it named by a header, a brace or a dot in a key.
pub(super) fn of_toml(text: &[u8]) -> u64 {
    let each = text.iter().map(|byte| match byte {
        b'[' | b'{' | b'.' | b'=' => 1280,
        b',' | b'\n' => 192,
        _ => 0,
    });
    each.sum::<u64>() + 3 * text.len() as u64
}

/// Of an OBJ: corners become vertices of up to four lists, which double, and the triangles between them; each object,
/// group and material can have meshes and nodes of its own.
pub(super) fn of_obj(text: &[u8]) -> u64 {
    let is_blank = |byte: &u8| byte.is_ascii_whitespace();
    let blanks = text.iter().filter(|byte| is_blank(byte)).count() as u64;
    let starts = text.windows(2);
    let starts = starts.filter(|pair| is_blank(&pair[0]) && matches!(pair[1], b'o' | b'g' | b'u'));
    blanks * 80 + starts.count() as u64 * 2048 + 2 * text.len() as u64
}

/// Of an MTL: a material has a kilobyte.
pub(super) fn of_mtl(text: &[u8]) -> u64 {
    128 * text.len() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_multiplies_counts_most() {
        assert_eq!(of_json(b"{\"a\":[0,0]}"), 1280 + 2 * 192 + 3 * 11);
        assert_eq!(of_toml(b"[a.b]\n"), 2 * 1280 + 192 + 3 * 6);
        assert_eq!(of_obj(b"g a\nf 1 2 3\ng b"), 6 * 80 + 80 + 2048 + 2 * 15);
        assert_eq!(of_mtl(b"newmtl a"), 1024);
    }
}
