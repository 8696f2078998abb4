//! Models are handed in, so that these tests need no files; tests/load_scene_file.rs has the rest.

use super::*;
use crate::camera::{Fov, Projection};
use crate::load::{ModelCamera, Node};
use glam::{DQuat, DVec3};

const MATERIALS: &str = "[[material]]\nname = \"red\"\n";

fn scene(text: &str) -> Result<Asset, String> {
    scene_with(text, Model::default())
}

fn scene_with(text: &str, model: Model) -> Result<Asset, String> {
    let open = |path: &Path| {
        let model = Model {
            file: path.to_owned(),
            files: vec![path.to_owned()],
            ..model.clone()
        };
        is_obj(path).then_some(Ok(model))
    };
    parse_with(
        text,
        Path::new("there/scene.toml"),
        &Budget::default(),
        open,
    )
    .map_err(|error| error.to_string())
}

fn is_obj(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "obj")
}

fn error(text: &str) -> String {
    scene(text).err().unwrap_or_default()
}

fn with_camera() -> Model {
    let mut model = Model::default();
    let fov = Fov::Y(1.0);
    model.cameras.push(ModelCamera {
        name: "Camera.001".into(),
        projection: Projection::Perspective { fov },
        near: 0.1,
        far: 10.0,
    });
    model.nodes.push(Node {
        name: "Front".into(),
        camera: Some(0),
        ..Node::default()
    });
    model.roots.push(0);
    model.warnings.add("has a flaw");
    model
}

#[test]
fn a_model_stands_where_its_file_has_it_unless_told_otherwise() {
    let asset = scene("[[model]]\npath = \"a.obj\"");
    let placed = asset.map(|asset| (asset.models[0].to_world, asset.models[0].material));
    assert_eq!(placed, Ok((glam::DAffine3::IDENTITY, None)));
}

#[test]
fn a_model_is_scaled_then_turned_then_moved() {
    let text = format!(
        "{MATERIALS}[[model]]\npath = \"a.obj\"\nmaterial = \"red\"\n\
         translation = [1, 2, 3]\nrotation = [0, 2, 0, 2]\nscale = [2, 3, -4]"
    );
    let placed = scene(&text).map(|asset| asset.models[0].clone());
    let expected = DVec3::new(1.0, 2.0, 3.0)
        + DQuat::from_xyzw(0.0, 0.5f64.sqrt(), 0.0, 0.5f64.sqrt()) * DVec3::new(2.0, 3.0, -4.0);
    let corner = placed
        .as_ref()
        .map(|p| p.to_world.transform_point3(DVec3::ONE));
    assert!(corner.is_ok_and(|corner| (corner - expected).length() < 1e-12));
    assert_eq!(placed.map(|p| p.material), Ok(Some(0)));
}

#[test]
fn one_number_scales_along_all_axes() {
    let asset = scene("[[model]]\npath = \"a.obj\"\nscale = 2");
    let scale = asset.map(|asset| asset.models[0].to_world.matrix3 * DVec3::ONE);
    assert_eq!(scale, Ok(DVec3::splat(2.0)));
}

#[test]
fn paths_start_in_the_folder_of_the_scene_file() {
    let text = "[[model]]\npath = \"../models/a.obj\"\n[[model]]\npath = \"/b.obj\"";
    let files = scene(text).map(|asset| asset.files);
    let expected = ["there/../models/a.obj", "/b.obj"].map(Into::into);
    assert_eq!(files, Ok(expected.to_vec()));
}

#[test]
fn a_model_placed_twice_is_read_once_and_warns_once() {
    let text = "[[model]]\npath = \"a.obj\"\n[[model]]\npath = \"a.obj\"\nscale = 2";
    let asset = scene_with(text, with_camera());
    let warnings = asset
        .as_ref()
        .map(|asset| asset.warnings.iter().map(ToString::to_string).collect());
    assert_eq!(warnings, Ok(vec!["a.obj: has a flaw".to_owned()]));
    assert_eq!(
        asset.map(|asset| (asset.models.len(), asset.files.len())),
        Ok((2, 1))
    );
}

