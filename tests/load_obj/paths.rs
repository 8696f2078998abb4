//! Where the files lie that others name.

use super::files::{TEXTURED, folder, open_with, png, warnings};
use luch::load::{Options, obj};
use std::path::Path;

#[test]
fn a_texture_is_found_beside_the_file_that_names_it() {
    let picture = png(1, &[[1, 2, 3, 255]]);
    for (name, place) in [
        ("C:\\Users\\me\\Oak.PNG", "oak.png"),
        ("/home/me/oak.png", "oak.png"),
        ("textures/oak.png", "oak.png"),
        ("../oak.png", "lib/oak.png"),
    ] {
        let text = TEXTURED.replace("a.mtl", "lib/a.mtl");
        let mtl = format!("newmtl a\nmap_Kd {name}\n");
        let files = [("lib/a.mtl", mtl.as_bytes()), (place, &picture)];
        let model = open_with(&text, &files);
        assert_eq!(model.textures.len(), 1, "{name}");
        let said = warnings(&model).pop().unwrap();
        assert!(said.contains(" is not there; ") && said.ends_with(" is taken"));
        assert!(model.files[2].ends_with(Path::new(place)));
    }
    let mtl = b"newmtl a\nmap_Kd maps\\oak.png\n";
    let files: [(&str, &[u8]); 2] = [("a.mtl", mtl), ("maps/oak.png", &picture)];
    assert_eq!(warnings(&open_with(TEXTURED, &files)), [""; 0]);
}

#[test]
fn what_lies_outside_the_folder_is_read_only_where_that_is_allowed() {
    let picture = png(1, &[[1, 2, 3, 255]]);
    let text = TEXTURED.replace("a.mtl", "../a.mtl");
    let files: [(&str, &[u8]); 3] = [
        ("in/model.obj", text.as_bytes()),
        ("a.mtl", b"newmtl a\nmap_Kd oak.png\n"),
        ("oak.png", &picture),
    ];
    let folder = folder(&files);
    let path = folder.path().join("in/model.obj");
    let model = obj::open(&path, &Options::default()).unwrap();
    assert_eq!(
        warnings(&model)[0],
        "MTL \"../a.mtl\" leads out of the model's folder; move it beside the model or use --allow-external; its materials are grey"
    );
    assert_eq!(model.files, [path.as_path()]);
    let options = Options {
        allow_external: true,
        ..Options::default()
    };
    let model = obj::open(&path, &options).unwrap();
    assert_eq!((model.files.len(), model.textures.len()), (3, 1));
}
