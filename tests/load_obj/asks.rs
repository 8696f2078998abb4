//! What a file asks for, as `luch info` tells it.

use super::files::{TEXTURED, TRIANGLE, open, open_with};
use luch::load::Model;

fn asks(model: &Model) -> Vec<String> {
    let asks = model.facts.asks.iter();
    asks.map(|ask| format!("{}: {}", ask.what, ask.treatment.name()))
        .collect()
}

#[test]
fn a_plain_triangle_asks_for_nothing() {
    assert_eq!(asks(&open(TRIANGLE)), [""; 0]);
    assert_eq!(asks(&open(format!("s off\n{TRIANGLE}"))), [""; 0]);
}

#[test]
fn what_the_geometry_asks_is_told_once() {
    let text = format!(
        "v 0 0 0 1 0 0\ns 1\n{TRIANGLE}f 1 2 3\np 1\nl 1 2\ncstype bezier\ncurv 0 1 1 2\ncall a.obj\ncsh rm a\nACME 1\n"
    );
    assert_eq!(
        asks(&open(text)),
        [
            "smoothing groups: honoured",
            "vertex colors: honoured",
            "points: ignored",
            "line segments: ignored",
            "curves and surfaces: ignored",
            "other files and programs (call, csh): ignored",
        ]
    );
}

#[test]
fn what_the_materials_ask_is_told_once() {
    let mtl = b"newmtl b\nillum 7\nNi 1.5\nTf 1 1 1\nnewmtl c\nKs 1 1 1\nillum 3\n\
        newmtl a\nPr .5\nPs 1\nPc 1\naniso .5\nanisor .5\nmap_Kd -mm 0 1 gone.png\nmap_Ks -mm 0 1 gone.png\nrefl a.png\ndisp a.png\n";
    let text = format!("{TEXTURED}usemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\nusemtl b\nf 3 2 1\n");
    assert_eq!(
        asks(&open_with(text, &[("a.mtl", mtl)])),
        [
            "mirrors (illum): honoured",
            "glass (illum): honoured",
            "PBR statements: approximated",
            "sheen (Ps): honoured",
            "clear coat (Pc): approximated",
            "anisotropy (aniso): approximated",
            "rotation of anisotropy (anisor): ignored",
            "texture option -mm: ignored",
            "reflection maps (refl): ignored",
            "displacement maps (disp): ignored",
        ]
    );
    // No face is made of them.
    let unused = b"newmtl a\nnewmtl b\nPr 1\nrefl a.png\n";
    assert_eq!(asks(&open_with(TEXTURED, &[("a.mtl", unused)])), [""; 0]);
}
