//! glTF files, written by each test: what they say is what the model has, and every wrong one has its own words.

mod bounds;
mod facts;
mod file;
mod geometry;
mod materials;
mod nodes;
mod seen;
mod textures;
mod wrong;
