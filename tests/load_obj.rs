//! OBJ files as a user has them: written to a folder, opened through the front door.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

use glam::{Vec2, Vec3};
use luch::color::Rgb;
use luch::load::{self, Model, obj};
use luch::material::{AlphaChannel, AlphaMode, Material, Model as Shading, Phong};
use luch::mesh::Mesh;
use luch::texture::{Encoding, Wrap};
use std::path::Path;
use tempfile::TempDir;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

const TEXTURED: &str =
    "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";

fn folder(files: &[(&str, &[u8])]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    }
    folder
}

fn open(obj: impl AsRef<[u8]>) -> Model {
    open_with(obj, &[])
}

fn open_with(obj: impl AsRef<[u8]>, beside: &[(&str, &[u8])]) -> Model {
    let folder = folder(beside);
    let path = folder.path().join("model.obj");
    std::fs::write(&path, obj).unwrap();
    obj::open(&path, &load::Options::default()).unwrap()
}

/// What stands after the file's name.
fn problem(obj: impl AsRef<[u8]>) -> String {
    let folder = folder(&[("model.obj", obj.as_ref())]);
    let error = obj::open(&folder.path().join("model.obj"), &load::Options::default()).unwrap_err();
    let text = error.to_string();
    text.split_once("model.obj: ").unwrap().1.to_owned()
}

fn warnings(model: &Model) -> Vec<String> {
    model.warnings.iter().map(ToString::to_string).collect()
}

fn area(mesh: &Mesh) -> f32 {
    let one = |[a, b, c]: &[u32; 3]| {
        let [a, b, c] = [a, b, c].map(|&i| mesh.positions[i as usize]);
        (b - a).cross(c - a).length() / 2.0
    };
    mesh.triangles.iter().map(one).sum()
}

fn png(width: u32, pixels: &[[u8; 4]]) -> Vec<u8> {
    let height = pixels.len() as u32 / width;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgba);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(pixels.as_flattened()).unwrap();
    writer.finish().unwrap();
    bytes
}

