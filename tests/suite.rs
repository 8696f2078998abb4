//! Every integration test, in one program: linked once, and what they share is used.

mod accel;
mod adaptive;
mod analytic;
mod answers;
mod assets;
mod cli;
mod common;
mod environment;
mod environment_light;
mod finish;
mod framing;
mod golden;
#[cfg(unix)]
mod hostile;
mod invariance;
mod layers;
mod load_gltf;
mod load_obj;
mod load_scene_file;
mod models;
mod output;
mod parts;
mod refraction;
mod study;
mod textures;
mod windows;
