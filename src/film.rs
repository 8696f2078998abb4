//! The picture: named layers of numbers.

mod parts;
mod window;

pub use parts::{COMPONENTS, FROM_NO_LAMP, Source};
pub use window::Window;

use crate::light::Light;
use crate::scene::Background;
use std::borrow::Cow;
use std::time::Duration;

/// What a render leaves behind.
#[derive(Clone, Debug)]
pub struct Film {
    /// Of the pixels that the film has, in pixels.
    pub width: u32,
    /// Of the pixels that the film has, in pixels.
    pub height: u32,
    /// The column of its leftmost pixels in the whole picture; negative to the left of it.
    pub left: i32,
    /// The row of its uppermost pixels in the whole picture; negative above it.
    pub top: i32,
    /// Of the whole picture, in pixels.
    pub display_width: u32,
    /// Of the whole picture, in pixels.
    pub display_height: u32,
    /// The beauty first.
    pub layers: Vec<Layer>,
    /// What a display shows where the beauty is transparent; its colour is in the beauty already where it is
    /// [`crate::scene::Shown::Always`].
    pub background: Background,
    /// False where the render was cancelled: some tiles are black then.
    pub complete: bool,
    /// What the render took.
    pub statistics: Statistics,
}

/// Some numbers a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Empty for what a reader should show first.
    pub name: Cow<'static, str>,
    /// What of a render they are.
    pub quantity: Quantity,
    /// What the numbers are.
    pub channels: &'static [&'static str],
    /// How a file keeps them.
    pub precision: Precision,
    /// What they are measured in, for readers.
    pub unit: &'static str,
    /// How a pixel's samples become one.
    pub combine: Combine,
    /// Row by row from the top, pixel by pixel, channel by channel.
    pub values: Vec<f32>,
}

/// What of a render a layer holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// All light, and alpha.
    Light,
    /// [`DEPTH`].
    Depth,
    /// [`COST`].
    Cost,
    /// [`SAMPLES`].
    Samples,
    /// A part of the light, of these in order: [`Layers::of_parts`].
    Part(usize),
}

/// How a file keeps a layer's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// 16 bits: light.
    Half,
    /// 32 bits: distances, ids and counts.
    Float,
}

/// How a pixel's samples become one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Combine {
    /// Their mean.
    Mean,
    /// The sample nearest to the camera: a mean across an edge would invent surfaces.
    Nearest,
    /// How many there are.
    Count,
}

/// `Z` where nothing is seen: far, but a number.
pub const FAR_AWAY: f32 = 1e10;

/// Linear light with premultiplied alpha.
pub const BEAUTY: Layer = Layer {
    name: Cow::Borrowed(""),
    quantity: Quantity::Light,
    channels: &["R", "G", "B", "A"],
    precision: Precision::Half,
    unit: "linear Rec. 709, premultiplied alpha",
    combine: Combine::Mean,
    values: Vec::new(),
};

/// Distance along the camera's axis, [`FAR_AWAY`] where nothing is seen.
pub const DEPTH: Layer = Layer {
    name: Cow::Borrowed(""),
    quantity: Quantity::Depth,
    channels: &["Z"],
    precision: Precision::Float,
    unit: "distance along the camera's axis, scene units",
    combine: Combine::Nearest,
    values: Vec::new(),
};

/// What the rays of a sample (of the camera, behind transparent surfaces, toward lights, off mirrors, through bodies) were
/// tested against, each counted on its own way: see [`crate::accel::Tests`].
pub const COST: Layer = Layer {
    name: Cow::Borrowed("cost"),
    quantity: Quantity::Cost,
    channels: &["nodes", "primitives"],
    precision: Precision::Float,
    unit: "tests a sample",
    combine: Combine::Mean,
    values: Vec::new(),
};

/// How many samples a pixel got: not the same everywhere where sampling is adaptive.
pub const SAMPLES: Layer = Layer {
    name: Cow::Borrowed("samples"),
    quantity: Quantity::Samples,
    channels: &["count"],
    precision: Precision::Float,
    unit: "samples a pixel",
    combine: Combine::Count,
    values: Vec::new(),
};

