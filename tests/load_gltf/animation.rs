//! What moves: animations, skins, morph targets, pointers, visibility. Expected values are those of the specification's
//! formulas on small numbers, and of the Khronos tutorial's models.

use super::file::{BYTE, File, SHORT, floats, push, shorts, warnings};
use crate::common::picture;
use glam::{Affine3, Vec3};
use luch::load::{self, AnimationChoice, Asset, Choices};
use luch::material::Model;
use luch::scene::Scene;
use serde_json::{Value, json};
use std::f32::consts::PI;
use std::fs;

/// The file on the disk, opened with a choice of animations.
fn try_open(mut file: File, animation: AnimationChoice) -> Result<Asset, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("model.gltf");
    file.json["buffers"] = json!([{"uri": "model.bin", "byteLength": file.bytes.len()}]);
    fs::write(folder.path().join("model.bin"), &file.bytes).expect("a buffer");
    fs::write(&path, file.json.to_string()).expect("a file");
    let options = load::Options {
        animation,
        ..load::Options::default()
    };
    let prefix = format!("{}/", folder.path().display());
    load::open(&path, &options).map_err(|error| error.to_string().replace(&prefix, ""))
}

fn open(file: File, animation: AnimationChoice) -> Asset {
    try_open(file, animation).unwrap_or_else(|error| panic!("{error}"))
}

fn scene_at(asset: &Asset, time: f64) -> (Scene, Choices) {
    let viewpoint = picture::viewpoint(1.0);
    asset.scene(time, &viewpoint).expect("a scene")
}

/// The vertices of everything in world space, instance after instance.
fn vertices_at(asset: &Asset, time: f64) -> Vec<Vec3> {
    let (scene, _) = scene_at(asset, time);
    let instances = scene.instances().iter();
    instances
        .flat_map(|instance| {
            let to_world = instance.space.map_or(Affine3::IDENTITY, |s| s.to_world);
            let positions = &scene.mesh(instance.mesh).positions;
            let seen = positions.iter().map(|&p| to_world.transform_point3(p));
            seen.collect::<Vec<Vec3>>()
        })
        .collect()
}

#[track_caller]
fn assert_near(found: &[Vec3], expected: &[Vec3]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((*found - *expected).length() < 1e-5, "{found} {expected}");
    }
}

/// A channel of animation 0, which is made where there is none; `kind` is the type of its values.
fn channel(file: &mut File, target: Value, way: &str, times: &[f32], kind: &str, values: &[f32]) {
    let input = file.accessor(super::file::FLOAT, "SCALAR", &floats(times));
    let output = file.accessor(super::file::FLOAT, kind, &floats(values));
    if file.json.get("animations").is_none() {
        file.json["animations"] = json!([{"name": "run", "channels": [], "samplers": []}]);
    }
    let animation = &mut file.json["animations"][0];
    let sampler = json!({"input": input, "output": output, "interpolation": way});
    let sampler = push(&mut animation["samplers"], sampler);
    push(
        &mut animation["channels"],
        json!({"sampler": sampler, "target": target}),
    );
}

fn pointer(path: &str) -> Value {
    json!({"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": path}}})
}

/// A triangle whose node moves from (0, 0, 0) to (4, 0, 0) in two seconds.
fn moving() -> File {
    let mut file = File::triangle();
    let target = json!({"node": 0, "path": "translation"});
    let values = [0., 0., 0., 4., 0., 0.];
    channel(&mut file, target, "LINEAR", &[1.0, 3.0], "VEC3", &values);
    file
}

#[test]
fn a_node_moves_between_its_keys_and_stands_before_and_after() {
    let asset = open(moving(), AnimationChoice::First);
    let xs = [0.0, 1.0, 1.5, 3.0, 9.0].map(|time| vertices_at(&asset, time)[0].x);
    assert_eq!(xs, [0.0, 0.0, 1.0, 4.0, 4.0]);
    let unmoved = open(moving(), AnimationChoice::None);
    assert_eq!(vertices_at(&unmoved, 9.0)[0].x, 0.0);
    let facts = &unmoved.models[0].model.facts.animations[0];
    assert_eq!((facts.name.as_str(), facts.seconds), ("run", 3.0));
    assert_eq!(
        (facts.moves[0].what.as_str(), facts.moves[0].count),
        ("translation", 1)
    );
}