fn phong(material: &Material) -> &Phong {
    match &material.model {
        Shading::Phong(phong) => phong,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_concave_polygon_has_its_area() {
    // A comb of three teeth, standing in the plane x = y.
    let outline = [
        [0, 0],
        [5, 0],
        [5, 4],
        [4, 4],
        [4, 1],
        [3, 1],
        [3, 4],
        [2, 4],
        [2, 1],
        [1, 1],
        [1, 4],
        [0, 4],
    ];
    let mut text = String::new();
    for [a, b] in outline {
        text += &format!("v {a} {a} {b}\n");
    }
    text += "f 1 2 3 4 5 6 7 8 9 10 11 12\n";
    let model = open(text);
    assert_eq!(model.facts.triangles, 10);
    assert!((area(&model.meshes[0]) - 14.0 * 2f32.sqrt()).abs() < 1e-4);
}

#[test]
fn every_way_to_end_a_line_gives_the_same_model() {
    let plain = open(TRIANGLE);
    let mut with_mark = b"\xef\xbb\xbf".to_vec();
    with_mark.extend(TRIANGLE.bytes());
    let utf_16: Vec<u8> = [0xff, 0xfe]
        .into_iter()
        .chain(TRIANGLE.bytes().flat_map(|byte| [byte, 0]))
        .collect();
    for text in [
        TRIANGLE.replace('\n', "\r\n").into_bytes(),
        TRIANGLE.replace('\n', "\r").into_bytes(),
        TRIANGLE.replace("f 1 2 3", "f 1 \\\n2 \\\n 3").into_bytes(),
        TRIANGLE.replace(' ', "\t ").into_bytes(),
        TRIANGLE.trim_end().as_bytes().to_vec(),
        with_mark,
        utf_16,
    ] {
        assert_eq!(open(text).meshes, plain.meshes);
    }
}

#[test]
fn negative_indices_count_back_from_the_latest() {
    let text = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n";
    assert_eq!(open(text).meshes, open(TRIANGLE).meshes);
}

#[test]
fn a_face_may_name_vertices_that_come_later() {
    let text = "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
    assert_eq!(open(text).meshes, open(TRIANGLE).meshes);
}

#[test]
fn objects_are_shapes_and_materials_are_parts() {
    let faces =
        "o a\nusemtl x\nf 1 2 3\ng part\nusemtl y\nf 1 2 3\no b\nf 1 2 3\no a\nusemtl x\nf 1 2 3\n";
    let model = open(format!("{}{faces}", TRIANGLE.replace("f 1 2 3\n", "")));
    let names: Vec<&str> = model.nodes.iter().map(|node| node.name.as_str()).collect();
    assert_eq!(names, ["a", "b"]);
    let parts: Vec<usize> = model.shapes.iter().map(|shape| shape.parts.len()).collect();
    assert_eq!(parts, [2, 1]);
    let triangles: Vec<usize> = model
        .meshes
        .iter()
        .map(|mesh| mesh.triangles.len())
        .collect();
    assert_eq!(triangles, [2, 1, 1]);
    let shown: Vec<Option<usize>> = model.nodes.iter().map(|node| node.shape).collect();
    assert_eq!((shown, model.roots), (vec![Some(0), Some(1)], vec![0, 1]));
}

#[test]
fn groups_are_shapes_where_there_are_no_objects() {
    let model = open(format!("{TRIANGLE}g left wing\nf 1 2 3\n"));
    let names: Vec<&str> = model
        .shapes
        .iter()
        .map(|shape| shape.name.as_str())
        .collect();
    assert_eq!(names, ["", "left wing"]);
}

#[test]
fn latin_1_names_are_read() {
    let model = open(b"o gr\xfcn\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert_eq!(model.shapes[0].name, "gr\u{fc}n");
}

#[test]
fn vertices_are_shared_where_all_of_them_is_the_same() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    let shared = open(format!("{square}f 1 2 3 4\n"));
    assert_eq!(shared.meshes[0].positions.len(), 4);
    let split = open(format!(
        "{square}vt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/2 3/1 4/1\n"
    ));
    assert_eq!(split.meshes[0].positions.len(), 5);
}

#[test]
fn faces_without_normals_are_flat_among_smooth_ones() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 -1\nvn 0 3 4\nvn 0 0 0\nf 1//1 2//1 3//1\nf 1 3 4\nf 1//2 2//2 3//2\n";
    let mesh = &open(text).meshes[0];
    let of = |face: usize| mesh.triangles[face].map(|i| mesh.normals[i as usize]);
    assert_eq!(of(0), [Vec3::new(0.0, 0.6, 0.8); 3]);
    assert_eq!(of(1), [Vec3::NEG_X; 3]);
    assert_eq!(of(2), [Vec3::Z; 3]);
    assert!(open(TRIANGLE).meshes[0].normals.is_empty());
}

#[test]
fn texture_coordinates_are_turned_over() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.75\nvt 0.5\nf 1/1 2/2 3/1\n";
    let uvs = &open(text).meshes[0].uvs[0];
    assert_eq!(uvs[..2], [Vec2::new(0.25, 0.25), Vec2::new(0.5, 1.0)]);
}

#[test]
fn vertex_colors_are_srgb_and_white_where_missing() {
    let text = "v 0 0 0\nv 1 0 0 0.5 0 1\nv 0 1 0 nan 0 0\nf 1 2 3\n";
    let model = open(text);
    let [white, color, broken] = model.meshes[0].colors[..] else {
        panic!("three expected")
    };
    assert_eq!((white, broken), ([1.0; 4], [1.0; 4]));
    assert!((color[0] - 0.2140).abs() < 1e-4, "IEC 61966-2-1");
    assert_eq!(color[1..], [0.0, 1.0, 1.0]);
    let bytes = open(text.replace("0.5 0 1", "255 0 255").replace("nan", "0"));
    assert_eq!(bytes.meshes[0].colors[1], [1.0, 0.0, 1.0, 1.0]);
    assert_eq!(
        warnings(&bytes),
        ["vertex colors go above 1 and are taken as 0 to 255"]
    );
}

#[test]
fn points_and_lines_are_counted() {
    let model = open(format!("{TRIANGLE}p 1 2\nl 1 2 3\nf 1\nf 1 2\n"));
    assert_eq!((model.facts.points, model.facts.lines), (3, 3));
    assert_eq!(model.facts.triangles, 1);
    assert_eq!(
        warnings(&model),
        [
            "a point is not drawn (3 times)",
            "a line segment is not drawn (3 times)"
        ]
    );
}