#[test]
fn an_error_of_a_model_is_the_scene_files_own() {
    let open = |path: &Path| Some(Err(Error::malformed(path, "line 3", "is odd")));
    let result = parse_with(
        "[[model]]\npath = \"a.obj\"",
        Path::new("there/scene.toml"),
        &Budget::default(),
        open,
    );
    assert_eq!(
        result.err().map(|error| error.to_string()),
        Some("there/a.obj: line 3: is odd".into())
    );
}

#[test]
fn a_model_can_be_all_there_is_and_is_framed_later() {
    let asset = scene("[[model]]\npath = \"a.obj\"");
    assert_eq!(asset.map(|asset| asset.camera), Ok(None));
}

#[test]
fn a_models_camera_goes_by_its_own_name_or_its_nodes() {
    for name in ["Camera.001", "Front"] {
        let text = format!("[camera]\nmodel_camera = \"{name}\"\n[[model]]\npath = \"a.obj\"");
        let camera = scene_with(&text, with_camera()).map(|asset| asset.camera);
        assert_eq!(camera, Ok(Some(CameraSource::OfModel(name.into()))));
    }
}

#[test]
fn a_models_camera_must_be_there() {
    let text = "[camera]\nmodel_camera = \"Frond\"\n[[model]]\npath = \"a.obj\"";
    assert_eq!(
        scene_with(text, with_camera()).err(),
        Some(
            "there/scene.toml: line 2: no model has a camera named \"Frond\"; did you mean \"Front\"?"
                .into()
        )
    );
    assert_eq!(
        error(text),
        "there/scene.toml: line 2: no model has a camera named \"Frond\""
    );
}

#[test]
fn wrong_models_are_told_by_line() {
    let start = "[[model]]\npath = \"a.obj\"\n";
    for (wrong, message) in [
        (
            "rotation = [0, 0, 0, 0]",
            "line 3: rotation in [[model]] is [0, 0, 0, 0], expected a quaternion of four finite numbers, [x, y, z, w], that are not all 0",
        ),
        (
            "rotation = [0, 0, 1]",
            "line 3: rotation in [[model]] is [0, 0, 1], expected a quaternion of four finite numbers, [x, y, z, w], that are not all 0",
        ),
        (
            "scale = 0",
            "line 3: scale in [[model]] is 0, expected a finite number or three, [x, y, z], none of them 0, which would make a singular matrix",
        ),
        (
            "scale = [1, 0.0, 1]",
            "line 3: scale in [[model]] is [1, 0.0, 1], expected a finite number or three, [x, y, z], none of them 0, which would make a singular matrix",
        ),
        (
            "translation = [0, nan, 0]",
            "line 3: translation in [[model]] is [0, nan, 0], expected three finite numbers, [x, y, z]",
        ),
        (
            "material = \"red\"",
            "line 3: no material is named \"red\"; write a [[material]] with that name",
        ),
        (
            "translate = [0, 0, 0]",
            "line 3: unknown key \"translate\" in [[model]]; did you mean \"translation\"?",
        ),
        (
            "[[model]]",
            "line 3: [[model]] has no path, expected a text in quotes",
        ),
        (
            "[[model]]\npath = \"a.blend\"",
            "line 4: path in [[model]] is \"a.blend\", expected a name that ends in .gltf, .glb or .obj",
        ),
        (
            "[[model]]\npath = \"\"",
            "line 4: path in [[model]] is \"\", expected a name that ends in .gltf, .glb or .obj",
        ),
        (
            "material = \"board\"\n[[material]]\nname = \"board\"\nchecker = { color = [0, 0, 0], size = 1 }",
            "line 3: material \"board\" has a checker, which only planes can have; name another",
        ),
    ] {
        assert_eq!(
            error(&format!("{start}{wrong}")),
            format!("there/scene.toml: {message}")
        );
    }
}

#[test]
fn the_mixed_scene_is_read_around_its_model() {
    let asset = scene(include_str!("../../../assets/scenes/mixed.toml"));
    let files = asset.as_ref().map(|asset| asset.files.clone());
    assert_eq!(files, Ok(vec!["there/../models/knot.obj".into()]));
    let counts = asset.map(|asset| {
        assert!(asset.models[0].material.is_some());
        (asset.spheres.len(), asset.planes.len(), asset.lights.len())
    });
    assert_eq!(counts, Ok((2, 1, 2)));
}
