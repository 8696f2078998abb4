//! Small pictures, and their bits.

use luch::accel::{Accel, Options};
use luch::film::Film;
use luch::load::{GroundChoice, Surrounding, Viewpoint};
use luch::render::{Progress, Settings, render};
use luch::scene::Scene;
use luch::shade::Shading;
use luch::texture::TextureFilter;

/// As the file says, framed where it does not, and nothing but what is in the file: neither environment nor ground.
pub(crate) fn viewpoint(aspect: f64) -> Viewpoint {
    Viewpoint {
        environment: Surrounding::Ready(None),
        ground: GroundChoice::Off,
        ..Viewpoint::of_file(aspect)
    }
}

/// A picture of one sample a pixel.
pub(crate) fn of(scene: &Scene, width: u32, height: u32, shading: Shading) -> Film {
    let settings = Settings::new(width, height, 1, 5, shading)
        .map(|settings| settings.with_texture_filter(TextureFilter::Point))
        .expect("settings");
    render(
        scene,
        &Accel::build(scene, &Options::default()),
        &settings,
        &Progress::default(),
    )
}

/// Every number of every layer, bit by bit.
pub(crate) fn bits(film: &Film) -> Vec<Vec<u32>> {
    film.layers
        .iter()
        .map(|layer| layer.values.iter().map(|v| v.to_bits()).collect())
        .collect()
}
