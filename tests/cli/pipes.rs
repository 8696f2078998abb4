//! Pipes that somebody closed: no panic, and no complaint where the reader has read enough.

use super::Folder;
use std::io::{BufRead, BufReader, Read};
use std::process::Stdio;

/// The end of a run whose standard output nobody reads.
fn with_closed_output(folder: &Folder, arguments: &[&str]) -> (Option<i32>, String) {
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    let output = folder
        .command(arguments)
        .stdout(writer)
        .output()
        .expect("the program runs");
    (
        output.status.code(),
        String::from_utf8_lossy(&output.stderr).into_owned(),
    )
}

#[test]
fn nobody_reading_is_no_error() {
    let folder = Folder::with_scene_and_model();
    for arguments in [
        &["info", "model.obj"][..],
        &["info", "model.obj", "--json"],
        &["--help"],
        &["render", "--help"],
        &["--version"],
        &["completions", "bash"],
        &["render", "scene.toml", "-o", "-"],
        &["render", "scene.toml", "-o", "a.png"],
        &["render", "scene.toml", "-o", "a.png", "--json"],
    ] {
        let (code, err) = with_closed_output(&folder, arguments);
        assert_eq!(code, Some(0), "{arguments:?}: {err}");
        assert!(
            !err.contains("error") && !err.contains("panic"),
            "{arguments:?}: {err}"
        );
    }
    assert!(folder.read("a.png").starts_with(super::PNG));
}

#[test]
fn nobody_listening_to_complaints_changes_no_exit_code() {
    let folder = Folder::with_scene_and_model();
    for (arguments, code) in [
        (&["info", "lost.obj"][..], 1),
        (&["render", "--frob"], 1),
        (&["render", "-o", "nowhere/a.png"], 2),
        (&["render", "model.obj", "--size", "8x8"], 0),
    ] {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let status = folder
            .command(arguments)
            .stdout(Stdio::null())
            .stderr(writer)
            .status()
            .expect("the program runs");
        assert_eq!(status.code(), Some(code), "{arguments:?}");
    }
}

#[test]
fn a_reader_who_leaves_early_is_no_error() {
    let folder = Folder::new(&[]);
    let mut child = folder
        .command(&["completions", "bash"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs");
    let mut first = String::new();
    let mut reader = BufReader::with_capacity(16, child.stdout.take().expect("piped"));
    reader.read_line(&mut first).expect("a line");
    drop(reader);
    let mut err = String::new();
    child
        .stderr
        .take()
        .expect("piped")
        .read_to_string(&mut err)
        .expect("UTF-8");
    assert_eq!(child.wait().expect("an end").code(), Some(0), "{err}");
    assert_eq!(err, "");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_behind_standard_output_is_exit_code_2() {
    let folder = Folder::with_scene_and_model();
    for arguments in [
        &["info", "model.obj"][..],
        &["render", "scene.toml", "-q", "-o", "-"],
        &["--help"],
    ] {
        let full = std::fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .expect("a device");
        let output = folder
            .command(arguments)
            .stdout(full)
            .output()
            .expect("the program runs");
        let expected =
            "error: standard output: cannot write: No space left on device (os error 28)\n";
        assert_eq!(
            String::from_utf8_lossy(&output.stderr),
            expected,
            "{arguments:?}"
        );
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
}
