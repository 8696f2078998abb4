//! What a file says of a picture beside its pixels.

use crate::camera::Camera;

/// What a file says of a picture beside its pixels. EXR only.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Header {
    /// Whose the picture is; empty where nobody says.
    pub owner: String,
    /// When it was made, in seconds since 1970 began, UTC. A file that says it differs from run to run.
    pub captured: Option<u64>,
    /// What saw it.
    pub camera: Option<Camera>,
    /// Where in a sequence it stands.
    pub frame: Option<Frame>,
    /// What else is known of it, by names of ASCII of at most 250 bytes, before which the file puts `luch/`.
    pub facts: Vec<(String, Fact)>,
}

/// Something known of a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Fact {
    /// In words.
    Text(String),
    /// As a number: counts too, which are exact up to 2^53.
    Number(f64),
}

/// A place in a sequence of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Its number.
    pub number: i32,
    /// How many there are a second, as a fraction: 24/1, 30000/1001.
    pub per_second: Option<[u32; 2]>,
}