/// Which layers a film has beside the beauty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layers {
    /// [`DEPTH`].
    pub depth: bool,
    /// [`COST`]. Every ray is searched for twice then, so that the times of such a render say nothing.
    pub cost: bool,
    /// [`SAMPLES`].
    pub samples: bool,
    /// One for each of [`COMPONENTS`].
    pub components: bool,
    /// One for each lamp of the scene, which are so many, and of [`FROM_NO_LAMP`].
    pub lights: Option<u32>,
    /// So many for what mirrors show, by how many of them light met: the last holds the rest. They add up to
    /// `reflection`.
    pub bounces: u32,
}

impl Default for Layers {
    fn default() -> Layers {
        Layers {
            depth: true,
            ..Layers::NONE
        }
    }
}

impl Layers {
    /// The beauty alone.
    pub const NONE: Layers = Layers {
        depth: false,
        cost: false,
        samples: false,
        components: false,
        lights: None,
        bounces: 0,
    };

    /// The layers, still without values, the beauty first; `lights` are the scene's.
    pub fn list(&self, lights: &[Light]) -> Vec<Layer> {
        let mut list = vec![BEAUTY];
        list.extend(self.depth.then_some(DEPTH));
        list.extend(self.cost.then_some(COST));
        list.extend(self.samples.then_some(SAMPLES));
        list.extend(self.of_parts(lights));
        list
    }
}

/// What a render took: rays by kind, and time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Rays from the camera.
    pub camera_rays: u64,
    /// Rays that went on behind a transparent surface.
    pub transparent_rays: u64,
    /// Rays toward lights.
    pub shadow_rays: u64,
    /// Rays off mirrors.
    pub mirror_rays: u64,
    /// Rays that went into bodies, out of them, or through thin sheets, and those reflected totally on the way.
    pub refracted_rays: u64,
    /// Rays that ended in the [`crate::whitted::MAX_LAYERS`]th transparent layer.
    pub lost_in_layers: u64,
    /// From the first ray to the last.
    pub time: Duration,
    /// What the tiles took in which search was measured: one of
    /// [`crate::render::WATCHED`], since reading clocks takes time, too.
    pub watched: Duration,
    /// What search took of that.
    pub search: Duration,
}

impl Statistics {
    /// Samples of every pixel together.
    pub fn samples(&self) -> u64 {
        self.camera_rays
    }

    /// Rays of every kind.
    pub fn rays(&self) -> u64 {
        self.camera_rays
            + self.transparent_rays
            + self.shadow_rays
            + self.mirror_rays
            + self.refracted_rays
    }

    /// The counts of both, and what was measured; the time stays.
    pub fn add_counts(&mut self, other: &Statistics) {
        self.camera_rays += other.camera_rays;
        self.transparent_rays += other.transparent_rays;
        self.shadow_rays += other.shadow_rays;
        self.mirror_rays += other.mirror_rays;
        self.refracted_rays += other.refracted_rays;
        self.lost_in_layers += other.lost_in_layers;
        self.watched += other.watched;
        self.search += other.search;
    }

    /// The share of the time that went into search, 0..1: the picture's rays a second are this share of those of search
    /// alone.
    pub fn search_share(&self) -> f64 {
        self.search.as_secs_f64() / self.watched.as_secs_f64().max(1e-9)
    }
}

impl Film {
    /// The pixels that it has.
    pub fn window(&self) -> Window {
        Window {
            left: self.left,
            top: self.top,
            width: self.width,
            height: self.height,
        }
    }

    /// The layer with exactly these channels, where the film has it.
    pub fn layer(&self, channels: &[&str]) -> Option<&Layer> {
        self.layers.iter().find(|layer| layer.channels == channels)
    }

    /// The beauty's pixels, top row first: linear red, green, blue and premultiplied alpha.
    pub fn beauty(&self) -> impl Iterator<Item = [f32; 4]> {
        let values = self
            .layer(BEAUTY.channels)
            .map_or(&[][..], |layer| &layer.values);
        values.as_chunks::<4>().0.iter().copied()
    }
}
