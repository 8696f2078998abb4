//! Text of anyone's files within HTML and SVG.

/// `text` so that it means itself between tags and between quotes.
pub(in crate::study) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\n' | '\t' => out.push(c),
            // HTML and XML have no way to write these.
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_could_end_a_tag_a_quote_or_a_file_is_escaped() {
        assert_eq!(
            escape("<script>\"a\" & 'b'</script>\0\u{1b}"),
            "&lt;script&gt;&quot;a&quot; &amp; &#39;b&#39;&lt;/script&gt;\u{fffd}\u{fffd}"
        );
    }

    #[test]
    fn what_is_harmless_stays() {
        assert_eq!(escape("Kugel ○ 10 µs\n"), "Kugel ○ 10 µs\n");
    }
}
