//! A GLB, whole.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    luch_fuzz::files(&[("model.glb", bytes)]);
});
