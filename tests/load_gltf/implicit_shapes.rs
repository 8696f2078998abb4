//! KHR_implicit_shapes: what nodes show of it.

use super::file::{File, warnings};
use crate::common::picture;
use glam::Vec3;
use luch::load::{Asset, Model};
use luch::scene::Scene;
use serde_json::{Value, json};

/// A file of these shapes and nodes, with one material.
fn file(shapes: Value, nodes: Value) -> File {
    let mut file = File::triangle();
    let all: Vec<usize> = (0..nodes.as_array().map_or(0, Vec::len)).collect();
    file.json["nodes"] = nodes;
    file.json["scenes"] = json!([{"nodes": all}]);
    file.json["materials"] = json!([{"name": "red"}]);
    file.json["extensionsUsed"] = json!(["KHR_implicit_shapes"]);
    file.json["extensions"] = json!({"KHR_implicit_shapes": {"shapes": shapes}});
    file
}

fn uses(shape: usize) -> Value {
    json!({"KHR_implicit_shapes": {"shape": shape, "material": 0}})
}

fn scene(model: &Model) -> Scene {
    let viewpoint = picture::viewpoint(1.0);
    let (scene, _) = Asset::from(model.clone())
        .scene(0.0, &viewpoint)
        .expect("a scene");
    scene
}

#[test]
fn spheres_and_planes_are_analytic_where_their_nodes_put_them() {
    let shapes = json!([
        {"type": "sphere", "sphere": {"radius": 0.25}},
        {"type": "plane", "plane": {}},
        {"type": "sphere"},
    ]);
    let half = 0.5f32.sqrt();
    let nodes = json!([
        {"extensions": uses(0), "translation": [1, 2, 3], "scale": [2, 2, 2]},
        // A quarter turn about z takes +y to -x.
        {"extensions": uses(1), "translation": [5, 0, 0], "rotation": [0, 0, half, half]},
        {"extensions": {"KHR_implicit_shapes": {"shape": 2}}},
    ]);
    let model = file(shapes, nodes).model();
    assert_eq!(warnings(&model), [""; 0]);
    let scene = scene(&model);
    let [first, second] = scene.spheres() else {
        panic!("{:?}", scene.spheres());
    };
    assert_eq!(
        (first.shape.center, first.shape.radius),
        (Vec3::new(1.0, 2.0, 3.0), 0.5)
    );
    assert_eq!(second.shape.radius, 0.5, "the schema's default");
    assert_eq!(scene.material(first.material).name, "red");
    let plane = &scene.planes()[0].shape;
    assert!((plane.normal - Vec3::NEG_X).length() < 1e-6 && plane.point == Vec3::X * 5.0);
}

#[test]
fn what_a_sphere_or_an_endless_plane_cannot_be_is_triangles() {
    let shapes = json!([
        {"type": "sphere", "sphere": {"radius": 1}},
        {"type": "plane", "plane": {"sizeX": 4, "sizeZ": 2, "doubleSided": true}},
    ]);
    let nodes = json!([
        {"extensions": uses(0), "scale": [1, 2, 1]},
        {"extensions": uses(1), "translation": [0, 7, 0]},
    ]);
    let scene = scene(&file(shapes, nodes).model());
    assert_eq!((scene.spheres().len(), scene.planes().len()), (0, 0));
    let bounds = scene.bounds();
    assert_eq!(bounds.max, Vec3::new(2.0, 7.0, 1.0));
    assert!((bounds.min.y + 2.0).abs() < 0.01);
    let material = scene.instances()[1].material;
    assert!(scene.material(material).double_sided && !scene.material(0).double_sided);
}

#[test]
fn what_cannot_be_drawn_is_left_out_with_a_warning() {
    let shapes = json!([
        {"type": "box"},
        {"type": "sphere", "sphere": {"radius": -1}},
        {"type": "plane", "plane": {"sizeX": 1}},
        {"sphere": {}},
    ]);
    let nodes = json!([{"mesh": 0}, {"extensions": uses(0)}, {"extensions": uses(1)}]);
    let model = file(shapes, nodes).model();
    assert_eq!(
        warnings(&model),
        [
            "KHR_implicit_shapes, shape 0: a box is no shape that luch draws: it is left out",
            "KHR_implicit_shapes, shape 1: its radius is -1, expected a number above 0: it is left out",
            "KHR_implicit_shapes, shape 2: it is endless to one side only, which is not supported: it is left out",
            "KHR_implicit_shapes, shape 3: missing field `type`: it is left out",
        ]
    );
    let nodes = json!([{"mesh": 0}, {"extensions": uses(4)}]);
    assert_eq!(
        file(json!([]), nodes).open().err().as_deref(),
        Some("model.gltf: node 1: implicit shape 4 does not exist, there are 0")
    );
}

#[test]
fn colliders_are_shown_where_there_is_nothing_else() {
    let shapes = json!([{"type": "sphere"}]);
    let collider = json!({"KHR_physics_rigid_bodies": {"collider": {"geometry": {"shape": 0}}}});
    let mut alone = file(shapes.clone(), json!([{"extensions": collider}]));
    alone.json.as_object_mut().map(|root| root.remove("meshes"));
    let model = alone.model();
    assert_eq!(scene(&model).spheres().len(), 1);
    assert!(warnings(&model).contains(&"shows colliders, since it has no mesh to show".to_owned()));
    let beside = file(shapes, json!([{"mesh": 0}, {"extensions": collider}]));
    assert_eq!(scene(&beside.model()).spheres().len(), 0);
}