#[test]
fn an_animation_goes_by_name_or_index_and_all_of_them_at_once() {
    let two = || {
        let mut file = moving();
        let mut second = file.json["animations"][0].clone();
        second["name"] = "0".into();
        second["channels"][0]["target"]["node"] = 1.into();
        push(&mut file.json["animations"], second);
        push(&mut file.json["nodes"], json!({"mesh": 0}));
        push(&mut file.json["scenes"][0]["nodes"], 1.into());
        file
    };
    let named = |name: &str| AnimationChoice::Named(name.into());
    for (choice, expected) in [
        (AnimationChoice::None, [0.0, 0.0]),
        (AnimationChoice::First, [4.0, 0.0]),
        (AnimationChoice::All, [4.0, 4.0]),
        (named("run"), [4.0, 0.0]),
        (named("0"), [0.0, 4.0]),
        (named("1"), [0.0, 4.0]),
    ] {
        let seen = vertices_at(&open(two(), choice.clone()), 3.0);
        assert_eq!([seen[0].x, seen[3].x], expected, "{choice:?}");
    }
    assert_eq!(
        try_open(two(), named("jump")).err().as_deref(),
        Some("model.gltf: there is no animation \"jump\"; there are 0 \"run\" and 1 \"0\"")
    );
    assert_eq!(
        try_open(File::triangle(), named("jump")).err().as_deref(),
        Some("model.gltf: there is no animation \"jump\"; the file has none")
    );
    let still = open(File::triangle(), AnimationChoice::First);
    let said: Vec<String> = still.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(said, ["has no animation: at every time it is the same"]);
}

#[test]
fn rotations_scales_and_splines_move_as_the_specification_says() {
    let mut file = File::triangle();
    let half = 0.5f32.sqrt();
    let turn = [0., 0., 0., 1., 0., 0., half, half];
    let target = json!({"node": 0, "path": "rotation"});
    channel(&mut file, target, "LINEAR", &[0.0, 3.0], "VEC4", &turn);
    let target = json!({"node": 0, "path": "scale"});
    let steps = [1., 1., 1., 2., 2., 2.];
    channel(&mut file, target, "STEP", &[0.0, 2.0], "VEC3", &steps);
    // z = t^3 / 8 from 0 to 2 seconds: its slope there is 1.5 a second.
    let spline = [
        [[0.; 3], [0.; 3], [0.; 3]],
        [[0., 0., 1.5], [0., 0., 1.], [0.; 3]],
    ];
    let target = json!({"node": 0, "path": "translation"});
    let spline = spline.as_flattened().as_flattened();
    channel(
        &mut file,
        target,
        "CUBICSPLINE",
        &[0.0, 2.0],
        "VEC3",
        spline,
    );
    let asset = open(file, AnimationChoice::First);
    // A ninth of a half-turn a second; (1, 0, 0) goes round.
    let (sine, cosine) = (PI / 6.0).sin_cos();
    let moved = Vec3::new(cosine, sine, 0.125);
    assert_near(&vertices_at(&asset, 1.0)[1..2], &[moved]);
    let (sine, cosine) = (PI / 3.0).sin_cos();
    let moved = Vec3::new(2.0 * cosine, 2.0 * sine, 1.0);
    assert_near(&vertices_at(&asset, 2.0)[1..2], &[moved]);
}

