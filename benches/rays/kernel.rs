//! One kind of rays through one engine and nothing else, for a program that counts instructions.

use super::arguments::Arguments;
use super::embree::Embree;
use super::engines::{Arena, Engine, Round, Threads, options};
use super::scenes;
use luch::accel::Accel;
use luch::study::sets::{self, Kind};

/// Traces a set of about `arguments.rays` rays `arguments.rounds` times.
pub(crate) fn run(
    arguments: &Arguments,
    kind: Kind,
    engine: Engine,
    embree: Option<&Embree>,
) -> Result<(), String> {
    let names = arguments.scenes();
    let name = names.first().ok_or("no scene")?;
    let scene = scenes::make(name)?;
    let accel = Accel::build(&scene, &options());
    let arena = Arena::new(&scene, &accel, embree)?;
    // Whole tiles of a picture twice as wide as high.
    let height = (f64::from(arguments.rays) / 2.0).sqrt() as u32 / 8 * 8;
    let size = [height.max(8) * 2, height.max(8)];
    let sets = sets::make(&scene, &accel, sets::light(&scene), size);
    let round = Round::new(kind, &sets[kind as usize], arena.has_embree());
    for _ in 0..arguments.rounds {
        arena
            .seconds(engine, &round, Threads::One)
            .ok_or("this engine needs LUCH_EMBREE")?;
    }
    let (scene, kind, engine_name) = (scenes::short_name(name), kind.name(), engine.name());
    println!(
        "{scene}, {kind}, {engine_name}: {} rays x {} rounds",
        round.rays(engine),
        arguments.rounds
    );
    Ok(())
}
