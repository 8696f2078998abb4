//! Things of a file that a user asks for by name or by index: cameras, scenes, animations, variants of materials.

/// Which of the things called `names` is `wanted`: the first of that name or, if none has it and it is a number, the
/// one of that index.
///
/// # Errors
///
/// There is none: one line that says which there are.
pub(super) fn find(kind: &str, wanted: &str, names: &[&str]) -> Result<usize, String> {
    let by_name = names.iter().position(|name| *name == wanted);
    let by_index = || wanted.parse().ok().filter(|index| *index < names.len());
    by_name
        .or_else(by_index)
        .ok_or_else(|| no_such(kind, wanted, names))
}

/// One line that says which there are.
pub(super) fn no_such(kind: &str, wanted: &str, names: &[&str]) -> String {
    format!("there is no {kind} \"{wanted}\"; {}", there(names))
}

/// As in `there are 0 "front" and 1`.
fn there(names: &[&str]) -> String {
    const SHOWN: usize = 8;
    let called = |(index, name): (usize, &&str)| match *name {
        "" => index.to_string(),
        name => format!("{index} \"{}\"", shown(name)),
    };
    let shown: Vec<String> = names.iter().enumerate().take(SHOWN).map(called).collect();
    match shown.as_slice() {
        [] => "the file has none".into(),
        _ if names.len() > SHOWN => format!("there are {}, ...", shown.join(", ")),
        [only] => format!("there is {only}"),
        [first @ .., last] => format!("there are {} and {last}", first.join(", ")),
    }
}

/// A file's own word on one line, of bounded length.
fn shown(name: &str) -> String {
    let whole = name.chars().take(80);
    whole
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_goes_before_an_index() {
        let names = ["front", "", "0"];
        assert_eq!(find("camera", "0", &names), Ok(2));
        assert_eq!(find("camera", "1", &names), Ok(1));
        assert_eq!(find("camera", "front", &names), Ok(0));
    }

    #[test]
    fn what_is_not_there_is_told_what_is() {
        for (names, expected) in [
            (&[][..], "the file has none"),
            (&["front"], "there is 0 \"front\""),
            (
                &["front", "", "back"],
                "there are 0 \"front\", 1 and 2 \"back\"",
            ),
            (
                &["a"; 9],
                "there are 0 \"a\", 1 \"a\", 2 \"a\", 3 \"a\", 4 \"a\", 5 \"a\", 6 \"a\", 7 \"a\", ...",
            ),
        ] {
            assert_eq!(
                find("scene", "side", names),
                Err(format!("there is no scene \"side\"; {expected}"))
            );
        }
        assert!(find("scene", "1", &["front"]).is_err());
    }
}
