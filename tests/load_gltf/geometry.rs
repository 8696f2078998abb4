//! Triangles and what belongs to their corners.

use super::file::{BYTE, FLOAT, File, INT, SHORT, corners, floats, push, shorts, warnings};
use glam::{Vec2, Vec3};
use serde_json::json;

/// Points (0, 0), (1, 0), (0, 1), (1, 1), ... of the plane z = 0, as a strip has them.
fn strip_points(count: usize) -> Vec<u8> {
    let points = (0..count).flat_map(|i| [(i % 2) as f32, (i / 2) as f32, 0.0]);
    floats(&points.collect::<Vec<f32>>())
}

#[test]
fn indices_of_every_type_or_none_name_the_same_triangle() {
    let expected = corners(&File::triangle().model());
    assert_eq!(expected, [[Vec3::ZERO, Vec3::X, Vec3::Y]]);
    let ints: Vec<u8> = [0u32, 1, 2].iter().flat_map(|i| i.to_le_bytes()).collect();
    for (component, bytes) in [
        (BYTE, vec![0, 1, 2]),
        (SHORT, shorts(&[0, 1, 2])),
        (INT, ints),
    ] {
        let mut file = File::triangle();
        file.indices(component, &bytes);
        assert_eq!(corners(&file.model()), expected, "{component}");
    }
}

#[test]
fn strips_and_fans_face_the_same_way_with_and_without_indices() {
    for (mode, points) in [
        (5, strip_points(5)),
        (
            6,
            floats(&[0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0., -1., 0., 0.]),
        ),
    ] {
        let mut plain = File::new();
        plain.attribute("POSITION", "VEC3", &points);
        plain.primitive()["mode"] = mode.into();
        let mut indexed = File::new();
        indexed.attribute("POSITION", "VEC3", &points);
        indexed.primitive()["mode"] = mode.into();
        indexed.indices(BYTE, &[0, 1, 2, 3, 4]);
        let plain = corners(&plain.model());
        assert_eq!(plain.len(), 3);
        assert_eq!(plain, corners(&indexed.model()));
        for [a, b, c] in plain {
            assert!((b - a).cross(c - a).z > 0.0, "mode {mode}: {a} {b} {c}");
        }
    }
}

#[test]
fn points_and_lines_are_counted_and_not_drawn() {
    let mut file = File::triangle();
    for mode in 0..4 {
        let primitive = json!({"attributes": {"POSITION": 0}, "mode": mode});
        push(&mut file.json["meshes"][0]["primitives"], primitive);
    }
    let model = file.model();
    assert_eq!(
        (model.facts.triangles, model.facts.points, model.facts.lines),
        (1, 3, 1 + 3 + 2)
    );
    assert_eq!(
        warnings(&model),
        [
            "a point is not drawn (3 times)",
            "a line is not drawn (6 times)"
        ]
    );
}

#[test]
fn interleaved_attributes_are_told_apart() {
    let mut file = File::new();
    let mut rows = Vec::new();
    for (x, y) in [(0., 0.), (1., 0.), (0., 1.)] {
        rows.extend([x, y, 0.0, 0.0, 0.0, 2.0, x, 1.0 - y]);
    }
    let view = file.view(&floats(&rows));
    file.json["bufferViews"][view]["byteStride"] = 32.into();
    for (name, kind, offset) in [
        ("POSITION", "VEC3", 0),
        ("NORMAL", "VEC3", 12),
        ("TEXCOORD_1", "VEC2", 24),
    ] {
        let accessor = json!({"bufferView": view, "byteOffset": offset, "componentType": FLOAT,
            "type": kind, "count": 3});
        let accessor = push(&mut file.json["accessors"], accessor);
        file.primitive()["attributes"][name] = accessor.into();
    }
    let model = file.model();
    let mesh = &model.meshes[0];
    assert_eq!(mesh.positions, [Vec3::ZERO, Vec3::X, Vec3::Y]);
    assert_eq!(mesh.normals, [Vec3::Z; 3]);
    assert_eq!(mesh.uvs, [vec![], vec![Vec2::Y, Vec2::ONE, Vec2::ZERO]]);
}

