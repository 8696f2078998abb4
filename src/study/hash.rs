//! The hash that says which files a study is of.

use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::PathBuf;

/// SHA-256 of the files' bytes, one file after the other, in lower-case hex: what `cat FILES | sha256sum` says.
///
/// # Errors
///
/// The first file that cannot be read.
pub fn hash_of(paths: &[PathBuf]) -> io::Result<String> {
    let mut hasher = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    for path in paths {
        let mut file = File::open(path)?;
        loop {
            match file.read(&mut buffer) {
                Ok(0) => break,
                Ok(length) => hasher.update(buffer.get(..length).unwrap_or_default()),
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }
    let digest = hasher.finalize();
    Ok(digest.iter().map(|byte| format!("{byte:02x}")).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// FIPS 180-2, appendix B.1.
    const OF_ABC: &str = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

    fn hash_of_files(contents: &[&[u8]]) -> io::Result<String> {
        let folder = tempfile::tempdir()?;
        let mut paths = Vec::new();
        for (number, bytes) in contents.iter().enumerate() {
            let path = folder.path().join(number.to_string());
            fs::write(&path, bytes)?;
            paths.push(path);
        }
        hash_of(&paths)
    }

    #[test]
    fn abc_has_the_published_digest_in_one_file_or_two() -> io::Result<()> {
        assert_eq!(hash_of_files(&[b"abc"])?, OF_ABC);
        assert_eq!(hash_of_files(&[b"ab", b"", b"c"])?, OF_ABC);
        Ok(())
    }

    #[test]
    fn a_million_letters_have_the_published_digest() -> io::Result<()> {
        // FIPS 180-2, appendix B.3: many buffers, the last not full.
        let digest = hash_of_files(&[&[b'a'; 1_000_000]])?;
        let expected = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";
        assert_eq!(digest, expected);
        Ok(())
    }

    #[test]
    fn a_file_that_is_not_there_is_an_error() {
        let missing = PathBuf::from("no such folder/no such file");
        assert!(hash_of(&[missing]).is_err());
    }
}
