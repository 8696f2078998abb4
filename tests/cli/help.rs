//! Help, version and completions.

use super::Folder;

#[test]
fn help_names_every_option_and_has_examples() {
    let folder = Folder::new(&[]);
    let render = folder.luch_succeeds(&["render", "--help"]);
    for option in [
        "-o, --output",
        "--format",
        "--size",
        "--width",
        "--height",
        "--crop",
        "--tile",
        "--overscan",
        "--samples",
        "--pattern",
        "--filter",
        "--adaptive",
        "--no-adaptive",
        "--max-depth",
        "--shading",
        "--texture-filter",
        "--list-cameras",
        "--camera",
        "--eye",
        "--target",
        "--fov",
        "--view",
        "--orbit",
        "--zoom",
        "--threads",
        "--display",
        "--exposure",
        "--layers",
        "--bit-depth",
        "--owner",
        "--timestamp",
        "--background",
        "--bvh",
        "--bvh-builder",
        "--small-memory",
        "--leaf-size",
        "--allow-external",
        "--max-memory",
        "-v, --verbose",
        "-q, --quiet",
        "--json",
        "--frames",
        "--fps",
        "--turntable",
        "--skip-existing",
        "--progress",
        "--scene",
        "--variant",
        "--allow",
    ] {
        assert!(
            render.out().contains(&format!("{option} "))
                || render.out().contains(&format!("{option}\n")),
            "{option}"
        );
    }
    for arguments in [
        &["--help"][..],
        &["help"],
        &["-h"],
        &["render", "-h"],
        &["help", "render"],
        &["info", "--help"],
        &["help", "info"],
        &["completions", "--help"],
    ] {
        let ran = folder.luch_succeeds(arguments);
        assert!(
            ran.out().contains("\nExample"),
            "{arguments:?}: {}",
            ran.out()
        );
        assert!(ran.out().contains("Usage: luch"), "{arguments:?}");
        assert_eq!(ran.err, "", "{arguments:?}");
    }
    let top = folder.luch_succeeds(&["--help"]);
    for command in ["render", "info", "completions", "help"] {
        assert!(top.out().contains(&format!("\n  {command} ")), "{command}");
    }
}

#[test]
fn every_example_of_the_help_is_one_that_the_program_understands() {
    let folder = Folder::new(&[]);
    for arguments in [&["--help"][..], &["render", "--help"], &["info", "--help"]] {
        let help = folder.luch_succeeds(arguments);
        let examples = help
            .out()
            .lines()
            .filter_map(|line| line.strip_prefix("  luch "));
        for example in examples.clone() {
            // Remarks stand two blanks apart; what follows a pipe is another program's.
            let command = example.split("  ").next().unwrap_or_default();
            let command = command.split(['|', '>']).next().unwrap_or_default();
            let command = command.replace("\"Front door\"", "front");
            // A folder that is not there ends it before anything is rendered, if the rest is understood.
            let mut words: Vec<&str> = command.split_whitespace().collect();
            if words.first() == Some(&"render") {
                let is_sequence = words
                    .iter()
                    .any(|word| ["--frames", "--turntable"].contains(word));
                words.extend([
                    "-o",
                    if is_sequence {
                        "nowhere/a.#.png"
                    } else {
                        "nowhere/a.png"
                    },
                ]);
                words.retain(|word| *word != "--json");
            }
            let ran = folder.luch(&words);
            let is_understood =
                ran.err.contains("cannot write into its folder") || ran.err.contains("cannot open");
            assert!(is_understood, "{words:?}: {}", ran.err);
        }
        assert!(examples.count() > 0, "{arguments:?}");
    }
}

#[test]
fn the_version_is_the_packages() {
    let ran = Folder::new(&[]).luch_succeeds(&["--version"]);
    assert_eq!(ran.out(), format!("luch {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn completions_know_the_options() {
    let folder = Folder::new(&[]);
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let ran = folder.luch_succeeds(&["completions", shell]);
        for word in ["exposure", "pbr-neutral", "info"] {
            assert!(ran.out().contains(word), "{shell}: {word}");
        }
    }
}
