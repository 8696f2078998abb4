//! `[render]`, `[background]`, `[ambient]`.

use super::kind::{COLOR, COUNT, COUNT_ABOVE_ZERO, TRUE_OR_FALSE};
use super::table::{Schema, Table};
use crate::Error;
use crate::color::Rgb;
use crate::load::PictureDefaults;
use crate::sampling::{Filter, Grid, MAX_SAMPLES, Pattern};
use crate::shade::Shading;
use crate::texture::TextureFilter;

const RENDER: Schema = Schema {
    key: "render",
    label: "[render]",
    keys: &[
        "width",
        "height",
        "samples",
        "pattern",
        "filter",
        "adaptive",
        "max_depth",
        "shading",
        "texture_filter",
    ],
};

/// What is seen where nothing is.
pub(super) const BACKGROUND: Schema = Schema {
    key: "background",
    label: "[background]",
    keys: &["color"],
};

/// Light from everywhere.
pub(super) const AMBIENT: Schema = Schema {
    key: "ambient",
    label: "[ambient]",
    keys: &["color"],
};

const SHADINGS: [(&str, Shading); 4] = [
    ("blinn-phong", Shading::BlinnPhong),
    ("phong", Shading::Phong),
    ("lambert", Shading::Lambert),
    ("flat", Shading::Flat),
];

const TEXTURE_FILTERS: [(&str, TextureFilter); 2] = [
    ("footprint", TextureFilter::Footprint),
    ("point", TextureFilter::Point),
];

/// What the file says of the picture. Everything is said: the format has a default for each.
pub(super) fn read(root: &Table<'_>) -> Result<PictureDefaults, Error> {
    let mut picture = PictureDefaults {
        width: Some(640),
        height: Some(480),
        samples: Some(1),
        pattern: Some(Pattern::Grid),
        filter: Some(Filter::Box),
        adaptive: Some(false),
        max_depth: Some(5),
        shading: Some(Shading::BlinnPhong),
        // The paper's checkerboards are of points.
        texture_filter: Some(TextureFilter::Point),
    };
    let Some(render) = root.table(&RENDER)? else {
        return Ok(picture);
    };
    picture.width = render
        .optional("width", &COUNT_ABOVE_ZERO)?
        .or(picture.width);
    picture.height = render
        .optional("height", &COUNT_ABOVE_ZERO)?
        .or(picture.height);
    picture.max_depth = render.optional("max_depth", &COUNT)?.or(picture.max_depth);
    picture.shading = render.choice("shading", &SHADINGS)?.or(picture.shading);
    picture.texture_filter = render
        .choice("texture_filter", &TEXTURE_FILTERS)?
        .or(picture.texture_filter);
    picture.filter = render
        .choice("filter", &Filter::ALL.map(|one| (one.name(), one)))?
        .or(picture.filter);
    picture.adaptive = render
        .optional("adaptive", &TRUE_OR_FALSE)?
        .or(picture.adaptive);
    let pattern = render
        .choice("pattern", &Pattern::ALL.map(|one| (one.name(), one)))?
        .unwrap_or_default();
    picture.pattern = Some(pattern);
    if let Some(samples) = render.optional("samples", &COUNT)? {
        if pattern == Pattern::Grid && Grid::with_samples(samples).is_none() {
            return Err(render.wrong("samples", &nearest_squares(samples)));
        }
        if !(1..=MAX_SAMPLES).contains(&samples) {
            return Err(render.wrong("samples", "a whole number from 1 to 65536"));
        }
        picture.samples = Some(samples);
    }
    Ok(picture)
}

/// The colour of a table that has nothing else, where there is such a table.
pub(super) fn color_of(root: &Table<'_>, schema: &Schema) -> Result<Option<Rgb>, Error> {
    match root.table(schema)? {
        None => Ok(None),
        Some(table) => table.or("color", &COLOR, Rgb::BLACK).map(Some),
    }
}

/// `a square number up to 65536, such as 4 or 9`: those about `samples`.
fn nearest_squares(samples: u32) -> String {
    let side = samples.isqrt().min(256);
    let near: Vec<String> = [side, side + 1]
        .into_iter()
        .filter_map(|side| Grid::with_samples(side * side))
        .map(|grid| grid.samples().to_string())
        .collect();
    format!("a square number up to 65536, such as {}", near.join(" or "))
}
