//! Light from infinitely far away, from all around: a picture of it, and that picture made ready to light a scene.
//!
//! A matt surface shows the cosine-weighted mean of it ([`Surroundings::irradiance`]), a mirror the picture itself, what
//! lies between the mean over a lobe ([`Surroundings::radiance`]). Shadows come from a few lights of equal energy that
//! stand for all of it ([`Surroundings::lights`]). Nothing of this is random: the same picture, the same light.

mod equirect;
mod level;
mod lobe;
mod median_cut;
mod octahedral;
mod prefilter;
mod sky;
mod studio;

pub use equirect::Equirect;
pub use sky::sky;
pub use studio::studio;

use crate::color::Rgb;
use equirect::position;
use glam::Vec3;
use level::Level;
use lobe::Lobe;
use median_cut::Part;
use octahedral::Octahedral;
use prefilter::prefiltered;
use rayon::prelude::*;
use std::sync::Arc;

/// The most rounds that lights are dealt to.
pub const MAX_ROUNDS: u32 = 4;
/// The most lights an environment is cut into.
pub const MAX_LIGHTS: u32 = 1024;

/// An environment as a user asks for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// What comes from where.
    pub radiance: Arc<Equirect>,
    /// How far it is turned about +Y, radians: a quarter turns what was at +Z to +X.
    pub rotation: f32,
    /// Multiplies the radiance.
    pub intensity: f32,
    /// How many lights it is cut into, 1 to [`MAX_LIGHTS`].
    pub lights: u32,
}

/// The same light from everywhere.
pub fn uniform(color: Rgb) -> Equirect {
    Equirect {
        width: 1,
        height: 1,
        pixels: vec![color],
    }
}

/// A part of an environment as a light that is infinitely far away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistantLight {
    /// Unit.
    pub to_light: Vec3,
    /// What it adds to a white matt surface that faces it, in the paper's units: radiance times solid angle over π, of
    /// its own part of the environment.
    pub irradiance: Rgb,
}

/// An environment made ready.
#[derive(Clone, Debug)]
pub struct Surroundings {
    /// As it is, in the space of the picture.
    sharp: Arc<Level>,
    /// As seen through ever wider lobes, of the roughnesses squared in [`LEVELS`]; in the world's space.
    rough: Arc<[Octahedral]>,
    /// For each number of rounds the lights of each round.
    rounds: Arc<[Vec<Vec<DistantLight>>]>,
    turn: Turn,
    intensity: f32,
}

/// How a picture stands in the world: cosine and sine of the angle that it is turned about +Y.
#[derive(Clone, Copy, Debug)]
struct Turn {
    cos: f32,
    sin: f32,
}

impl Turn {
    /// By an angle in radians.
    fn by(angle: f32) -> Turn {
        Turn {
            cos: libm::cosf(angle),
            sin: libm::sinf(angle),
        }
    }

    /// A direction of the world in the picture.
    fn to_picture(self, d: Vec3) -> Vec3 {
        let Turn { cos, sin } = self;
        Vec3::new(cos * d.x - sin * d.z, d.y, sin * d.x + cos * d.z)
    }

    /// A direction of the picture in the world.
    fn to_world(self, d: Vec3) -> Vec3 {
        let Turn { cos, sin } = self;
        Vec3::new(cos * d.x + sin * d.z, d.y, cos * d.z - sin * d.x)
    }
}

/// Roughness squared of each lobe, how many columns the picture that is seen through it has, and of how many it is made.
/// Each lobe is twice as wide as the one before, so half the pixels are enough, down to what interpolates smoothly.
const LEVELS: [(f32, u32, u32); 7] = [
    (1.0 / 64.0, 512, 512),
    (1.0 / 32.0, 256, 256),
    (1.0 / 16.0, 128, 128),
    (1.0 / 8.0, 64, 128),
    (1.0 / 4.0, 64, 128),
    (1.0 / 2.0, 64, 64),
    // The cosine has an edge at the horizon, which asks for more pixels than it leaves.
    (1.0, 64, 128),
];
/// Pixels across of the largest octahedral picture: the finest lobe is wider than four of them.
const MOST_ACROSS: u32 = 384;
/// Of the picture that the finest lobe is put over: a pixel is smaller than that lobe.
const FINEST: u32 = 512;
/// Columns of the picture that is cut into lights.
const CUT: u32 = 256;

