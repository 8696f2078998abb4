//! Tells the crate which commit and which compiler it is made of, for reports.

use std::env;
use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;

/// What decides what the program does.
const SOURCES: [&str; 4] = ["src", "build.rs", "Cargo.toml", "Cargo.lock"];

fn main() {
    // Without the sources, a `-dirty` would outlive its change, or come too late. They have the crate compiled again
    // in any case.
    SOURCES.into_iter().for_each(run_again_for);
    println!("cargo:rerun-if-env-changed=RUSTC");
    let unknown = || "unknown".to_owned();
    println!(
        "cargo:rustc-env=LUCH_COMMIT={}",
        commit().unwrap_or_else(unknown)
    );
    println!(
        "cargo:rustc-env=LUCH_RUSTC={}",
        compiler().unwrap_or_else(unknown)
    );
}

/// Cargo would run this for ever because of a path that is not there.
fn run_again_for(path: &str) {
    if Path::new(path).exists() {
        println!("cargo:rerun-if-changed={path}");
    }
}

/// The commit that is checked out, `-dirty` where the sources differ from it.
fn commit() -> Option<String> {
    // Not the commit of another repository that this folder happens to lie in, as a registry's or a vendored copy does.
    if !git(&["rev-parse", "--show-prefix"])?.is_empty() {
        return None;
    }
    let commit = git(&["rev-parse", "--short=10", "HEAD"])?;
    // A branch moves in its own file, or in the packed one; the log of HEAD tells of either.
    let branch = git(&["symbolic-ref", "--quiet", "HEAD"]);
    let moved = ["HEAD", "logs/HEAD", "packed-refs"];
    for name in moved.into_iter().chain(branch.as_deref()) {
        // In a worktree, these are not below `.git`.
        if let Some(path) = git(&["rev-parse", "--git-path", name]) {
            run_again_for(&path);
        }
    }
    // Without optional locks: else it would write the index anew.
    let mut question = vec!["--no-optional-locks", "status", "--porcelain", "--"];
    question.extend(SOURCES);
    let changes = git(&question)?;
    Some(if changes.is_empty() {
        commit
    } else {
        commit + "-dirty"
    })
}

fn compiler() -> Option<String> {
    answer(&env::var_os("RUSTC")?, &["--version"])
}

fn git(arguments: &[&str]) -> Option<String> {
    answer(OsStr::new("git"), arguments)
}

/// What a program prints, without the end of its line; `None` where there is no such program or it fails.
fn answer(program: &OsStr, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}
