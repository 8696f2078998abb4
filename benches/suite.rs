//! Every benchmark but that of rays, in one program: `cargo bench --bench suite`, or `cargo bench -- frame/` for those
//! of one file.

mod frame;
mod load;
mod write;

criterion::criterion_group!(benches, frame::whole_frames, load::files, write::films);
criterion::criterion_main!(benches);
