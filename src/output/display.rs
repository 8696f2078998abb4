//! Display transforms: light without an upper limit to what a display can show.

mod aces_hill;
mod agx;
mod pbr_neutral;
mod reinhard;
mod srgb;

use crate::color::Rgb;

/// How light without an upper limit becomes the light of a display.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Display {
    /// Everything above white is white: what is not too bright stays as it is.
    #[default]
    Srgb,
    /// Each channel squeezed by itself (Reinhard et al. 2002).
    Reinhard,
    /// Stephen Hill's fit of ACES.
    AcesHill,
    /// AgX in closed form, near Blender's.
    Agx,
    /// Khronos PBR Neutral, which glTF viewers show: base colours stay true.
    PbrNeutral,
}

impl Display {
    /// Every transform there is.
    pub const ALL: [Display; 5] = [
        Display::Srgb,
        Display::Reinhard,
        Display::AcesHill,
        Display::Agx,
        Display::PbrNeutral,
    ];

    /// As on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Display::Srgb => "srgb",
            Display::Reinhard => "reinhard",
            Display::AcesHill => "aces-hill",
            Display::Agx => "agx",
            Display::PbrNeutral => "pbr-neutral",
        }
    }

    /// The display's linear light, 0..1 in every channel. What is negative or no number counts as black.
    pub fn apply(self, light: Rgb) -> Rgb {
        let light = light.map(within_reach);
        match self {
            Display::Srgb => srgb::clip(light),
            Display::Reinhard => reinhard::reinhard(light),
            Display::AcesHill => aces_hill::aces_hill(light),
            Display::Agx => agx::agx(light),
            Display::PbrNeutral => pbr_neutral::pbr_neutral(light),
        }
        .map(|channel| channel.clamp(0.0, 1.0))
    }
}

/// Every transform is at its end long before, and the square of this is still a number.
const BRIGHTEST: f32 = 1e9;

fn within_reach(channel: f32) -> f32 {
    // False for NaN.
    if channel > 0.0 {
        channel.min(BRIGHTEST)
    } else {
        0.0
    }
}

/// The matrix with these rows times the colour.
fn transformed(rows: &[[f32; 3]; 3], color: Rgb) -> Rgb {
    let [r, g, b] = rows.map(|[r, g, b]| r * color.r + g * color.g + b * color.b);
    Rgb::new(r, g, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_leaves_the_range_of_a_display() {
        let odd = [
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
            -1.0,
            -0.0,
            1e-40,
            0.5,
            f32::MAX,
        ];
        for display in Display::ALL {
            for r in odd {
                for g in odd {
                    let Rgb { r, g, b } = display.apply(Rgb::new(r, g, 0.18));
                    let range = 0.0..=1.0;
                    assert!(
                        [r, g, b].iter().all(|channel| range.contains(channel)),
                        "{display:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn more_light_is_never_darker() {
        for display in Display::ALL {
            let grey = |step: i32| display.apply(Rgb::grey(libm::exp2f(step as f32 / 8.0))).g;
            for step in -80..80 {
                // AgX's last digits may go either way.
                assert!(grey(step + 1) >= grey(step) - 1e-6, "{display:?} {step}");
            }
        }
    }
}
