//! What is drawn: faces, normals, texture coordinates, colours, objects.

use super::files::{TRIANGLE, area, open, warnings};
use glam::{Vec2, Vec3};

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

/// A roof of two squares, 90 degrees at the ridge between vertices 2 and 5.
const ROOF: &str = "v 0 0 0\nv 1 1 0\nv 2 0 0\nv 2 0 -2\nv 1 1 -2\nv 0 0 -2\n";

#[test]
fn smooth_faces_share_the_mean_of_their_normals() {
    for (statements, ridge) in [
        ("s 1\nf 1 2 5 6\nf 2 3 4 5\n", true),
        // As in Blender, whichever the group, and whatever the material or the group of faces.
        ("s 1\nf 1 2 5 6\ns 2\ng b\nusemtl b\nf 2 3 4 5\n", true),
        ("s 1\nf 1 2 5 6\ns off\nf 2 3 4 5\n", false),
        ("o a\ns 1\nf 1 2 5 6\no b\nf 2 3 4 5\n", false),
    ] {
        let model = open(format!("{ROOF}{statements}"));
        let mesh = &model.meshes[0];
        let left = Vec3::new(-1.0, 1.0, 0.0).normalize();
        let at = |point: Vec3| {
            let at = mesh.positions.iter().position(|&p| p == point).unwrap();
            mesh.normals[at]
        };
        let expected = if ridge { Vec3::Y } else { left };
        assert!((at(Vec3::new(1.0, 1.0, 0.0)) - expected).length() < 1e-6);
        assert!((at(Vec3::ZERO) - left).length() < 1e-6);
    }
    for statements in [
        "f 1 2 5 6\n",
        "s 0\nf 1 2 5 6\n",
        "s 1\ns null\nf 1 2 5 6\n",
    ] {
        assert!(
            open(format!("{ROOF}{statements}")).meshes[0]
                .normals
                .is_empty()
        );
    }
}

#[test]
fn a_smooth_normal_weighs_faces_by_their_angle() {
    // At the origin: a right angle facing up, and 45 degrees facing along x.
    let text = "v 0 0 0\nv 0 0 3\nv 1 0 0\nv 0 1 1\ns 1\nf 1 2 3\nf 1 4 2\n";
    let mesh = &open(text).meshes[0];
    let at = mesh
        .positions
        .iter()
        .position(|&p| p == Vec3::ZERO)
        .unwrap();
    let faces = |i: usize| {
        let [a, b, c] = mesh.triangles[i].map(|i| mesh.positions[i as usize]);
        (b - a).cross(c - a).normalize()
    };
    let expected = (faces(0) * 2.0 + faces(1)).normalize();
    assert!((mesh.normals[at] - expected).length() < 1e-6);
}

#[test]
fn a_smooth_face_keeps_the_normals_it_names() {
    let text = format!("{ROOF}vn 0 0 1\ns 1\nf 1//1 2 5 6\nf 2 3 4 5\n");
    let mesh = &open(text).meshes[0];
    let [first, ridge, ..] = mesh.triangles[0].map(|i| mesh.normals[i as usize]);
    assert_eq!(first, Vec3::Z);
    assert!((ridge - Vec3::Y).length() < 1e-6);
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
fn polypaint_colors_the_vertices_before_it() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n#MRGB ffff0000ff00ff00\nf 1 2 3\n";
    let colors = |text: &str| open(text).meshes[0].colors.clone();
    let [white, red, green] = [[1.0; 4], [1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0]];
    assert_eq!(colors(text), [white, red, green]);
    // Lines of one block, and more colours than vertices.
    let lines = text.replace("ff00ff00", "\n#MRGB ff00ff00");
    assert_eq!(colors(&lines), [white, red, green]);
    let many = text.replace("#MRGB ", "#MRGB 0000000000000000");
    assert_eq!(colors(&many), [[0.0, 0.0, 0.0, 1.0], red, green]);
    assert!(colors(&text.replace("ffff", "mess")).is_empty());
}

#[test]
fn texture_coordinates_of_one_two_and_three_numbers_are_read() {
    let text = "v 0 0 0 2\nv 1 0 0\nv 0 1 0\nvt .5\nvt .5 1\nvt .5 1 9\nf 1/1 2/2 3/3\n";
    let expected = [
        Vec2::new(0.5, 1.0),
        Vec2::new(0.5, 0.0),
        Vec2::new(0.5, 0.0),
    ];
    assert_eq!(open(text).meshes[0].uvs[0], expected);
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