#[test]
fn a_moved_camera_and_light_are_where_their_nodes_are() {
    let mut file = moving();
    file.json["cameras"] =
        json!([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}]);
    file.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    file.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [{"type": "point"}]}});
    file.json["nodes"][0]["children"] = json!([1]);
    let light = json!({"KHR_lights_punctual": {"light": 0}});
    let below = json!({"camera": 0, "translation": [0, 0, 5], "extensions": light});
    push(&mut file.json["nodes"], below);
    let (scene, _) = scene_at(&open(file, AnimationChoice::First), 3.0);
    assert_eq!(scene.camera().position.as_vec3(), Vec3::new(4.0, 0.0, 5.0));
    let luch::light::LightKind::Point { position } = scene.lights()[0].kind else {
        panic!("{:?}", scene.lights())
    };
    assert_eq!(position, Vec3::new(4.0, 0.0, 5.0));
}

/// The Khronos tutorial's simple skin: a strip from y = 0 to 2 that bends at a joint at y = 1.
fn simple_skin() -> File {
    let mut file = File::new();
    let rows = [0.0, 0.5, 1.0, 1.5, 2.0];
    let positions: Vec<f32> = rows
        .iter()
        .flat_map(|&y| [-0.5, y, 0., 0.5, y, 0.])
        .collect();
    file.attribute("POSITION", "VEC3", &floats(&positions));
    let triangles = [
        0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4, 4, 5, 7, 4, 7, 6, 6, 7, 9, 6, 9, 8,
    ];
    file.indices(SHORT, &shorts(&triangles));
    let joints = file.accessor(SHORT, "VEC4", &shorts(&[0, 1, 0, 0].repeat(10)));
    file.primitive()["attributes"]["JOINTS_0"] = joints.into();
    let weights: Vec<f32> = rows
        .iter()
        .flat_map(|&y| [1.0 - y / 2.0, y / 2.0, 0., 0.].repeat(2))
        .collect();
    file.attribute("WEIGHTS_0", "VEC4", &floats(&weights));
    let mut binds = [0.0; 32];
    for at in [0, 5, 10, 15, 16, 21, 26, 31] {
        binds[at] = 1.0;
    }
    binds[29] = -1.0;
    let view = file.view(&floats(&binds));
    let accessor = json!({"bufferView": view, "componentType": 5126, "type": "MAT4", "count": 2});
    let accessor = push(&mut file.json["accessors"], accessor);
    file.json["skins"] = json!([{"inverseBindMatrices": accessor, "joints": [1, 2]}]);
    file.json["nodes"] = json!([
        {"skin": 0, "mesh": 0, "translation": [77, 0, 0]},
        {"children": [2]},
        {"translation": [0, 1, 0]},
    ]);
    file.json["scenes"] = json!([{"nodes": [0, 1]}]);
    let half = 0.707;
    let turn = [0., 0., 0., 1., 0., 0., half, half];
    let target = json!({"node": 2, "path": "rotation"});
    channel(&mut file, target, "LINEAR", &[0.0, 1.0], "VEC4", &turn);
    file
}

#[test]
fn the_tutorials_strip_bends_at_its_joint_wherever_its_node_stands() {
    let asset = open(simple_skin(), AnimationChoice::First);
    // A quarter turn about (0, 1) takes (x, y) to (1 - y, 1 + x).
    let bent: Vec<Vec3> = [0.0f32, 0.5, 1.0, 1.5, 2.0]
        .iter()
        .flat_map(|&y| [(-0.5f32, y), (0.5, y)])
        .map(|(x, y)| {
            let share = y / 2.0;
            let turned = Vec3::new(1.0 - y, 1.0 + x, 0.0);
            Vec3::new(x, y, 0.0) * (1.0 - share) + turned * share
        })
        .collect();
    assert_near(&vertices_at(&asset, 1.0), &bent);
    assert!(bent.contains(&Vec3::new(-1.0, 0.5, 0.0)), "{bent:?}");
    let straight = vertices_at(&asset, 0.0);
    assert_near(
        &straight[8..],
        &[Vec3::new(-0.5, 2.0, 0.0), Vec3::new(0.5, 2.0, 0.0)],
    );
    // Without animation the joints are where the file has them: a skin counts in any case.
    assert_eq!(
        vertices_at(&open(simple_skin(), AnimationChoice::None), 0.0),
        straight
    );
}

