//! Options that are one word of a few.

use clap::ValueEnum;
use luch::accel::{Builder, Preset};
use luch::framing::Direction;
use luch::load::{GroundChoice, LightsChoice};
use luch::output::{BitDepth, Format};
use luch::shade::Shading;
use luch::texture::TextureFilter;

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(in crate::cli) enum FormatValue {
    Png,
    Exr,
}

impl From<FormatValue> for Format {
    fn from(value: FormatValue) -> Format {
        match value {
            FormatValue::Png => Format::Png,
            FormatValue::Exr => Format::Exr,
        }
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(in crate::cli) enum BitDepthValue {
    #[value(name = "8")]
    Eight,
    #[value(name = "16")]
    Sixteen,
}

impl From<BitDepthValue> for BitDepth {
    fn from(value: BitDepthValue) -> BitDepth {
        match value {
            BitDepthValue::Eight => BitDepth::Eight,
            BitDepthValue::Sixteen => BitDepth::Sixteen,
        }
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(in crate::cli) enum ShadingValue {
    Flat,
    Lambert,
    Phong,
    BlinnPhong,
}

impl From<ShadingValue> for Shading {
    fn from(value: ShadingValue) -> Shading {
        match value {
            ShadingValue::Flat => Shading::Flat,
            ShadingValue::Lambert => Shading::Lambert,
            ShadingValue::Phong => Shading::Phong,
            ShadingValue::BlinnPhong => Shading::BlinnPhong,
        }
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(in crate::cli) enum LightsValue {
    File,
    Default,
    Both,
}

impl From<LightsValue> for LightsChoice {
    fn from(value: LightsValue) -> LightsChoice {
        match value {
            LightsValue::File => LightsChoice::File,
            LightsValue::Default => LightsChoice::Default,
            LightsValue::Both => LightsChoice::Both,
        }
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(in crate::cli) enum GroundValue {
    Auto,
    On,
    Off,
}

impl From<GroundValue> for GroundChoice {
    fn from(value: GroundValue) -> GroundChoice {
        match value {
            GroundValue::Auto => GroundChoice::Auto,
            GroundValue::On => GroundChoice::On,
            GroundValue::Off => GroundChoice::Off,
        }
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(in crate::cli) enum TextureFilterValue {
    Footprint,
    Point,
}

impl From<TextureFilterValue> for TextureFilter {
    fn from(value: TextureFilterValue) -> TextureFilter {
        match value {
            TextureFilterValue::Footprint => TextureFilter::Footprint,
            TextureFilterValue::Point => TextureFilter::Point,
        }
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(in crate::cli) enum BuilderValue {
    Own,
    Obvhs,
}

impl From<BuilderValue> for Builder {
    fn from(value: BuilderValue) -> Builder {
        match value {
            BuilderValue::Own => Builder::Own,
            BuilderValue::Obvhs => Builder::Obvhs,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum ProgressValue {
    Auto,
    Openjd,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(in crate::cli) enum PresetValue {
    Fastest,
    VeryFast,
    Fast,
    Medium,
    Slow,
    VerySlow,
}

impl From<PresetValue> for Preset {
    fn from(value: PresetValue) -> Preset {
        match value {
            PresetValue::Fastest => Preset::Fastest,
            PresetValue::VeryFast => Preset::VeryFast,
            PresetValue::Fast => Preset::Fast,
            PresetValue::Medium => Preset::Medium,
            PresetValue::Slow => Preset::Slow,
            PresetValue::VerySlow => Preset::VerySlow,
        }
    }
}

/// A side to frame a model from.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(in crate::cli) enum DirectionValue {
    Front,
    Back,
    Left,
    Right,
    Top,
    ThreeQuarter,
}

impl From<DirectionValue> for Direction {
    fn from(value: DirectionValue) -> Direction {
        match value {
            DirectionValue::Front => Direction::Front,
            DirectionValue::Back => Direction::Back,
            DirectionValue::Left => Direction::Left,
            DirectionValue::Right => Direction::Right,
            DirectionValue::Top => Direction::Top,
            DirectionValue::ThreeQuarter => Direction::ThreeQuarter,
        }
    }
}
