//! Where a picture goes: claimed before it is made, replaced when it is whole.

use super::{Format, Options, encode};
use crate::Error;
use crate::film::Film;
use std::fs::{self, Permissions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// A path that a picture can be written to, known before there is one.
///
/// The picture grows in a temporary file beside the path, `.name.png.XXXXXX.tmp`, and takes its place when it is whole;
/// until then, what was there stays. Dropping a destination removes the temporary file.
#[derive(Debug)]
pub struct Destination {
    /// As given.
    path: PathBuf,
    /// What is replaced: where the path is a link, the file it leads to.
    target: PathBuf,
    format: Format,
    /// Of the file that is replaced.
    permissions: Option<Permissions>,
    temporary: NamedTempFile,
}

impl Destination {
    /// Makes sure that a picture can be written to `path`, and of which format it is.
    ///
    /// # Errors
    ///
    /// The name ends in no known format; the path is a folder, a device or a pipe, or write-protected; its folder does
    /// not exist or lets no file be made in it.
    pub fn claim(path: &Path) -> Result<Destination, Error> {
        let target = behind_links(path).map_err(Error::io(path, "follow"))?;
        let permissions = replaceable(path, &target)?;
        let format = Format::of(path)?;
        let folder = match target.parent() {
            Some(folder) if folder != "" => folder,
            _ => Path::new("."),
        };
        let temporary = fs::metadata(folder)
            .and_then(|_| temporary_file(folder, &target))
            .map_err(Error::io(path, "write into its folder"))?;
        Ok(Destination {
            path: path.to_owned(),
            target,
            format,
            permissions,
            temporary,
        })
    }

    /// The path as it was given.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Which kind of file it becomes.
    pub fn format(&self) -> Format {
        self.format
    }

    /// What to remove where the program ends without dropping this, as on a signal.
    pub fn temporary_path(&self) -> &Path {
        self.temporary.path()
    }

    /// Writes `film`, all of it or nothing.
    ///
    /// # Errors
    ///
    /// The system refuses, as on a full disk, or the film is no picture (see [`encode`]). What was there before is
    /// there still.
    pub fn write(mut self, film: &Film, options: &Options) -> Result<(), Error> {
        let mut out = BufWriter::new(self.temporary.as_file_mut());
        encode(film, self.format, options, &self.path, &mut out)?;
        out.flush().map_err(Error::io(&self.path, "write"))?;
        drop(out);
        let path = self.path.clone();
        self.put_in_place().map_err(Error::io(&path, "write"))
    }

    /// Writes a file's bytes, all of them or nothing: those of a picture that is no film.
    ///
    /// # Errors
    ///
    /// The system refuses. What was there before is there still.
    pub fn write_bytes(mut self, bytes: &[u8]) -> Result<(), Error> {
        let path = self.path.clone();
        let written = self.temporary.write_all(bytes);
        written
            .and_then(|()| self.put_in_place())
            .map_err(Error::io(&path, "write"))
    }

    fn put_in_place(self) -> io::Result<()> {
        let file = self.temporary.as_file();
        if let Some(permissions) = self.permissions {
            file.set_permissions(permissions)?;
        }
        // Else a crash of the machine could leave the name with nothing behind it.
        file.sync_all()?;
        self.temporary.persist(&self.target)?;
        Ok(())
    }
}

/// More links in a row than Linux follows.
const MAX_LINKS: usize = 40;

/// The path itself, or what it leads to where it is a link, whether or not there is something.
fn behind_links(path: &Path) -> io::Result<PathBuf> {
    let mut target = path.to_owned();
    for _ in 0..MAX_LINKS {
        match fs::read_link(&target) {
            // Relative to the folder of the link; an absolute one replaces it.
            Ok(next) => target = target.with_file_name("").join(next),
            Err(_) => return Ok(target),
        }
    }
    Err(io::Error::other("too many links, one behind the other"))
}

/// The permissions of the file at `target`, `None` where there is none; an error where it cannot be replaced.
fn replaceable(path: &Path, target: &Path) -> Result<Option<Permissions>, Error> {
    let metadata = match fs::metadata(target) {
        Ok(metadata) => metadata,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(Error::io(path, "open")(error)),
    };
    let problem = if metadata.is_dir() {
        "is a folder, expected a file"
    } else if !metadata.is_file() {
        "is a device or a pipe, expected a file"
    } else if metadata.permissions().readonly() {
        "is write-protected, expected a file that may be replaced"
    } else {
        return Ok(Some(metadata.permissions()));
    };
    Err(Error::malformed(path, "", problem))
}

/// A file of our own in `folder`, whose name starts like `target`'s, and which others may read as any other file.
fn temporary_file(folder: &Path, target: &Path) -> io::Result<NamedTempFile> {
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    // Names have room for 255 bytes, and a character takes up to four.
    let start: String = name.chars().take(50).collect();
    let prefix = format!(".{start}.");
    let mut builder = Builder::new();
    builder.prefix(&prefix).suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // The system takes away what the umask says.
        builder.permissions(Permissions::from_mode(0o666));
    }
    // Its error names the temporary file, of which nobody has heard.
    let refused = |error: io::Error| io::Error::from(error.kind());
    builder.tempfile_in(folder).map_err(refused)
}
