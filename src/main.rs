//! luch
fn main() {}
