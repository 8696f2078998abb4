//! glTF files, written by each test: what they say is what the model has, and every wrong one has its own words.

mod animation;
mod facts;
mod file;
mod geometry;
mod implicit_shapes;
mod material_extensions;
mod materials;
mod nodes;
mod seen;
mod textures;
mod wrong;