#[test]
fn sparse_accessors_change_their_base_or_zeros() {
    for has_base in [true, false] {
        let mut file = File::triangle();
        let which = file.view(&shorts(&[0, 2]));
        let what = file.view(&floats(&[5., 0., 0., 0., 7., 0.]));
        let accessor = &mut file.json["accessors"][0];
        accessor["sparse"] = json!({
            "count": 2,
            "indices": {"bufferView": which, "componentType": SHORT},
            "values": {"bufferView": what},
        });
        if !has_base {
            accessor.as_object_mut().map(|a| a.remove("bufferView"));
        }
        let unchanged = if has_base { Vec3::X } else { Vec3::ZERO };
        assert_eq!(
            corners(&file.model()),
            [[Vec3::X * 5.0, unchanged, Vec3::Y * 7.0]]
        );
    }
}

#[test]
fn normalized_colors_and_coordinates_are_shares() {
    let mut file = File::triangle();
    let colors = file.accessor(BYTE, "VEC4", &[255, 0, 51, 102, 0, 0, 0, 0, 0, 0, 0, 255]);
    let uvs = file.accessor(SHORT, "VEC2", &shorts(&[0, 65535, 13107, 0, 0, 0]));
    for accessor in [colors, uvs] {
        file.json["accessors"][accessor]["normalized"] = true.into();
    }
    file.primitive()["attributes"]["COLOR_0"] = colors.into();
    file.primitive()["attributes"]["TEXCOORD_0"] = uvs.into();
    let model = file.model();
    assert_eq!(model.meshes[0].colors[0], [1.0, 0.0, 0.2, 0.4]);
    assert_eq!(
        model.meshes[0].uvs[0],
        [Vec2::Y, Vec2::new(0.2, 0.0), Vec2::ZERO]
    );
    let mut file = File::triangle();
    file.attribute("COLOR_0", "VEC3", &floats(&[0.5; 9]));
    assert_eq!(file.model().meshes[0].colors, [[0.5, 0.5, 0.5, 1.0]; 3]);
}

#[test]
fn normals_become_unit_and_those_without_direction_zero() {
    let mut file = File::triangle();
    file.attribute(
        "NORMAL",
        "VEC3",
        &floats(&[0., 0., 3., 0., f32::NAN, 0., 0., 0., 0.]),
    );
    let model = file.model();
    assert_eq!(model.meshes[0].normals, [Vec3::Z, Vec3::ZERO, Vec3::ZERO]);
    assert_eq!(
        warnings(&model),
        ["a normal without direction is replaced by its face's (2 times)"]
    );
    assert!(File::triangle().model().meshes[0].normals.is_empty());
}

#[test]
fn a_triangle_at_no_place_is_left_out() {
    let mut file = File::new();
    let points = [0., 0., 0., 1., 0., 0., 0., 1., 0., f32::NAN, 0., 0.];
    file.attribute("POSITION", "VEC3", &floats(&points));
    file.indices(BYTE, &[0, 1, 2, 1, 2, 3]);
    let model = file.model();
    assert_eq!(model.meshes[0].triangles, [[0, 1, 2]]);
    assert!(model.meshes[0].positions.iter().all(|p| p.is_finite()));
    assert_eq!(
        warnings(&model),
        ["mesh \"chair\", primitive 0: a triangle with a position that is no number is not drawn"]
    );
}

#[test]
fn primitives_with_the_same_geometry_share_it() {
    let mut file = File::triangle();
    file.json["materials"] = json!([{"name": "a"}, {"name": "b"}]);
    file.json["meshes"][0]["primitives"] = json!([
        {"attributes": {"POSITION": 0}, "material": 0},
        {"attributes": {"POSITION": 0}, "material": 1},
        {"attributes": {"POSITION": 0}},
    ]);
    let model = file.model();
    let parts: Vec<_> = model.shapes[0]
        .parts
        .iter()
        .map(|p| (p.mesh, p.material))
        .collect();
    assert_eq!(parts, [(0, 0), (0, 1), (0, 2)]);
    assert_eq!((model.meshes.len(), model.materials.len()), (1, 3));
}
