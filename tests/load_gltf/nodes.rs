//! Where things stand: nodes, scenes, cameras, lights.

use super::file::{File, warnings};
use glam::{DVec3, Vec3};
use luch::camera::{Fov, Projection};
use luch::light::{Falloff, LightKind};
use serde_json::{Value, json};
use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI};

#[test]
fn nodes_stand_where_matrices_and_factors_put_them() {
    let mut file = File::triangle();
    // A quarter turn about z takes x to y.
    let half = 0.5f32.sqrt();
    file.json["nodes"] = json!([
        {"children": [1, 2], "translation": [10, 0, 0]},
        {"mesh": 0, "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1]},
        {"mesh": 0, "translation": [0, 0, 5], "rotation": [0, 0, half, half], "scale": [-2, 1, 1]},
    ]);
    let model = file.model();
    let placed = model.placed_nodes();
    let seen = |i: usize, p: DVec3| {
        let at = placed[i].1.transform_point3(p);
        (at * 1e6).round() / 1e6
    };
    assert_eq!(placed.len(), 3);
    assert_eq!(seen(1, DVec3::X), DVec3::new(10.0, 1.0, 5.0));
    assert_eq!(seen(2, DVec3::X), DVec3::new(10.0, -2.0, 5.0));
    assert_eq!(seen(2, DVec3::Y), DVec3::new(9.0, 0.0, 5.0));
    assert!(placed[2].1.matrix3.determinant() < 0.0);
    assert_eq!((model.meshes.len(), model.facts.triangles), (1, 1));
}

#[test]
fn without_scenes_every_root_is_drawn_and_a_scene_draws_its_own() {
    let nodes = json!([{"mesh": 0}, {"children": [2]}, {"mesh": 0}, {"mesh": 0}]);
    let roots = |scenes: Value, scene: Option<usize>| {
        let mut file = File::triangle();
        file.json["nodes"] = nodes.clone();
        file.json["scenes"] = scenes;
        file.json.as_object_mut().map(|root| root.remove("scene"));
        if let Some(scene) = scene {
            file.json["scene"] = scene.into();
        }
        let model = file.model();
        (model.roots.clone(), warnings(&model))
    };
    assert_eq!(roots(json!([]), None), (vec![0, 1, 3], vec![]));
    assert_eq!(
        roots(json!([{"nodes": [0]}, {"nodes": [3, 1]}]), Some(1)),
        (vec![3, 1], vec![])
    );
    assert_eq!(
        roots(json!([{"nodes": [0]}, {"nodes": [3]}]), None),
        (vec![0], vec![])
    );
    assert_eq!(
        roots(json!([{"nodes": [1, 2, 1]}]), None),
        (
            vec![1],
            vec![
                "a node that a scene lists twice is drawn once".to_owned(),
                "a node that a scene lists beside one above it is drawn once, below that"
                    .to_owned()
            ]
        )
    );
    assert_eq!(
        roots(json!([{"nodes": [2]}]), None),
        (
            vec![2],
            vec!["a node that a scene lists without the one above it stands by itself".to_owned()]
        )
    );
}

#[test]
fn a_shared_child_stays_with_its_first_parent() {
    let mut file = File::triangle();
    // Each of 40 levels names the next one twice: 2^40 places, if it were taken at its word.
    let mut nodes: Vec<Value> = (1..41)
        .map(|next| json!({"children": [next, next]}))
        .collect();
    nodes.push(json!({"mesh": 0}));
    file.json["nodes"] = nodes.into();
    let model = file.model();
    assert_eq!(model.placed_nodes().len(), 41);
    assert_eq!(
        warnings(&model),
        ["a node with several parents stays with the first (40 times)"]
    );
}

#[test]
fn a_deep_chain_of_nodes_is_walked() {
    let mut file = File::triangle();
    let mut nodes: Vec<Value> = (1..100_001)
        .map(|next| json!({"children": [next]}))
        .collect();
    nodes.push(json!({"mesh": 0}));
    file.json["nodes"] = nodes.into();
    assert_eq!(file.model().placed_nodes().len(), 100_001);
}

#[test]
fn what_is_below_an_infinite_transform_is_not_drawn_and_a_singular_one_is_told() {
    let mut file = File::triangle();
    file.json["nodes"] = json!([
        {"children": [1, 2]},
        {"name": "far", "translation": [1e39, 0, 0], "children": [3]},
        {"mesh": 0, "scale": [1, 0, 1]},
        {"mesh": 0},
    ]);
    let model = file.model();
    assert_eq!(model.placed_nodes().len(), 3);
    assert_eq!(
        warnings(&model),
        [
            "node 2: its transform is singular: what it places is flattened",
            "node \"far\": its transform is not of finite numbers: nothing from it downward is drawn"
        ]
    );
}

#[test]
fn lights_are_read_in_units_of_what_a_matt_surface_shows() {
    let mut file = File::triangle();
    file.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    file.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "area"},
        {"type": "point", "name": "bulb", "intensity": 10, "color": [1, 0.5, 0], "range": 4},
        {"type": "directional"},
        {"type": "spot", "spot": {"innerConeAngle": 0.1}},
        {"type": "spot", "intensity": -1, "range": 0, "spot": {"innerConeAngle": 1, "outerConeAngle": 9}},
    ]}});
    file.json["nodes"][0]["extensions"] = json!({"KHR_lights_punctual": {"light": 1}});
    let model = file.model();
    let [bulb, sun, spot, mended] = &model.lights[..] else {
        panic!("{} lights", model.lights.len())
    };
    assert_eq!(
        (model.nodes[0].light, bulb.name.as_str()),
        (Some(0), "bulb")
    );
    assert_eq!(
        (bulb.intensity, bulb.color.g, bulb.range),
        (10.0 / PI, 0.5, Some(4.0))
    );
    assert_eq!(bulb.falloff, Falloff::InverseSquare);
    assert_eq!(
        sun.kind,
        LightKind::Directional {
            direction: Vec3::NEG_Z
        }
    );
    assert_eq!((sun.intensity, sun.range), (1.0 / PI, None));
    let cone = |inner_angle, outer_angle| LightKind::Spot {
        position: Vec3::ZERO,
        direction: Vec3::NEG_Z,
        inner_angle,
        outer_angle,
    };
    assert_eq!(spot.kind, cone(0.1, FRAC_PI_4));
    assert_eq!(mended.kind, cone(1.0, FRAC_PI_2));
    assert_eq!((mended.intensity, mended.range), (0.0, None));
    assert_eq!(
        warnings(&model),
        [
            "light 0: its type is \"area\": it is ignored",
            "light 4: its cone angles are 1 and 9, taken as 1 and 1.5707964",
            "light 4: its intensity is -1, taken as 0",
            "light 4: its range is 0, taken as none",
        ]
    );
}

