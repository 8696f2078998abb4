//! What a finish must be.

use super::fields::{check_color, finite, in_range};
use crate::material::Finish;
use crate::scene::SceneError;

pub(super) fn check_finish(
    finish: &Finish,
    what: impl Fn() -> String + Copy,
) -> Result<(), SceneError> {
    let share = |field, value| {
        let fits = (0.0..=1.0).contains(&value);
        in_range(what, field, value, fits, "a share from 0 to 1")
    };
    in_range(
        what,
        "ior",
        finish.ior,
        finish.ior >= 1.0,
        "a number, 1 or more",
    )?;
    share("specular", finish.specular.factor)?;
    check_color(what, "specular color", finish.specular_color.factor)?;
    if let Some(coat) = &finish.clearcoat {
        share("clearcoat", coat.weight.factor)?;
        share("clearcoat roughness", coat.roughness.factor)?;
    }
    if let Some(sheen) = &finish.sheen {
        check_color(what, "sheen color", sheen.color.factor)?;
        share("sheen roughness", sheen.roughness.factor)?;
    }
    if let Some(film) = &finish.iridescence {
        share("iridescence", film.strength.factor)?;
        let fits = film.ior >= 1.0 && film.ior.is_finite();
        in_range(
            what,
            "iridescence ior",
            film.ior,
            fits,
            "a finite number, 1 or more",
        )?;
        finite(what, "iridescence thickness", film.thickness)?;
    }
    if let Some(strength) = &finish.anisotropy {
        share("anisotropy", strength.factor)?;
    }
    if let Some(through) = &finish.diffuse_transmission {
        share("diffuse transmission", through.share.factor)?;
        check_color(what, "diffuse transmission color", through.color.factor)?;
    }
    Ok(())
}
