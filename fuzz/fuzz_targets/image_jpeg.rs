//! A JPEG as a texture.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    luch_fuzz::image("jpg", bytes);
});
