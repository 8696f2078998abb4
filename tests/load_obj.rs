//! OBJ files, written by each test: what they say is what the model has.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod asks;
mod files;
mod geometry;
mod maps;
mod materials;
mod paths;
mod text;
