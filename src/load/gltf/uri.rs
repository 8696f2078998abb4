//! What a URI in a glTF file names: bytes of its own, or a file in the model's folder (glTF 2.0, section 2.8).

use super::base64;
use super::document::Document;
use crate::load::{Options, files};
use std::path::{Path, PathBuf};

/// What a URI names.
#[derive(Debug, PartialEq)]
pub(super) enum Uri {
    /// The bytes of a `data:` URI.
    Data(Vec<u8>),
    /// Where the file lies.
    File(PathBuf),
}

/// Reads a URI of a document.
///
/// # Errors
///
/// It leads to the network; or out of the model's folder, and the document's options do not allow that. Or its data
/// are no base64.
pub(super) fn resolve(uri: &str, document: &Document) -> Result<Uri, String> {
    resolve_from(uri, &document.file, &document.options)
}

fn resolve_from(uri: &str, model: &Path, options: &Options) -> Result<Uri, String> {
    let path = match scheme(uri) {
        Some(scheme) if scheme.eq_ignore_ascii_case("data") => {
            return data(&uri[scheme.len() + 1..]).map(Uri::Data);
        }
        Some(scheme) if options.allow_external && scheme.eq_ignore_ascii_case("file") => {
            // `file:///a`, with nothing or "localhost" for a machine (RFC 8089), or `file:/a`.
            let path = &uri[scheme.len() + 1..];
            let path = path.strip_prefix("//localhost").unwrap_or(path);
            file(path.strip_prefix("//").unwrap_or(path))?
        }
        Some(scheme) => {
            let way_out = if scheme.eq_ignore_ascii_case("file") {
                "; move the file beside the model, or use --allow-external"
            } else {
                ""
            };
            return Err(format!(
                "its URI begins with \"{scheme}:\", expected a file in the model's folder or data{way_out}"
            ));
        }
        None => file(uri)?,
    };
    match files::named_by(model, &path, options) {
        Ok(path) => Ok(Uri::File(path)),
        Err(problem) => Err(format!("its URI {problem}")),
    }
}

/// What stands before the first colon, if it can be a scheme (RFC 3986, section 3.1). A drive letter is one, too.
fn scheme(uri: &str) -> Option<&str> {
    let (scheme, _) = uri.split_once(':')?;
    let fits = scheme.starts_with(|c: char| c.is_ascii_alphabetic())
        && scheme
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c));
    fits.then_some(scheme)
}

/// The bytes of `[media type][;base64],payload` (RFC 2397).
fn data(rest: &str) -> Result<Vec<u8>, String> {
    let (kind, payload) = rest
        .split_once(',')
        .ok_or("its data URI has no comma before its data")?;
    let payload = percent_decoded(payload);
    let is_base64 = kind
        .split(';')
        .any(|part| part.trim().eq_ignore_ascii_case("base64"));
    if is_base64 {
        base64::decode(&payload)
    } else {
        Ok(payload)
    }
}

fn file(uri: &str) -> Result<PathBuf, String> {
    let decoded = String::from_utf8(percent_decoded(uri))
        .map_err(|_| "its URI is not UTF-8, expected a file in the model's folder")?;
    // Exporters on Windows write their own separator, which URIs do not have.
    let path = PathBuf::from(decoded.replace('\\', "/"));
    if path.file_name().is_none() && !path.ends_with("..") {
        return Err("its URI names no file".into());
    }
    Ok(path)
}

/// `text` with `%41` for `A`; a percent sign that begins no such code stands for itself.
fn percent_decoded(text: &str) -> Vec<u8> {
    let hex = |c: u8| (c as char).to_digit(16).map(|digit| digit as u8);
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let code = match after {
            [high, low, ..] if first == b'%' => hex(*high).zip(hex(*low)),
            _ => None,
        };
        if let Some((high, low)) = code {
            bytes.push(high * 16 + low);
            rest = &after[2..];
        } else {
            bytes.push(first);
            rest = after;
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn resolve(uri: &str) -> Result<Uri, String> {
        resolve_from(uri, Path::new("model.gltf"), &Options::default())
    }

    #[test]
    fn data_are_read_with_and_without_base64() {
        for uri in [
            "data:application/octet-stream;base64,AAEC",
            "DATA:;charset=x;BASE64,AAEC",
            "data:,%00%01%02",
        ] {
            assert_eq!(resolve(uri), Ok(Uri::Data(vec![0, 1, 2])), "{uri}");
        }
    }

    #[test]
    fn a_file_name_is_percent_decoded() {
        let file = |path: &str| Ok(Uri::File(PathBuf::from(path)));
        assert_eq!(
            resolve("Box%20With%20Spaces.bin"),
            file("Box With Spaces.bin")
        );
        assert_eq!(resolve("100%.png"), file("100%.png"));
        assert_eq!(resolve("textures\\wood.png"), file("textures/wood.png"));
        assert_eq!(resolve("a/../wood.png"), file("a/../wood.png"));
    }

    #[test]
    fn what_leads_away_is_refused() {
        for (uri, decoded) in [
            ("../a.bin", "../a.bin"),
            ("a/../../b", "a/../../b"),
            ("/etc/passwd", "/etc/passwd"),
            ("%2e%2e/a", "../a"),
        ] {
            assert_eq!(
                resolve(uri),
                Err(format!(
                    "its URI \"{decoded}\" leads out of the model's folder; move the file beside the model, or use --allow-external"
                ))
            );
        }
        for (uri, scheme, way_out) in [
            ("https://a/b.bin", "https", ""),
            (
                "file:///a",
                "file",
                "; move the file beside the model, or use --allow-external",
            ),
            ("C:\\a", "C", ""),
        ] {
            assert_eq!(
                resolve(uri),
                Err(format!(
                    "its URI begins with \"{scheme}:\", expected a file in the model's folder or data{way_out}"
                ))
            );
        }
        assert_eq!(resolve(""), Err("its URI names no file".into()));
        assert_eq!(
            resolve("data:x"),
            Err("its data URI has no comma before its data".into())
        );
    }

    #[test]
    fn who_means_it_may_name_files_elsewhere() {
        let all = Options {
            allow_external: true,
            ..Options::default()
        };
        for (uri, path) in [
            ("../a%20b", "m/../a b"),
            ("/a", "/a"),
            ("file:///a", "/a"),
            ("file:/a", "/a"),
            ("FILE://localhost/a", "/a"),
        ] {
            let found = resolve_from(uri, Path::new("m/model.gltf"), &all);
            assert_eq!(found, Ok(Uri::File(PathBuf::from(path))), "{uri}");
        }
        assert!(resolve_from("https://a/b", Path::new("model.gltf"), &all).is_err());
    }
}
