//! A whole frame of the interior, held against its bare rays: what shading, textures and film cost.

use super::engines::{Engine, Threads};
use super::sets::Kind;
use super::table::Row;
use super::{measure, scenes};
use luch::accel::{Accel, Options};
use luch::generate::Decoration;
use luch::render::{Progress, Settings, render};
use luch::shade::Shading;
use rayon::ThreadPoolBuilder;

/// A frame on one thread.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrameRow {
    pub(crate) decoration: Decoration,
    /// Camera, shadow and mirror rays.
    pub(crate) rays: [u64; 3],
    pub(crate) mrays_per_second: f64,
    /// What the kernels alone would reach on so many rays of each kind; rays through transparent surfaces are none.
    pub(crate) bare_mrays_per_second: f64,
}

/// Both interiors at 1280 x 720, 4 samples a pixel; `interior` are the rows of their bare rays.
pub(crate) fn of_interior(interior: &[Row], rounds: usize) -> Result<Vec<FrameRow>, String> {
    let settings =
        Settings::new(1280, 720, 4, 5, Shading::BlinnPhong).map_err(|e| e.to_string())?;
    let pool = ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .map_err(|e| e.to_string())?;
    let bare = |kind| {
        let row = interior.iter().find(|row| row.kind == kind)?;
        row.rate(Engine::Luch, Threads::One)
    };
    let mut rows = Vec::new();
    for decoration in [Decoration::Plain, Decoration::Textured] {
        let scene = scenes::interior(decoration)?;
        let accel = Accel::build(&scene, &Options::default());
        let frame = || pool.install(|| render(&scene, &accel, &settings, &Progress::default()));
        let counts = frame().statistics;
        let rays = [counts.camera_rays, counts.shadow_rays, counts.mirror_rays];
        let rates: Vec<f64> = (0..rounds)
            .map(|_| counts.rays() as f64 / frame().statistics.time.as_secs_f64() / 1e6)
            .collect();
        let kinds = [Kind::Primary, Kind::Shadow, Kind::Mirror];
        let bare_seconds: Option<f64> = rays
            .iter()
            .zip(kinds)
            .map(|(&n, kind)| Some(n as f64 / 1e6 / bare(kind)?))
            .sum();
        let Some(bare_seconds) = bare_seconds else {
            continue;
        };
        rows.push(FrameRow {
            decoration,
            rays,
            mrays_per_second: measure::median(&rates),
            bare_mrays_per_second: rays.iter().sum::<u64>() as f64 / 1e6 / bare_seconds,
        });
    }
    Ok(rows)
}

/// The names of [`line`]'s columns.
pub(crate) const HEADER: &str =
    "frame, one thread   camera rays    shadow    mirror   Mrays/s   bare Mrays/s   share";

/// A row of the table.
pub(crate) fn line(row: &FrameRow) -> String {
    let name = match row.decoration {
        Decoration::Plain => "interior",
        Decoration::Textured => "interior, textured",
    };
    let [camera, shadow, mirror] = row.rays;
    let (whole, bare) = (row.mrays_per_second, row.bare_mrays_per_second);
    let share = 100.0 * whole / bare;
    format!(
        "{name:<18} {camera:>12} {shadow:>9} {mirror:>9} {whole:>9.2} {bare:>14.2} {share:>6.0}%"
    )
}
