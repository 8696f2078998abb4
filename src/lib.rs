//! A Whitted ray tracer: a file becomes a [`scene::Scene`]; a scene gets an [`accel::Accel`]; both become a
//! [`film::Film`]; a film becomes a file.
//!
//! ```no_run
//! use luch::accel::{Accel, Options};
//! use luch::load::{self, Viewpoint};
//! use luch::output::{self, Destination};
//! use luch::render::{Progress, Settings, render};
//! use luch::shade::Shading;
//! use std::path::Path;
//!
//! let asset = load::open(Path::new("assets/models/cube.glb"), &load::Options::default())?;
//! let (scene, choices) = asset.scene(0.0, &Viewpoint::of_file(4.0 / 3.0))?;
//!
//! let accel = Accel::build(&scene, &Options::default());
//! let settings = Settings::new(640, 480, 4, 5, Shading::BlinnPhong)?;
//! let film = render(&scene, &accel, &settings, &Progress::default());
//!
//! Destination::claim(Path::new("cube.png"))?.write(&film, &output::Options { exposure: choices.exposure, ..Default::default() })?;
//! choices.lines.iter().for_each(|line| println!("{line}"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Errors live at the two doors, [`load`] and [`output`], and where a scene and its settings are made; between them
//! nothing fails. Every pixel has the same bits for any number of threads, tile size, tree and machine.
//!
//! The modules stand on floors, and each uses only those below it: numbers, things and their equations, the world, search,
//! the picture, the doors.

mod error;

pub use error::{Error, OutOfMemory};

// Numbers.
pub mod color;
pub mod cone;
pub mod ray;
pub mod sampling;

// Things and their equations.
pub mod camera;
pub mod environment;
pub mod geometry;
pub mod light;
pub mod material;
pub mod shade;
pub mod texture;

// The world.
pub mod framing;
pub mod generate;
pub mod mesh;
pub mod scene;

// Search.
pub mod accel;

// The picture.
pub mod film;
pub mod render;
pub mod whitted;

// The doors.
pub mod load;
pub mod output;

// The roof.
pub mod study;
