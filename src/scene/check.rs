//! What a description must be before it is a scene.

mod fields;
mod finish;
mod things;

use super::{GROUND, Ground, InstanceSpace, PlacedInstance, SceneDescription, SceneError};
use crate::material::Model;
use crate::mesh::Mesh;
use fields::{above_zero, check_color, direction, finite, in_range, index, named};
pub(super) use things::check_camera;
use things::{check_light, check_material, check_texture};

/// The first thing that is wrong with a description.
pub(super) fn check(scene: &SceneDescription) -> Result<(), SceneError> {
    check_color(|| "background".into(), "color", scene.background.color)?;
    if let Some(top) = scene.background.top {
        check_color(|| "background".into(), "top", top)?;
    }
    if let Some(ground) = &scene.ground {
        check_ground(ground)?;
    }
    check_color(|| "ambient".into(), "color", scene.ambient)?;
    for texture in &scene.textures {
        check_texture(texture)?;
    }
    for (i, material) in scene.materials.iter().enumerate() {
        check_material(
            material,
            || named("material", i, &material.name),
            scene.textures.len(),
        )?;
    }
    for (i, light) in scene.lights.iter().enumerate() {
        check_light(light, || named("light", i, &light.name))?;
    }
    for (i, sphere) in scene.spheres.iter().enumerate() {
        let what = || named("sphere", i, &sphere.name);
        finite(what, "center", sphere.shape.center.to_array())?;
        above_zero(what, "radius", sphere.shape.radius)?;
        check_material_index(scene, what, sphere.material, false)?;
    }
    for (i, plane) in scene.planes.iter().enumerate() {
        let what = || named("plane", i, &plane.name);
        finite(what, "point", plane.shape.point.to_array())?;
        direction(what, "normal", plane.shape.normal)?;
        check_material_index(scene, what, plane.material, true)?;
    }
    for (i, mesh) in scene.meshes.iter().enumerate() {
        check_mesh(mesh, || named("mesh", i, &mesh.name))?;
    }
    for (i, instance) in scene.instances.iter().enumerate() {
        let what = || named("instance", i, &instance.name);
        index(what, "mesh", instance.mesh, scene.meshes.len())?;
        check_material_index(scene, what, instance.material, false)?;
        if !instance.to_world.is_finite() {
            return Err(SceneError::NotFinite {
                what: what(),
                field: "its transform's elements",
            });
        }
    }
    Ok(())
}

fn check_ground(ground: &Ground) -> Result<(), SceneError> {
    let what = || GROUND.to_owned();
    finite(what, "center", ground.center.to_array())?;
    above_zero(what, "radius", ground.radius)?;
    let reflectivity = ground.reflectivity;
    let fits = (0.0..=1.0).contains(&reflectivity);
    in_range(
        what,
        "reflectivity",
        reflectivity,
        fits,
        "a share from 0 to 1",
    )
}

/// The farthest from the origin that a mesh may reach: squares of larger numbers, and their products with a picture's
/// width, leave 32 bits.
const FARTHEST: f32 = 1e15;

/// Huge but finite positions can leave the range of numbers on their way into the world.
pub(super) fn check_placed(
    meshes: &[Mesh],
    instances: &[PlacedInstance],
) -> Result<(), SceneError> {
    for (i, instance) in instances.iter().enumerate() {
        let reach = match &instance.space {
            Some(InstanceSpace { bounds, .. }) => bounds.extent(),
            None => meshes[instance.mesh as usize].reach(),
        };
        // False for NaN, too.
        let fits = reach <= FARTHEST;
        if !fits {
            let what = named("instance", i, &instance.name);
            return Err(SceneError::TooFar { what, reach });
        }
    }
    Ok(())
}

fn check_mesh(mesh: &Mesh, what: impl Fn() -> String + Copy) -> Result<(), SceneError> {
    let count = mesh.positions.len();
    if !mesh.positions.iter().all(|p| p.is_finite()) {
        return Err(SceneError::NotFinite {
            what: what(),
            field: "positions",
        });
    }
    let lists = [
        ("normals", mesh.normals.len()),
        ("tangents", mesh.tangents.len()),
        ("texture coordinates", mesh.uvs[0].len()),
        ("second texture coordinates", mesh.uvs[1].len()),
        ("colors", mesh.colors.len()),
    ];
    for (field, found) in lists {
        if found != 0 && found != count {
            let expected = format!("{count} positions");
            return Err(SceneError::LengthMismatch {
                what: what(),
                field,
                found,
                expected,
            });
        }
    }
    mesh.triangles
        .iter()
        .flatten()
        .try_for_each(|&vertex| index(what, "vertex", vertex, count))
}

fn check_material_index(
    scene: &SceneDescription,
    what: impl Fn() -> String,
    material: u32,
    is_plane: bool,
) -> Result<(), SceneError> {
    let Some(found) = scene.materials.get(material as usize) else {
        return index(what, "material", material, scene.materials.len());
    };
    match &found.model {
        Model::Phong(phong) if phong.checker.is_some() && !is_plane => {
            Err(SceneError::CheckerNotOnPlane {
                what: what(),
                material: found.name.clone(),
            })
        }
        _ => Ok(()),
    }
}
