//! What someone may have meant.

use super::source::quoted;

/// Longer words are compared by their beginning: the comparison takes the product of both lengths.
const LONGEST_WORD: usize = 64;
/// Two words this much alike (1 is the same word) are one, mistyped.
const ALIKE: f64 = 0.75;

/// `; did you mean "radius"?`, or the nearest word without a claim to be meant; empty where none is known.
pub(super) fn suggestion<'k>(found: &str, known: impl IntoIterator<Item = &'k str>) -> String {
    let found = comparable(found);
    let nearest = known
        .into_iter()
        .map(|word| (word, strsim::jaro_winkler(&found, &comparable(word))))
        // The first of equals, as `max_by` alone would not give.
        .reduce(|best, next| if next.1 > best.1 { next } else { best });
    match nearest {
        Some((word, likeness)) if likeness >= ALIKE => format!("; did you mean {}?", quoted(word)),
        Some((word, _)) => format!("; the nearest known is {}", quoted(word)),
        None => String::new(),
    }
}

fn comparable(word: &str) -> String {
    word.chars()
        .take(LONGEST_WORD)
        .flat_map(char::to_lowercase)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEYS: [&str; 6] = [
        "position",
        "look_at",
        "up",
        "fov_x",
        "fov_y",
        "model_camera",
    ];

    #[test]
    fn a_slip_of_the_pen_is_understood() {
        for (found, meant) in [
            ("postion", "position"),
            ("pos", "position"),
            ("lookat", "look_at"),
            ("Up", "up"),
            ("fov", "fov_x"),
            ("modelCamera", "model_camera"),
        ] {
            assert_eq!(
                suggestion(found, KEYS),
                format!("; did you mean \"{meant}\"?")
            );
        }
    }

    #[test]
    fn what_is_like_nothing_is_told_the_nearest_without_a_claim() {
        assert_eq!(
            suggestion("aperture", KEYS),
            "; the nearest known is \"up\""
        );
        assert_eq!(suggestion("aperture", []), "");
    }

    #[test]
    fn long_words_take_no_time() {
        let long = "x".repeat(1_000_000);
        assert!(suggestion(&long, [long.as_str()]).starts_with("; did you mean \"xxx"));
    }
}
