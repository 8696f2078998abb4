//! What cameras, textures, materials and lights must be.

use super::fields::{above_zero, check_color, direction, finite, in_range, index};
use super::finish::check_finish;
use crate::camera::{Camera, Fov, Projection};
use crate::light::{Light, LightKind};
use crate::material::{Material, Model, Transmission};
use crate::scene::SceneError;
use crate::texture::{Pixels, Texture};
use std::f32::consts::FRAC_PI_2;
use std::f64::consts::PI;

pub(in crate::scene) fn check_camera(camera: &Camera) -> Result<(), SceneError> {
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

pub(super) fn check_texture(texture: &Texture) -> Result<(), SceneError> {
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

pub(super) fn check_material(
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
            if let Some(finish) = &m.finish {
                check_finish(finish, what)?;
            }
        }
        Model::SpecularGlossiness(m) => {
            check_color(what, "diffuse", m.diffuse.factor)?;
            check_color(what, "specular", m.specular.factor)?;
            share("glossiness", m.glossiness)?;
            share("occlusion strength", m.occlusion.factor)?;
        }
        Model::Unlit { color } => check_color(what, "color", color.factor)?,
    }
    if let Some(transmission) = &material.transmission {
        check_transmission(transmission, what)?;
    }
    if let Some(map) = &material.normal_map {
        finite(what, "normal scale", [map.scale; 3])?;
    }
    material
        .textures()
        .try_for_each(|used| index(what, "texture", used.texture, textures))
}

fn check_transmission(
    transmission: &Transmission,
    what: impl Fn() -> String + Copy,
) -> Result<(), SceneError> {
    let at_least_zero = |field, found: f32| {
        let fits = found >= 0.0 && found.is_finite();
        in_range(what, field, found, fits, "a finite number, 0 or more")
    };
    let share = |field, found: f32| {
        let fits = (0.0..=1.0).contains(&found);
        in_range(what, field, found, fits, "a share from 0 to 1")
    };
    share("transmission", transmission.share.factor)?;
    at_least_zero("ior", transmission.ior)?;
    at_least_zero("dispersion", transmission.dispersion)?;
    let Some(volume) = &transmission.volume else {
        return Ok(());
    };
    // More than all of the light would make a body that shines.
    <[f32; 3]>::from(volume.attenuation_color)
        .into_iter()
        .try_for_each(|channel| share("attenuation color", channel))?;
    let distance = volume.attenuation_distance;
    in_range(
        what,
        "attenuation distance",
        distance,
        distance > 0.0,
        "a distance above 0",
    )
}

pub(super) fn check_light(
    light: &Light,
    what: impl Fn() -> String + Copy,
) -> Result<(), SceneError> {
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
