//! A scene file, which may place a triangle.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    luch_fuzz::files(&[
        ("scene.toml", bytes),
        ("model.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
    ]);
});
