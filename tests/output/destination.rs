//! Files that appear whole or not at all.

use super::{encoded, film};
use luch::output::{Destination, Format, Options};
use luch::scene::Shown;
use std::fs;
use std::path::Path;

/// The names of what lies in a folder.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_file_appears_whole_and_alone() {
    let folder = tempfile::tempdir().unwrap();
    let film = film(1, Shown::Always, &[[1.0; 4]]);
    let long = format!("{}.png", "наклон и очень длинное имя".repeat(5));
    for name in ["a.png", &long] {
        let path = folder.path().join(name);
        Destination::claim(&path)
            .unwrap()
            .write(&film, &Options::default())
            .unwrap();
        assert_eq!(
            fs::read(&path).unwrap(),
            encoded(&film, Format::Png, &Options::default())
        );
        fs::remove_file(path).unwrap();
        assert!(names(folder.path()).is_empty());
    }
}

#[test]
fn an_old_file_stays_until_the_new_one_is_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    fs::write(&path, "old").unwrap();
    let destination = Destination::claim(&path).unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(destination.path(), path);
    assert_eq!(destination.format(), Format::Exr);
    let film = film(1, Shown::Always, &[[1.0; 4]]);
    destination.write(&film, &Options::default()).unwrap();
    let expected = encoded(&film, Format::Exr, &Options::default());
    assert_eq!(fs::read(&path).unwrap(), expected);
    assert_eq!(names(folder.path()), ["a.exr"]);
}

#[test]
fn a_failed_write_leaves_the_old_file_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    fs::write(&path, "old").unwrap();
    let mut film = film(1, Shown::Always, &[[1.0; 4]]);
    film.layers[0].values.pop();
    let destination = Destination::claim(&path).unwrap();
    let error = destination.write(&film, &Options::default()).unwrap_err();
    assert!(error.to_string().contains("3 values"), "{error}");
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(names(folder.path()), ["a.png"]);
}

#[test]
fn a_destination_that_is_dropped_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let destination = Destination::claim(&folder.path().join("a.png")).unwrap();
    let temporary = destination.temporary_path().to_owned();
    let [name] = &names(folder.path())[..] else {
        panic!("only the temporary file lies there")
    };
    assert!(
        name.starts_with(".a.png.") && name.ends_with(".tmp"),
        "{name}"
    );
    assert!(temporary.is_absolute() && temporary.ends_with(name));
    drop(destination);
    assert!(names(folder.path()).is_empty());
}

#[test]
fn an_unwritable_path_is_found_before_there_is_a_picture() {
    let folder = tempfile::tempdir().unwrap();
    let inside = |name: &str| folder.path().join(name);
    fs::create_dir(inside("folder.png")).unwrap();
    fs::write(inside("file"), "").unwrap();
    for (path, expected) in [
        (inside("folder.png"), "is a folder"),
        (inside("missing/a.png"), "cannot write into its folder"),
        (inside("file/a.png"), "cannot open"),
        (inside("a.txt"), "does not end in"),
    ] {
        let error = Destination::claim(&path).unwrap_err().to_string();
        assert!(error.starts_with(path.to_str().unwrap()), "{error}");
        assert!(error.contains(expected), "{error}");
    }
    assert_eq!(names(folder.path()), ["file", "folder.png"]);
}

#[test]
fn a_write_protected_file_is_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    fs::write(&path, "old").unwrap();
    let mut permissions = fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).unwrap();
    let error = Destination::claim(&path).unwrap_err();
    assert!(error.to_string().contains("is write-protected"), "{error}");
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};

    fn write(path: &Path) {
        let film = film(1, Shown::Always, &[[1.0; 4]]);
        let destination = Destination::claim(path).unwrap();
        destination.write(&film, &Options::default()).unwrap();
    }

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o777
    }

    #[test]
    fn what_a_link_leads_to_is_replaced_and_the_link_stays() {
        let folder = tempfile::tempdir().unwrap();
        let inside = |name: &str| folder.path().join(name);
        fs::create_dir(inside("frames")).unwrap();
        fs::write(inside("frames/7.png"), "old").unwrap();
        symlink("frames/7.png", inside("last.png")).unwrap();
        symlink("frames/8.png", inside("next.png")).unwrap();
        for (link, file) in [("last.png", "frames/7.png"), ("next.png", "frames/8.png")] {
            write(&inside(link));
            assert_eq!(fs::read_link(inside(link)).unwrap(), Path::new(file));
            assert!(fs::read(inside(file)).unwrap().starts_with(b"\x89PNG"));
        }
        assert_eq!(names(&inside("frames")), ["7.png", "8.png"]);
        assert_eq!(names(folder.path()), ["frames", "last.png", "next.png"]);
    }

    #[test]
    fn a_link_to_itself_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        symlink("a.png", &path).unwrap();
        let error = Destination::claim(&path).unwrap_err();
        assert!(error.to_string().contains("too many links"), "{error}");
    }

    #[test]
    fn a_device_is_no_destination() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("null.png");
        symlink("/dev/null", &path).unwrap();
        let error = Destination::claim(&path).unwrap_err();
        assert!(error.to_string().contains("is a device"), "{error}");
    }

    #[test]
    fn a_new_file_has_ordinary_permissions_and_a_replaced_one_its_own() {
        let folder = tempfile::tempdir().unwrap();
        let ordinary = folder.path().join("ordinary");
        fs::write(&ordinary, "").unwrap();
        let path = folder.path().join("a.png");
        write(&path);
        assert_eq!(mode(&path), mode(&ordinary));
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        write(&path);
        assert_eq!(mode(&path), 0o640);
    }
}
