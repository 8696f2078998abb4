//! Ctrl-C, and the signals of those who run programs for others.

use super::Folder;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

#[test]
fn an_interrupt_ends_at_once_and_leaves_no_file() {
    ends_and_leaves_no_file("-INT", 130);
}

#[test]
fn a_termination_ends_at_once_and_leaves_no_file() {
    ends_and_leaves_no_file("-TERM", 143);
}

/// Sends a signal to a render that has begun.
#[track_caller]
fn ends_and_leaves_no_file(signal: &str, expected: i32) {
    let folder = Folder::with_scene_and_model();
    std::fs::write(folder.path("old.png"), "old").expect("writable");
    // Hours of work.
    let scene = ["render", "scene.toml", "--size", "999x999"];
    let more = ["--samples", "65536", "-o", "new.exr", "-o", "old.png"];
    let mut child = folder
        .command(&[&scene[..], &more].concat())
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .expect("the program runs");
    let mut line = String::new();
    let mut err = BufReader::new(child.stderr.take().expect("piped"));
    let read = err.read_line(&mut line);
    let while_it_ran = folder.names();
    let id = child.id().to_string();
    let signal = Command::new("kill").args([signal, &id]).status();
    if !signal.as_ref().is_ok_and(|status| status.success()) {
        // Else it would go on for hours.
        child.kill().expect("a running program");
    }
    let code = child.wait().expect("an end").code();

    assert!(read.is_ok() && signal.is_ok(), "{read:?} {signal:?}");
    assert_eq!(line, "Progress: 0%\n");
    let temporary = while_it_ran.iter().filter(|name| name.ends_with(".tmp"));
    assert_eq!(temporary.count(), 2, "{while_it_ran:?}");
    assert_eq!(code, Some(expected));
    assert_eq!(folder.names(), ["model.obj", "old.png", "scene.toml"]);
    assert_eq!(folder.read("old.png"), b"old");
}