#[test]
fn a_second_set_of_joints_counts_and_wrong_weights_are_mended() {
    let mut file = simple_skin();
    // The first set in bytes that add up to 1/5, the second with the rest for joint 1.
    let first = file.accessor(BYTE, "VEC4", &[51, 0, 0, 0].repeat(10));
    file.json["accessors"][first]["normalized"] = true.into();
    file.primitive()["attributes"]["WEIGHTS_0"] = first.into();
    let joints = file.accessor(BYTE, "VEC4", &[9, 1, 9, 9].repeat(10));
    file.primitive()["attributes"]["JOINTS_1"] = joints.into();
    let rest: Vec<f32> = [0.0, 0.8, 0.0, 0.0].repeat(9);
    let rest = [rest, vec![-1.0, 0.2, 0.0, 0.0]].concat();
    file.attribute("WEIGHTS_1", "VEC4", &floats(&rest));
    let asset = open(file, AnimationChoice::First);
    let said: Vec<String> = asset.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(
        said,
        [
            "a joint's weight that is negative or no number is taken as 0",
            "the joints' weights of a vertex do not add up to 1 and are scaled"
        ]
    );
    let seen = vertices_at(&asset, 1.0);
    // (-0.5, 0) and (0.5, 2), turned to (1, 0.5) and (-1, 1.5).
    let expected = [Vec3::new(0.7, 0.4, 0.0), Vec3::new(-0.25, 1.75, 0.0)];
    assert_near(&[seen[0], seen[9]], &expected);
}

#[test]
fn a_skin_that_does_not_fit_costs_itself() {
    let unskinned = vertices_at(&open(without_skin(), AnimationChoice::First), 1.0);
    fn without_skin() -> File {
        let mut file = simple_skin();
        file.json["nodes"][0]
            .as_object_mut()
            .map(|n| n.remove("skin"));
        file
    }
    for (pointer, value, warning) in [
        (
            "/skins/0/joints",
            json!([1]),
            "node 0: its mesh names joints that its skin lacks: it stands as its node does",
        ),
        (
            "/skins/0/joints",
            json!([1, 7]),
            "skin 0: joint node 7 does not exist, there are 3: its meshes stand as their nodes do",
        ),
        (
            "/skins/0/joints",
            json!([1, 2, 2]),
            "skin 0: inverse bind matrices: has 2 elements for 3 joints: its meshes stand as their nodes do",
        ),
        (
            "/nodes/0/skin",
            json!(5),
            "node 0: skin 5 does not exist, there are 1: it is ignored",
        ),
        (
            "/meshes/0/primitives/0/attributes/WEIGHTS_0",
            json!(1),
            "mesh \"chair\", primitive 0: WEIGHTS_0: accessor 1: its type is SCALAR, expected VEC4: no joint moves it",
        ),
    ] {
        let mut file = simple_skin();
        if let Some(place) = file.json.pointer_mut(pointer) {
            *place = value;
        }
        let asset = open(file, AnimationChoice::First);
        let said: Vec<String> = asset.warnings.iter().map(ToString::to_string).collect();
        assert_eq!(said.first().map(String::as_str), Some(warning));
        assert_eq!(vertices_at(&asset, 1.0), unskinned, "{warning}");
    }
}

/// The triangle with two morph targets: its last vertex up by 1 in y, its second by 2 in z (sparse, without base).
fn morphing() -> File {
    let mut file = File::triangle();
    let up = [0., 0., 0., 0., 0., 0., 0., 1., 0.];
    let up = file.accessor(super::file::FLOAT, "VEC3", &floats(&up));
    let which = file.view(&shorts(&[1]));
    let what = file.view(&floats(&[0., 0., 2.]));
    let sparse = json!({
        "count": 1,
        "indices": {"bufferView": which, "componentType": SHORT},
        "values": {"bufferView": what},
    });
    let out = json!({"componentType": 5126, "type": "VEC3", "count": 3, "sparse": sparse});
    let out = push(&mut file.json["accessors"], out);
    file.primitive()["targets"] = json!([{"POSITION": up}, {"POSITION": out}]);
    file
}