#[test]
fn cameras_keep_what_the_picture_does_not_decide() {
    let mut file = File::triangle();
    file.json["cameras"] = json!([
        {"type": "perspective", "perspective": {"yfov": -1, "znear": 1}},
        {"type": "perspective", "name": "eye", "perspective": {"yfov": 0.5, "aspectRatio": 2, "znear": 0.1}},
        {"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 2, "znear": 0, "zfar": 9}},
        {"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 2, "znear": 9, "zfar": 1}},
    ]);
    file.json["nodes"] = json!([{"mesh": 0, "camera": 1, "children": [1]}, {"camera": 0}]);
    let model = file.model();
    let seen: Vec<_> = model
        .cameras
        .iter()
        .map(|c| (c.projection, c.near, c.far))
        .collect();
    let parallel = Projection::Orthographic {
        half_width: None,
        half_height: 2.0,
    };
    assert_eq!(
        seen,
        [
            (
                Projection::Perspective { fov: Fov::Y(0.5) },
                0.1,
                f32::INFINITY
            ),
            (parallel, 0.0, 9.0),
            (parallel, 0.0, f32::INFINITY),
        ]
    );
    assert_eq!(
        (model.nodes[0].camera, model.nodes[1].camera),
        (Some(0), None)
    );
    assert_eq!(
        warnings(&model),
        [
            "camera 0: its yfov is -1, expected an angle above 0 and below π: it is ignored",
            "camera 3: its near plane is at 9, its far plane at 1: neither clips",
        ]
    );
}
