//! Files that are no TOML, or no text at all.

use super::error;
use luch::load::{Options, scene_file::open};
use std::fs;
use std::path::Path;

#[test]
fn bad_toml_is_one_line_with_line_and_column() {
    for (text, message) in [
        ("[camera", "line 1, column 8: unclosed table, expected `]`"),
        (
            "[camera]\nposition 1",
            "line 2, column 10: key with no value, expected `=`",
        ),
        ("a = 1\na = 2", "line 2, column 1: duplicate key"),
        ("[camera]\r\n[camera]", "line 2, column 2: duplicate key"),
        (
            "# ü\n\"ü\" = \"x",
            "line 2, column 9: invalid basic string, expected `\"`",
        ),
    ] {
        assert_eq!(error(text), format!("scene.toml: {message}"));
    }
}

#[test]
fn deep_nesting_is_one_error() {
    let dots = vec!["a"; 100_000].join(".");
    let inline = format!("{} = {{", vec!["a"; 79].join(".")).repeat(10_000);
    let header = format!(
        "[{}]\n{}",
        vec!["a"; 79].join("."),
        vec!["b = {"; 10_000].join("")
    );
    for text in [
        format!("{dots} = 1"),
        format!("[{dots}]"),
        "a = [".to_owned() + &"[".repeat(100_000),
        inline,
        header,
    ] {
        let error = error(&text);
        assert!(
            error.starts_with("scene.toml: ") && error.lines().count() == 1,
            "{error}"
        );
        assert!(error.len() < 200, "{error}");
    }
}

#[test]
fn the_deepest_nesting_that_is_toml_is_one_error() {
    // 79 tables in each of as many inline tables as may stand in one another: the deepest a document can be.
    let key = vec!["a"; 79].join(".");
    for inline_tables in [10, 60, 78, 79, 80] {
        let text = format!(
            "{}1{}",
            format!("{{ {key} = ").repeat(inline_tables),
            "}".repeat(inline_tables)
        );
        let error = error(&format!("[{key}]\n{key} = {text}"));
        assert!(
            error.starts_with("scene.toml: ") && error.lines().count() == 1,
            "{error}"
        );
    }
}

#[test]
fn the_file_itself_can_be_wrong() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("scene.toml");
    let shown = file.display();
    let message = |path: &Path| {
        open(path, &Options::default())
            .err()
            .map(|error| error.to_string())
            .unwrap_or_default()
    };
    assert!(message(&file).starts_with(&format!("{shown}: cannot open: ")));
    assert_eq!(
        message(folder.path()),
        format!("{}: is a folder, expected a file", folder.path().display())
    );
    fs::write(&file, b"# fine\n# \xff\xfe").expect("writable");
    assert_eq!(
        message(&file),
        format!("{shown}: line 2: byte 0xff is not UTF-8; save the file as UTF-8")
    );
}
