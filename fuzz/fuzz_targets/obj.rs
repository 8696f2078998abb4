//! An OBJ, a zero, and what lies beside it as `model.mtl`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let (obj, mtl) = luch_fuzz::halves(bytes);
    luch_fuzz::files(&[("model.obj", obj), ("model.mtl", mtl)]);
});