#[test]
fn what_is_ignored_is_told() {
    let text = format!(
        "{TRIANGLE}curv 0 1 1 2\ncurv 0 1\nv 0 0 0 2\ns 1\nf 1/7 2//-3 3\nv nan 0 0\nf 1 2 5\n"
    );
    assert_eq!(
        warnings(&open(text)),
        [
            "statement \"curv\" is not supported and ignored (2 times)",
            "the fourth number of a vertex, its weight, is ignored",
            "a corner names a texture coordinate or a normal that is not there, and has none (2 times)",
            "a face without normals is flat: smoothing groups are not supported (2 times)",
            "a triangle with a vertex that is no finite point is dropped",
        ]
    );
}

#[test]
fn a_wrong_line_is_named() {
    for (line, expected) in [
        ("v 1 2", "a vertex has too few numbers (2), expected x y z"),
        ("v 1 2 x", "a vertex has \"x\", expected a number"),
        ("v 1 2 0x3", "a vertex has \"0x3\", expected a number"),
        (
            "vt",
            "a texture coordinate has too few numbers (0), expected u v",
        ),
        ("vn 1 2", "a normal has too few numbers (2), expected x y z"),
        ("f 1 2 91", "face names vertex 91, there are 3"),
        ("f 1 2 -9", "face names vertex -9, there are 3"),
        ("f 0 1 2", "face names vertex 0, indices start at 1"),
        (
            "f 1 2 99999999999999999999",
            "face names vertex 99999999999999999999, there are 3",
        ),
        (
            "f 1 2 4294967296",
            "face names vertex 4294967296, there are 3",
        ),
        ("f 1.5 2 3", "face has \"1.5\", expected an index"),
        ("f 1 2 /3", "face corner \"/3\" names no vertex"),
        (
            "f 1/2/3/4 2 3",
            "face corner \"1/2/3/4\" has 4 numbers, expected at most 3",
        ),
        ("f", "face has no corner, expected 3 or more"),
    ] {
        let text = format!("{TRIANGLE}\n{line}\n");
        assert_eq!(problem(&text), format!("line 6: {expected}"));
        let joined = format!("# one \\\nv 0 \\\n0 0\nv 1 0 0\nv 0 1 0\n{line}\n");
        assert_eq!(problem(&joined), format!("line 6: {expected}"));
    }
}

#[test]
fn nothing_to_draw_is_an_error() {
    let nothing = "has nothing to draw, expected a face with finite vertices";
    let no_faces = TRIANGLE.replace('f', "#");
    for text in ["", "\0\0\0", "# nothing\n", &no_faces] {
        assert_eq!(problem(text), nothing);
    }
    assert_eq!(problem(TRIANGLE.replace("1 0 0", "1e400 0 0")), nothing);
    let folder = folder(&[]);
    let error = obj::open(folder.path(), &load::Options::default())
        .unwrap_err()
        .to_string();
    assert!(error.ends_with("is a folder, expected a file"), "{error}");
}

#[test]
fn a_material_has_what_its_mtl_says() {
    let mtl = "newmtl a\nKd .1 .2 .3\nKs .4 .5 .6\nKe 7 8 9\nNs 50\nd .5\nillum 3\n";
    let model = open_with(TEXTURED, &[("a.mtl", mtl.as_bytes())]);
    let [a, default] = &model.materials[..] else {
        panic!("two expected")
    };
    let phong = phong(a);
    assert_eq!(phong.diffuse.factor, Rgb::new(0.1, 0.2, 0.3));
    assert_eq!(phong.specular.factor, Rgb::new(0.4, 0.5, 0.6));
    assert_eq!(phong.reflectivity, Rgb::new(0.4, 0.5, 0.6));
    assert_eq!(phong.shininess, 50.0);
    assert_eq!(a.emission.factor, Rgb::new(7.0, 8.0, 9.0));
    assert_eq!(
        (a.alpha.mode, a.alpha.coverage.factor),
        (AlphaMode::Blend, 0.5)
    );
    assert!(a.double_sided && default.double_sided);
    assert_eq!(model.shapes[0].parts[0].material, 0);
    assert_eq!(warnings(&model), [""; 0]);
}