#[test]
fn weights_are_the_meshs_or_the_nodes_without_any_animation() {
    let mut of_mesh = morphing();
    of_mesh.json["meshes"][0]["weights"] = json!([0.5, 0]);
    let seen = vertices_at(&open(of_mesh, AnimationChoice::None), 0.0);
    assert_eq!(seen, [Vec3::ZERO, Vec3::X, Vec3::Y * 1.5]);
    let mut of_node = morphing();
    of_node.json["meshes"][0]["weights"] = json!([0.5, 0]);
    of_node.json["nodes"] = json!([{"mesh": 0, "weights": [0, 1]}, {"mesh": 0}]);
    of_node.json["scenes"] = json!([{"nodes": [0, 1]}]);
    let seen = vertices_at(&open(of_node, AnimationChoice::None), 0.0);
    assert_eq!(
        seen,
        [
            [Vec3::ZERO, Vec3::new(1.0, 0.0, 2.0), Vec3::Y],
            [Vec3::ZERO, Vec3::X, Vec3::Y * 1.5]
        ]
        .concat()
    );
}

#[test]
fn weights_move_between_keys() {
    let mut file = morphing();
    let target = json!({"node": 0, "path": "weights"});
    let values = [0., 0., 1., 0.5];
    channel(&mut file, target, "LINEAR", &[0.0, 2.0], "SCALAR", &values);
    let asset = open(file, AnimationChoice::First);
    let seen = vertices_at(&asset, 1.0);
    assert_eq!(seen, [Vec3::ZERO, Vec3::new(1.0, 0.0, 0.5), Vec3::Y * 1.5]);
}

#[test]
fn channels_that_cannot_be_followed_move_nothing() {
    for (change, warning) in [
        (
            json!({"input": 0}),
            "its times have 3 numbers each, expected 1",
        ),
        (
            json!({"input": 99}),
            "accessor 99 does not exist, there are 8",
        ),
        (
            json!({"output": 3}),
            "its values have 1 numbers each, expected 3",
        ),
        (json!({"output": 4}), "has 3 values for 2 times, expected 2"),
        (json!({"input": 5}), "its times do not rise"),
        (json!({"input": 6}), "accessor 6: is not of finite numbers"),
        (
            json!({"interpolation": "CUBICSPLINE"}),
            "has 2 values for 2 times, expected 6",
        ),
        (
            json!({"interpolation": "BEZIER"}),
            "its interpolation is unknown",
        ),
        (json!({"input": 7}), "has no keys"),
    ] {
        let mut file = moving();
        let scalar = |file: &mut File, times: &[f32]| {
            file.accessor(super::file::FLOAT, "SCALAR", &floats(times))
        };
        scalar(&mut file, &[0.0, 1.0]);
        file.accessor(super::file::FLOAT, "VEC3", &floats(&[0.0; 9]));
        scalar(&mut file, &[1.0, 0.0]);
        scalar(&mut file, &[0.0, f32::NAN]);
        let empty = scalar(&mut file, &[]);
        assert_eq!(empty, 7);
        let sampler = file.json["animations"][0]["samplers"][0].as_object_mut();
        let change = change.as_object().cloned().unwrap_or_default();
        sampler.expect("a sampler").extend(change);
        let asset = open(file, AnimationChoice::First);
        let said: Vec<String> = asset.warnings.iter().map(ToString::to_string).collect();
        let expected = format!("animation \"run\", channel 0: {warning}: it moves nothing");
        assert_eq!(said, [expected]);
        assert_eq!(vertices_at(&asset, 3.0)[0], Vec3::ZERO);
    }
}