impl Surroundings {
    /// Makes an environment ready: the same bits for any number of threads.
    ///
    /// Numbers that make no sense count as zero, in the picture as in what is asked of it.
    pub fn new(environment: &Environment) -> Surroundings {
        let picture = environment.radiance.sound();
        let finite = |value: f32| if value.is_finite() { value } else { 0.0 };
        let intensity = finite(environment.intensity).max(0.0);
        let turn = Turn::by(finite(environment.rotation));
        let fine = picture.resized(FINEST, FINEST / 2);
        let of_width = |width: u32| fine.resized(width, width / 2);
        let filtered = |&(alpha, width, source): &(f32, u32, u32)| {
            let lobe = Lobe::of_alpha(alpha.into());
            let seen = Level::new(prefiltered(&of_width(source), width, &lobe));
            // Twice as fine: what was interpolated once is not to be blurred again.
            let side = (2 * width).min(MOST_ACROSS);
            Octahedral::of(side, |d| seen.at(position(turn.to_picture(d))))
        };
        let (mut parts, rough) = rayon::join(
            || median_cut::lights(&of_width(CUT), environment.lights.clamp(1, MAX_LIGHTS)),
            || LEVELS.par_iter().map(filtered).collect::<Vec<_>>(),
        );
        for part in &mut parts {
            part.light.to_light = turn.to_world(part.light.to_light);
            part.light.irradiance *= intensity;
        }
        Surroundings {
            sharp: Arc::new(Level::new(picture)),
            rough: Arc::from(rough),
            rounds: (1..=MAX_ROUNDS)
                .map(|rounds| dealt(&parts, rounds))
                .collect(),
            turn,
            intensity,
        }
    }

    /// The radiance that comes from the unit direction `d`, seen in a mirror of perceptual `roughness`: 0 shows it sharp, 1
    /// as a matt surface does. Continuous in both.
    pub fn radiance(&self, d: Vec3, roughness: f32) -> Rgb {
        let alpha = roughness.clamp(0.0, 1.0) * roughness.clamp(0.0, 1.0);
        let level = |index: usize| match index.checked_sub(1) {
            None => self.sharp.at(position(self.turn.to_picture(d))),
            Some(index) => self.rough(index, d),
        };
        let mut below = 0.0;
        for (index, (above, ..)) in LEVELS.into_iter().enumerate() {
            if alpha <= above {
                let share = (alpha - below) / (above - below);
                let radiance = match share {
                    // Most lookups are of sharp mirrors.
                    0.0 => level(index),
                    1.0 => level(index + 1),
                    _ => level(index).mix(level(index + 1), share),
                };
                return radiance * self.intensity;
            }
            below = above;
        }
        self.rough(LEVELS.len() - 1, d) * self.intensity
    }

    /// What a white matt surface of unit normal `n` shows of all of it where nothing is in the way: irradiance over π.
    pub fn irradiance(&self, n: Vec3) -> Rgb {
        self.rough(LEVELS.len() - 1, n) * self.intensity
    }

    /// As seen through one of the lobes.
    fn rough(&self, lobe: usize, d: Vec3) -> Rgb {
        self.rough.get(lobe).map_or(Rgb::BLACK, |seen| seen.at(d))
    }

    /// The lights of one of `rounds` rounds (1 to [`MAX_ROUNDS`], and no more than there are lights; others count as the
    /// nearest, and rounds are counted in a circle). Every light is in exactly one round, but for those as small and
    /// bright as the sun, of which each round has its share; each round by itself covers all directions. Empty where the
    /// environment is black, and only there.
    pub fn lights(&self, round: u32, rounds: u32) -> &[DistantLight] {
        let rounds = rounds.clamp(1, MAX_ROUNDS) as usize;
        let dealt = self.rounds.get(rounds - 1).map_or(&[][..], Vec::as_slice);
        let round = (round as usize).checked_rem(dealt.len());
        let lights = round.and_then(|round| dealt.get(round));
        lights.map_or(&[], Vec::as_slice)
    }

    /// The same with this share of its light.
    pub fn dimmed(&self, share: f32) -> Surroundings {
        let dimmed = |light: &DistantLight| DistantLight {
            irradiance: light.irradiance * share,
            ..*light
        };
        let of_round = |round: &Vec<DistantLight>| round.iter().map(dimmed).collect();
        let all = self.rounds.iter();
        Surroundings {
            rounds: all
                .map(|rounds| rounds.iter().map(of_round).collect())
                .collect(),
            intensity: self.intensity * share,
            ..self.clone()
        }
    }
}

/// Parts dealt to rounds like cards, so that neighbours come to different rounds. A part that could not be cut though it
/// has more than its share, like the sun, is in every round with what each round has of it.
fn dealt(parts: &[Part], rounds: u32) -> Vec<Vec<DistantLight>> {
    let all: f64 = parts.iter().map(|part| part.energy).sum();
    let is_sun = |part: &&Part| part.is_small && part.energy * parts.len() as f64 > all;
    let others = parts.iter().filter(|part| !is_sun(part)).count();
    let rounds = (rounds as usize).min(others.max(1));
    let mut dealt = vec![Vec::new(); rounds];
    let mut next = 0;
    for part in parts {
        if is_sun(&part) {
            let irradiance = part.light.irradiance * (1.0 / rounds as f32);
            let share = DistantLight {
                irradiance,
                ..part.light
            };
            dealt.iter_mut().for_each(|round| round.push(share));
        } else {
            // Each time from another round on: else one would get the same side of all parts.
            let round = (next + next / rounds) % rounds;
            dealt
                .iter_mut()
                .skip(round)
                .take(1)
                .for_each(|round| round.push(part.light));
            next += 1;
        }
    }
    dealt
}