#[test]
fn a_missing_mtl_leaves_grey() {
    let model = open(TEXTURED);
    assert_eq!(
        warnings(&model),
        [
            "MTL \"a.mtl\" is missing; its materials are grey",
            "material \"a\" is in no MTL; it is grey"
        ]
    );
    assert_eq!(model.materials.len(), 1);
    assert_eq!(phong(&model.materials[0]).diffuse.factor, Rgb::grey(0.8));
}

#[test]
fn several_mtls_and_names_with_blanks_are_found() {
    let red: &[u8] = b"newmtl a\nKd 1 0 0\n";
    let other: &[u8] = b"newmtl other\n";
    for (names, expected) in [
        ("one.mtl two.MTL", 3),
        ("my colors.mtl", 2),
        ("one.mtl my colors.mtl", 3),
        ("one.mtl\nmtllib two.MTL", 3),
        ("./one.mtl one.mtl two.MTL", 3),
    ] {
        let text = TEXTURED.replace("a.mtl", names);
        let beside = [("one.mtl", other), ("two.MTL", red), ("my colors.mtl", red)];
        let model = open_with(&text, &beside);
        assert_eq!(model.files.len(), expected, "{names}");
        let diffuse = phong(&model.materials[0]).diffuse.factor;
        assert_eq!(diffuse, Rgb::new(1.0, 0.0, 0.0), "{names}");
        assert_eq!(warnings(&model), [""; 0]);
    }
}

#[test]
fn a_missing_texture_leaves_the_factor() {
    let mtl = b"newmtl a\nKd 1 0 0\nmap_Kd gone.png\nmap_Ks /dev/zero\n";
    let model = open_with(TEXTURED, &[("a.mtl", mtl)]);
    assert_eq!(
        warnings(&model),
        [
            "texture \"gone.png\" is missing and not used",
            "texture \"/dev/zero\" is missing and not used"
        ]
    );
    let diffuse = &phong(&model.materials[0]).diffuse;
    assert_eq!(
        (diffuse.factor, &diffuse.texture),
        (Rgb::new(1.0, 0.0, 0.0), &None)
    );
    assert_eq!(model.facts.textures.len(), 2);
}

#[test]
fn a_texture_that_is_no_image_is_told_and_not_used() {
    let files: [(&str, &[u8]); 2] = [("a.mtl", b"newmtl a\nmap_Kd a.dds\n"), ("a.dds", b"DDS |")];
    let model = open_with(TEXTURED, &files);
    let said = &warnings(&model)[0];
    let expected =
        "a.dds: is a DDS image, which is not supported; use PNG or JPEG; the texture is not used";
    assert!(said.ends_with(expected), "{said}");
    assert!(model.textures.is_empty());
}

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
fn texture_options_do_what_they_say() {
    let mtl = b"newmtl a\nKd .5 .5 .5\nmap_Kd -s 2 3 1 -o .25 .5 -clamp on dark oak.png\n";
    let picture = png(1, &[[1, 2, 3, 255]]);
    let files: [(&str, &[u8]); 2] = [("a.mtl", mtl), ("dark oak.png", &picture)];
    let model = open_with(TEXTURED, &files);
    let diffuse = &phong(&model.materials[0]).diffuse;
    assert_eq!(diffuse.factor, Rgb::grey(0.5));
    let used = diffuse.texture.as_ref().unwrap();
    // The file's (0.5, 0.5): 2 x 0.5 + 0.25 and 3 x 0.5 + 0.5 from below.
    let uv = used.transform.unwrap().transform_point2(Vec2::splat(0.5));
    assert!((uv - Vec2::new(1.25, 1.0 - 2.0)).length() < 1e-6);
    let texture = &model.textures[used.texture as usize];
    assert_eq!(texture.wrap, [Wrap::ClampToEdge; 2]);
    assert_eq!(texture.encoding, Encoding::Srgb);
    assert_eq!(model.facts.textures[0].size, Some((1, 1)));
}