#[test]
fn a_pointer_moves_what_it_leads_to() {
    let mut file = morphing();
    file.json["extensionsUsed"] = json!([
        "KHR_animation_pointer",
        "KHR_lights_punctual",
        "KHR_materials_emissive_strength"
    ]);
    file.json["extensionsRequired"] = json!(["KHR_animation_pointer"]);
    file.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [{"type": "spot"}]}});
    file.json["nodes"][0]["extensions"] = json!({"KHR_lights_punctual": {"light": 0}});
    let strength = json!({"KHR_materials_emissive_strength": {"emissiveStrength": 3}});
    file.json["materials"] = json!([
        {"alphaMode": "MASK", "emissiveFactor": [1, 1, 1], "extensions": strength}
    ]);
    file.primitive()["material"] = 0.into();
    file.json["cameras"] =
        json!([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}]);
    file.json["nodes"][0]["camera"] = 0.into();
    for (path, kind, value) in [
        (
            "/materials/0/pbrMetallicRoughness/baseColorFactor",
            "VEC4",
            &[0.25, 0.5, 0.75, 0.5][..],
        ),
        (
            "/materials/0/pbrMetallicRoughness/roughnessFactor",
            "SCALAR",
            &[0.5],
        ),
        ("/materials/0/emissiveFactor", "VEC3", &[0.5, 0.25, 0.0]),
        ("/materials/0/alphaCutoff", "SCALAR", &[0.125]),
        (
            "/extensions/KHR_lights_punctual/lights/0/intensity",
            "SCALAR",
            &[10.0],
        ),
        (
            "/extensions/KHR_lights_punctual/lights/0/color",
            "VEC3",
            &[1.0, 0.5, 0.0],
        ),
        ("/cameras/0/perspective/yfov", "SCALAR", &[0.5]),
        ("/nodes/0/translation", "VEC3", &[0.0, 0.0, 7.0]),
        ("/meshes/0/weights/1", "SCALAR", &[0.5]),
        (
            "/materials/0/extensions/KHR_materials_ior/ior",
            "SCALAR",
            &[2.0],
        ),
    ] {
        channel(&mut file, pointer(path), "STEP", &[0.0], kind, value);
    }
    let asset = open(file, AnimationChoice::First);
    let said: Vec<String> = asset.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(
        said,
        [
            "animation \"run\", channel 9: moves /materials/0/extensions/KHR_materials_ior/ior, which luch does not: \
          it moves nothing"
        ]
    );
    let (scene, _) = scene_at(&asset, 0.0);
    let material = scene.material(0);
    let Model::MetallicRoughness(shown) = &material.model else {
        panic!("{material:?}")
    };
    let color = shown.base_color.factor;
    assert_eq!(
        [color.r, color.g, color.b, material.alpha.coverage.factor],
        [0.25, 0.5, 0.75, 0.5]
    );
    assert_eq!(shown.roughness, 0.5);
    let emission = material.emission.factor;
    assert_eq!([emission.r, emission.g, emission.b], [1.5, 0.75, 0.0]);
    assert_eq!(
        material.alpha.mode,
        luch::material::AlphaMode::Mask { cutoff: 0.125 }
    );
    let light = &scene.lights()[0];
    assert_eq!((light.intensity, light.color.g), (10.0 / PI, 0.5));
    assert_eq!(
        scene.camera().projection,
        luch::camera::Projection::Perspective {
            fov: luch::camera::Fov::Y(0.5)
        }
    );
    assert_eq!(scene.camera().position.as_vec3(), Vec3::Z * 7.0);
    let expected = [
        Vec3::Z * 7.0,
        Vec3::new(1.0, 0.0, 8.0),
        Vec3::new(0.0, 1.0, 7.0),
    ];
    assert_eq!(vertices_at(&asset, 0.0), expected);
}

