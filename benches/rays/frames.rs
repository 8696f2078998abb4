//! A whole frame of the interior, held against its bare rays: what shading, textures and film cost.

use super::arguments::Arguments;
use super::engines::{Arena, Engine, Round, Threads, options};
use super::measure::median;
use super::scenes;
use luch::accel::Accel;
use luch::generate::Decoration;
use luch::render::{Progress, Settings, render};
use luch::shade::Shading;
use luch::study::sets::{self, Kind};
use rayon::ThreadPoolBuilder;

/// A frame on one thread.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrameRow {
    pub(crate) decoration: Decoration,
    /// Camera, shadow and mirror rays.
    rays: [u64; 3],
    pub(crate) mrays_per_second: f64,
    /// What the kernels alone reach on so many rays of each kind.
    pub(crate) bare_mrays_per_second: f64,
}

/// Both interiors at 1280 x 720, 4 samples a pixel. Frames and bare rays take turns.
pub(crate) fn of_interior(arguments: &Arguments) -> Result<Vec<FrameRow>, String> {
    let settings =
        Settings::new(1280, 720, 4, 5, Shading::BlinnPhong).map_err(|e| e.to_string())?;
    let pool = ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .map_err(|e| e.to_string())?;
    let mut rows = Vec::new();
    for decoration in [Decoration::Plain, Decoration::Textured] {
        let scene = scenes::interior(decoration)?;
        let accel = Accel::build(&scene, &options());
        let frame = || {
            pool.install(|| render(&scene, &accel, &settings, &Progress::default()))
                .statistics
        };
        let counts = frame();
        let rays = [counts.camera_rays, counts.shadow_rays, counts.mirror_rays];

        let arena = Arena::new(&scene, &accel, None)?;
        let sets = sets::make(&scene, &accel, sets::light(&scene), arguments.size());
        let kinds = [Kind::Primary, Kind::Shadow, Kind::Mirror];
        let bare = kinds.map(|kind| Round::new(kind, &sets[kind as usize], false));
        let bare_seconds = || -> f64 {
            let of_kind = |(round, &rays): (&Round, &u64)| {
                let seconds = arena
                    .seconds(Engine::Luch, round, Threads::One)
                    .unwrap_or(0.0);
                seconds * rays as f64 / round.rays(Engine::Luch).max(1) as f64
            };
            bare.iter().zip(&rays).map(of_kind).sum()
        };
        let million: f64 = rays.iter().sum::<u64>() as f64 / 1e6;
        let seconds: Vec<[f64; 2]> = (0..arguments.rounds)
            .map(|_| [frame().time.as_secs_f64(), bare_seconds()])
            .collect();
        let rate = |which: usize| {
            million / median(&seconds.iter().map(|s| s[which]).collect::<Vec<f64>>())
        };
        rows.push(FrameRow {
            decoration,
            rays,
            mrays_per_second: rate(0),
            bare_mrays_per_second: rate(1),
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
