//! Studies, from a plan to the page that tells what came out.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod browser;
mod bvh;
mod example;
