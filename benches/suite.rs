//! Every benchmark, in one program: `cargo bench`, or `cargo bench -- rays/` for those of one file.

mod frame;
mod load;
mod rays;

criterion::criterion_group!(
    benches,
    rays::closest_and_any_hit,
    frame::whole_frames,
    load::files
);
criterion::criterion_main!(benches);
