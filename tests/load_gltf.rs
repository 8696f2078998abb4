//! glTF files, written by each test: what they say is what the model has, and every wrong one has its own words.

mod animation;
mod bounds;
mod compressed;
mod facts;
mod file;
mod geometry;
mod implicit_shapes;
mod instances;
mod material_extensions;
mod materials;
mod nodes;
mod seen;
mod textures;
mod wrong;
