//! A node's mesh many times: EXT_mesh_gpu_instancing.

use super::file::{FLOAT, File, floats, warnings};
use glam::DVec3;
use serde_json::json;

const NAME: &str = "EXT_mesh_gpu_instancing";

fn instanced(translations: &[f32], rotations: &[f32]) -> File {
    let mut file = File::triangle();
    let translation = file.accessor(FLOAT, "VEC3", &floats(translations));
    let rotation = file.accessor(FLOAT, "VEC4", &floats(rotations));
    file.json["nodes"][0]["translation"] = json!([0.0, 0.0, 5.0]);
    file.json["nodes"][0]["extensions"][NAME] =
        json!({"attributes": {"TRANSLATION": translation, "ROTATION": rotation}});
    file.json["extensionsRequired"] = json!([NAME]);
    file
}

#[test]
fn each_instance_stands_in_the_space_of_its_node() {
    // The second is turned by a right angle about z.
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let model = instanced(
        &[1., 0., 0., 0., 2., 0.],
        &[0., 0., 0., 1., 0., 0., half, half],
    )
    .model();
    let places: Vec<_> = model
        .placed_nodes()
        .into_iter()
        .flat_map(|(node, to_model)| node.places(to_model).collect::<Vec<_>>())
        .collect();
    let shown: Vec<DVec3> = places
        .iter()
        .map(|place| place.transform_point3(DVec3::X))
        .collect();
    assert_eq!(shown[0], DVec3::new(2.0, 0.0, 5.0));
    assert!(
        shown[1].distance(DVec3::new(0.0, 3.0, 5.0)) < 1e-6,
        "{}",
        shown[1]
    );
    assert_eq!((places.len(), model.meshes.len()), (2, 1));
}

#[test]
fn instances_that_differ_in_number_or_are_too_many_are_refused() {
    let prefix = "model.gltf: node 0, EXT_mesh_gpu_instancing: ";
    let file = instanced(&[1., 0., 0.], &[0., 0., 0., 1., 0., 0., 0., 1.]);
    assert_eq!(
        file.open().err(),
        Some(format!("{prefix}has attributes of 1 and of 2 instances"))
    );
    let mut file = File::triangle();
    file.json["accessors"] = json!([file.json["accessors"][0],
        {"componentType": FLOAT, "type": "VEC3", "count": 60_000}]);
    let instances = json!({NAME: {"attributes": {"SCALE": 1}}});
    file.json["nodes"] = json!([
        {"mesh": 0, "extensions": instances},
        {"mesh": 0, "extensions": instances},
    ]);
    assert_eq!(
        file.open().err(),
        Some(
            "model.gltf: node 1, EXT_mesh_gpu_instancing: 60000 instances of 1 parts are many times \
             what the buffers hold"
                .into()
        )
    );
}

#[test]
fn an_instance_at_no_place_is_left_out() {
    let rotations = [0., 0., 0., 1., 0., 0., 0., 0.];
    let model = instanced(&[f32::NAN, 0., 0., 0., 2., 0.], &rotations).model();
    assert_eq!(model.nodes[0].instances.as_ref().map(Vec::len), Some(1));
    assert_eq!(
        warnings(&model),
        ["an instance whose transform is not of finite numbers is not drawn"]
    );
}
