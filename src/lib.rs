//! luch

mod error;
pub use error::Error;

pub mod color;
pub mod ray;
pub mod sampling;

pub mod camera;
pub mod geometry;
pub mod light;
pub mod material;
pub mod shade;
pub mod texture;

pub mod framing;
pub mod generate;
pub mod mesh;
pub mod scene;

pub mod accel;

pub mod film;
pub mod render;
pub mod whitted;

pub mod load;
pub mod output;