#[test]
fn coverage_is_an_alpha_that_says_something_or_else_red() {
    let mtl = b"newmtl a\nmap_d cover.png\n";
    for (pixel, options, expected) in [
        ([9, 9, 9, 255], "", AlphaChannel::Red),
        ([9, 9, 9, 100], "", AlphaChannel::Alpha),
        ([9, 9, 9, 255], "-imfchan m ", AlphaChannel::Alpha),
        ([9, 9, 9, 100], "-imfchan r ", AlphaChannel::Red),
    ] {
        let picture = png(1, &[pixel]);
        let mtl = String::from_utf8_lossy(mtl).replace("cover", &format!("{options}cover"));
        let files = [("a.mtl", mtl.as_bytes()), ("cover.png", &picture)];
        let alpha = &open_with(TEXTURED, &files).materials[0].alpha;
        assert_eq!((alpha.mode, alpha.channel), (AlphaMode::Blend, expected));
        assert!(alpha.coverage.texture.is_some());
    }
}

#[test]
fn normals_and_heights_become_normal_maps_with_tangents() {
    let normals = png(1, &[[128, 128, 255, 255]]);
    let heights = png(2, &[[0, 0, 0, 255], [255, 255, 255, 255]]);
    let files = |mtl: &'static str| {
        let (normals, heights): (&[u8], &[u8]) = (&normals, &heights);
        open_with(
            TEXTURED,
            &[
                ("a.mtl", mtl.as_bytes()),
                ("n.png", normals),
                ("h.png", heights),
            ],
        )
    };
    for (mtl, width, scale) in [
        ("newmtl a\nnorm n.png\n", 1, 1.0),
        ("newmtl a\nnorm h.png\n", 2, 1.0),
        ("newmtl a\nmap_Bump -bm 0.5 n.png\n", 1, 0.5),
        ("newmtl a\nbump h.png -bm 3\n", 2, 3.0),
    ] {
        let model = files(mtl);
        let map = model.materials[0].normal_map.as_ref().unwrap();
        assert_eq!(map.scale, scale);
        let texture = &model.textures[map.texture.texture as usize];
        assert_eq!(
            (texture.image.width, texture.encoding),
            (width, Encoding::Linear)
        );
        let mesh = &model.meshes[0];
        // u grows along x, and green, up in the picture, along y: n x t = y.
        assert_eq!(mesh.tangents, [Vec3::X.extend(1.0); 3]);
    }
    // A clamped ramp rising to the right by one pixel's width at both edges leans back to the left.
    let model = files("newmtl a\nbump -clamp on h.png\n");
    let [x, y, z, _] = model.textures[0]
        .sample(Vec2::new(0.25, 0.5))
        .map(|part| part * 2.0 - 1.0);
    assert!((Vec3::new(x, y, z) - Vec3::new(-1.0, 0.0, 2.0).normalize()).length() < 1e-3);
}

#[test]
fn plain_files_are_what_another_reader_reads() {
    let mut text = String::from("o grid\n");
    for i in 0..30 {
        let (x, y) = (i % 6, i / 6);
        text += &format!("v {x} {y} {}\nvt {} {}\nvn 0 {y} 1\n", i % 7, x * 2, y);
    }
    for i in (1..24).filter(|i| i % 6 != 0) {
        let [a, b, c, d] = [i, i + 1, i + 7, i + 6];
        text += &format!("f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}\n");
        text += &format!("f {a}/{a}/{a} {c}/{c}/{c} {d}/{d}/{d}\n");
    }
    let ours = open(&text);
    let theirs = tobj::load_obj_buf(&mut text.as_bytes(), &tobj::GPU_LOAD_OPTIONS, |_| {
        unreachable!("there is no mtllib")
    });
    let (models, _) = theirs.unwrap();
    let (ours, theirs) = (&ours.meshes[0], &models[0].mesh);
    let corners = || ours.triangles.as_flattened().iter().zip(&theirs.indices);
    assert_eq!(ours.triangles.len() * 3, theirs.indices.len());
    for (&our, &their) in corners() {
        let (our, at) = (our as usize, their as usize * 3);
        let position = Vec3::from_slice(&theirs.positions[at..]);
        let normal = Vec3::from_slice(&theirs.normals[at..]).normalize();
        let uv = Vec2::from_slice(&theirs.texcoords[their as usize * 2..]);
        assert_eq!(ours.positions[our], position);
        assert!((ours.normals[our] - normal).length() < 1e-6);
        assert_eq!(ours.uvs[0][our], Vec2::new(uv.x, 1.0 - uv.y));
    }
}
