//! What a description must be before it is a scene.

use super::{InstanceSpace, PlacedInstance, SceneDescription, SceneError};
use crate::camera::{Camera, Fov, Projection};
use crate::color::Rgb;
use crate::light::{Light, LightKind};
use crate::material::{Material, Model};
use crate::mesh::Mesh;
use crate::texture::{Pixels, Texture};
use glam::Vec3;
use std::f32::consts::FRAC_PI_2;
use std::f64::consts::PI;

/// The first thing that is wrong with a description.
pub(super) fn check(scene: &SceneDescription) -> Result<(), SceneError> {
    check_camera(&scene.camera)?;
    check_color(|| "background".into(), "color", scene.background.color)?;
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

/// Huge but finite positions can leave the range of numbers on their way into the world.
pub(super) fn check_placed(
    meshes: &[Mesh],
    instances: &[PlacedInstance],
) -> Result<(), SceneError> {
    for (i, instance) in instances.iter().enumerate() {
        let fits = match &instance.space {
            Some(InstanceSpace { bounds, .. }) => bounds.is_empty() || bounds.extent().is_finite(),
            None => meshes[instance.mesh as usize]
                .positions
                .iter()
                .all(|p| p.is_finite()),
        };
        if !fits {
            let what = named("instance", i, &instance.name);
            return Err(SceneError::NotFinite {
                what,
                field: "its positions in the world",
            });
        }
    }
    Ok(())
}

fn check_camera(camera: &Camera) -> Result<(), SceneError> {
    let what = || "camera".to_owned();
    finite(what, "position", camera.position.as_vec3().to_array())?;
    finite(what, "look_at", camera.look_at.as_vec3().to_array())?;
    direction(what, "up", camera.up.as_vec3())?;
    if camera.position == camera.look_at {
        return Err(SceneError::LooksNowhere);
    }
    let angle = |field, fov: f64| {
        let expected = "an angle above 0 and below 180 degrees";
        in_range(what, field, fov as f32, fov > 0.0 && fov < PI, expected)
    };
    match camera.projection {
        Projection::Perspective { fov: Fov::X(x) } => angle("fov_x", x)?,
        Projection::Perspective { fov: Fov::Y(y) } => angle("fov_y", y)?,
        Projection::Perspective {
            fov: Fov::Both(x, y),
        } => angle("fov_x", x).and(angle("fov_y", y))?,
        Projection::Orthographic {
            half_width,
            half_height,
        } => {
            above_zero(what, "half width", half_width.unwrap_or(1.0))?;
            above_zero(what, "half height", half_height)?;
        }
    }
    let (near, far) = (camera.near, camera.far);
    in_range(
        what,
        "near",
        near,
        near >= 0.0 && near.is_finite(),
        "a finite distance, 0 or more",
    )?;
    in_range(what, "far", far, far > near, "a distance above near")
}

fn check_texture(texture: &Texture) -> Result<(), SceneError> {
    let image = &texture.image;
    let found = match &image.pixels {
        Pixels::Eight(pixels) => pixels.len(),
        Pixels::Sixteen(pixels) => pixels.len(),
    };
    let expected = image.width as usize * image.height as usize;
    if found != expected || found == 0 {
        let expected = format!("{} x {} pixels", image.width, image.height);
        return Err(SceneError::LengthMismatch {
            what: image.name.clone(),
            field: "pixels",
            found,
            expected,
        });
    }
    Ok(())
}

fn check_material(
    material: &Material,
    what: impl Fn() -> String + Copy,
    textures: usize,
) -> Result<(), SceneError> {
    let share = |field, value| {
        in_range(
            what,
            field,
            value,
            (0.0..=1.0).contains(&value),
            "a share from 0 to 1",
        )
    };
    check_color(what, "emission", material.emission.factor)?;
    in_range(
        what,
        "alpha",
        material.alpha.coverage.factor,
        material.alpha.coverage.factor.is_finite(),
        "a number",
    )?;
    match &material.model {
        Model::Phong(phong) => {
            check_color(what, "diffuse", phong.diffuse.factor)?;
            check_color(what, "specular", phong.specular.factor)?;
            let s = phong.shininess;
            in_range(
                what,
                "shininess",
                s,
                s >= 0.0 && s.is_finite(),
                "a finite number, 0 or more",
            )?;
            <[f32; 3]>::from(phong.reflectivity)
                .into_iter()
                .try_for_each(|channel| share("reflectivity", channel))?;
            if let Some(checker) = &phong.checker {
                check_color(what, "checker color", checker.color)?;
                above_zero(what, "checker size", checker.size)?;
            }
        }
        Model::MetallicRoughness(m) => {
            check_color(what, "base color", m.base_color.factor)?;
            share("metallic", m.metallic)?;
            share("roughness", m.roughness)?;
            share("occlusion strength", m.occlusion.factor)?;
        }
        Model::Unlit { color } => check_color(what, "color", color.factor)?,
    }
    if let Some(map) = &material.normal_map {
        finite(what, "normal scale", [map.scale; 3])?;
    }
    material
        .textures()
        .try_for_each(|used| index(what, "texture", used.texture, textures))
}

fn check_light(light: &Light, what: impl Fn() -> String + Copy) -> Result<(), SceneError> {
    check_color(what, "color", light.color)?;
    let intensity = light.intensity;
    in_range(
        what,
        "intensity",
        intensity,
        intensity >= 0.0 && intensity.is_finite(),
        "a finite number, 0 or more",
    )?;
    if let Some(range) = light.range {
        above_zero(what, "range", range)?;
    }
    match light.kind {
        LightKind::Point { position } => finite(what, "position", position.to_array()),
        LightKind::Directional { direction: d } => direction(what, "direction", d),
        LightKind::Spot {
            position,
            direction: d,
            inner_angle,
            outer_angle,
        } => {
            finite(what, "position", position.to_array())?;
            direction(what, "direction", d)?;
            let outer_fits = outer_angle > 0.0 && outer_angle <= FRAC_PI_2;
            in_range(
                what,
                "outer_angle",
                outer_angle,
                outer_fits,
                "a half-angle above 0, at most 90 degrees",
            )?;
            let inner_fits = (0.0..outer_angle).contains(&inner_angle);
            in_range(
                what,
                "inner_angle",
                inner_angle,
                inner_fits,
                "0 or more, less than outer_angle",
            )
        }
    }
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

/// `sphere 3`, or `sphere 3 "moon"`; counted from 1.
fn named(kind: &str, position: usize, name: &str) -> String {
    let number = position + 1;
    if name.is_empty() {
        format!("{kind} {number}")
    } else {
        format!("{kind} {number} \"{name}\"")
    }
}

fn finite<const N: usize>(
    what: impl Fn() -> String,
    field: &'static str,
    numbers: [f32; N],
) -> Result<(), SceneError> {
    if numbers.iter().all(|n| n.is_finite()) {
        Ok(())
    } else {
        Err(SceneError::NotFinite {
            what: what(),
            field,
        })
    }
}

fn check_color(
    what: impl Fn() -> String,
    field: &'static str,
    color: Rgb,
) -> Result<(), SceneError> {
    let negative = <[f32; 3]>::from(color)
        .into_iter()
        .find(|&channel| channel < 0.0);
    in_range(
        &what,
        field,
        negative.unwrap_or(0.0),
        negative.is_none(),
        "0 or more in every channel",
    )?;
    finite(what, field, color.into())
}

fn direction(what: impl Fn() -> String, field: &'static str, v: Vec3) -> Result<(), SceneError> {
    finite(&what, field, v.to_array())?;
    if v == Vec3::ZERO {
        Err(SceneError::NoLength {
            what: what(),
            field,
        })
    } else {
        Ok(())
    }
}

fn above_zero(
    what: impl Fn() -> String,
    field: &'static str,
    found: f32,
) -> Result<(), SceneError> {
    in_range(
        what,
        field,
        found,
        found > 0.0 && found.is_finite(),
        "a finite number above 0",
    )
}

fn in_range(
    what: impl Fn() -> String,
    field: &'static str,
    found: f32,
    fits: bool,
    expected: &'static str,
) -> Result<(), SceneError> {
    if fits {
        Ok(())
    } else {
        Err(SceneError::OutOfRange {
            what: what(),
            field,
            found,
            expected,
        })
    }
}

fn index(
    what: impl Fn() -> String,
    field: &'static str,
    index: u32,
    count: usize,
) -> Result<(), SceneError> {
    let index = index as usize;
    if index < count {
        Ok(())
    } else {
        Err(SceneError::NoSuch {
            what: what(),
            field,
            index,
            count,
        })
    }
}
