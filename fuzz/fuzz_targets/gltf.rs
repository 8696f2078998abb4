//! The JSON of a glTF file, a zero, and what lies beside it as `model.bin`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let (json, buffer) = luch_fuzz::halves(bytes);
    luch_fuzz::files(&[("model.gltf", json), ("model.bin", buffer)]);
});