#[test]
fn a_moved_texture_keeps_the_parts_of_its_transform_that_do_not_move() {
    let mut file = File::triangle();
    file.attribute("TEXCOORD_0", "VEC2", &floats(&[0.; 6]));
    // 1 x 1, grey.
    let image = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==";
    file.json["images"] = json!([{"uri": image}]);
    file.json["textures"] = json!([{"source": 0}]);
    let transform = json!({"KHR_texture_transform": {"scale": [2, 3]}});
    let texture = json!({"index": 0, "extensions": transform});
    file.json["materials"] = json!([{"pbrMetallicRoughness": {"baseColorTexture": texture}}]);
    file.primitive()["material"] = 0.into();
    let at = "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform";
    let offset = pointer(&format!("{at}/offset"));
    channel(
        &mut file,
        offset,
        "LINEAR",
        &[0.0, 2.0],
        "VEC2",
        &[0., 0., 1., 4.],
    );
    let rotation = pointer(&format!("{at}/rotation"));
    channel(&mut file, rotation, "STEP", &[0.0], "SCALAR", &[PI / 2.0]);
    let (scene, _) = scene_at(&open(file, AnimationChoice::First), 1.0);
    let Model::MetallicRoughness(shown) = &scene.material(0).model else {
        panic!("{:?}", scene.material(0))
    };
    let used = shown.base_color.texture.as_ref().expect("a texture");
    let carried = used.transform.expect("a transform") * Vec3::new(1.0, 1.0, 1.0);
    // The extension's own shader: offset + rotate(scale * uv), where a quarter turn takes (u, v) to (v, -u).
    assert!(
        (carried - Vec3::new(0.5 + 3.0, 2.0 - 2.0, 1.0)).length() < 1e-5,
        "{carried}"
    );
}

#[test]
fn what_is_hidden_is_not_seen_nor_what_is_below_it_but_its_camera_sees() {
    let hidden = |visible: bool| json!({"KHR_node_visibility": {"visible": visible}});
    let nodes = json!([
        {"mesh": 0},
        {"mesh": 0, "translation": [10, 0, 0], "extensions": hidden(false), "children": [2]},
        {"mesh": 0, "extensions": hidden(true), "camera": 0},
    ]);
    let file = || {
        let mut file = File::triangle();
        file.json["extensionsUsed"] = json!(["KHR_node_visibility", "KHR_animation_pointer"]);
        file.json["nodes"] = nodes.clone();
        file.json["scenes"] = json!([{"nodes": [0, 1]}]);
        file.json["cameras"] =
            json!([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}]);
        let output = file.accessor(BYTE, "SCALAR", &[1, 0]);
        let target = pointer("/nodes/1/extensions/KHR_node_visibility/visible");
        channel(&mut file, target, "STEP", &[0.0, 1.0], "SCALAR", &[0.0; 2]);
        file.json["animations"][0]["samplers"][0]["output"] = output.into();
        file
    };
    let unmoved = open(file(), AnimationChoice::None);
    assert_eq!(vertices_at(&unmoved, 0.0).len(), 3);
    let (scene, _) = scene_at(&unmoved, 0.0);
    assert_eq!(scene.camera().position.x, 10.0);
    let moved = open(file(), AnimationChoice::All);
    assert_eq!(vertices_at(&moved, 0.5).len(), 9);
    assert_eq!(vertices_at(&moved, 1.0).len(), 3);
    assert_eq!(warnings(&moved.models[0].model), Vec::<String>::new());
}

#[test]
fn what_goes_to_no_place_is_left_out_with_a_line() {
    let mut file = File::triangle();
    file.json["nodes"] = json!([{"children": [1]}, {"mesh": 0}, {"mesh": 0}]);
    file.json["scenes"] = json!([{"nodes": [0, 2]}]);
    for node in [0, 1] {
        let target = json!({"node": node, "path": "scale"});
        let values = [1., 1., 1., 1e30, 1., 1.];
        channel(&mut file, target, "STEP", &[0.0, 1.0], "VEC3", &values);
    }
    let asset = open(file, AnimationChoice::First);
    let said = |time: f64| {
        let (scene, choices) = scene_at(&asset, time);
        let lines = choices.lines.into_iter();
        let lines: Vec<String> = lines.filter(|line| line.starts_with("pose")).collect();
        (scene.instances().len(), lines)
    };
    assert_eq!(said(0.0), (2, vec![]));
    let line = "pose: 1 node is left out, whose place is not of finite numbers then";
    assert_eq!(said(1.0), (1, vec![line.to_owned()]));
}
