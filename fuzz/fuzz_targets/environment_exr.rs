//! An OpenEXR picture as an environment.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    luch_fuzz::environment("exr", bytes);
});
