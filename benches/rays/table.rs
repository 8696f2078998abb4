//! The rows: on the screen, and as `target/rays.json`.

use super::engines::{Engine, Threads};
use super::measure::{Difference, Measured};
use luch::study::sets::Kind;
use serde_json::{Value, json};

/// All that was measured of one kind of rays in one scene.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) scene: String,
    pub(crate) triangles: u32,
    pub(crate) kind: Kind,
    pub(crate) measured: Vec<Measured>,
    /// From Embree's robust mode.
    pub(crate) difference: Option<Difference>,
    /// From the oracle, on its few rays.
    pub(crate) from_oracle: Option<Difference>,
}

impl Row {
    /// Millions of rays a second.
    pub(crate) fn rate(&self, engine: Engine, threads: Threads) -> Option<f64> {
        let of = |m: &&Measured| m.engine == engine && m.threads == threads;
        self.measured.iter().find(of).map(Measured::median)
    }

    /// To Embree, in the way that this kind is held against it.
    fn ratio_to_embree(&self, engine: Engine, threads: Threads) -> Option<f64> {
        Some(self.rate(engine, threads)? / self.rate(Engine::rival(self.kind), threads)?)
    }

    /// A row of the table.
    pub(crate) fn line(&self) -> String {
        let rate = |engine| number(self.rate(engine, Threads::One), 2);
        let ratio = self.ratio_to_embree(Engine::Luch, Threads::One);
        let to = |a: Option<f64>, b: Option<f64>| Some(a? / b?);
        let luch = self.rate(Engine::Luch, Threads::One);
        let to_sixteen = to(luch, self.rate(Engine::Embree16, Threads::One));
        let all = self.rate(Engine::Luch, Threads::All);
        format!(
            "{:<14} {:>9} {:<10} {:>8} {:>8} {:>8} {:>8} {:>8}   {:>6} {:>6}   {:>8} {:>6}   {}",
            cut(&self.scene, 14),
            self.triangles,
            self.kind.name(),
            rate(Engine::Luch),
            rate(Engine::Embree),
            rate(Engine::EmbreeRobust),
            rate(Engine::Embree16),
            number(self.rate(Engine::Linear, Threads::One), 5),
            number(ratio, 2),
            number(to_sixteen, 2),
            number(all, 2),
            number(to(all, luch), 2),
            self.differences(),
        )
    }

    /// "hit or miss / primitive / ties" of how many rays; and the same against the oracle where it is not all equal.
    fn differences(&self) -> String {
        let told = |d: &Difference| format!("{}/{}/{}", d.hit_or_miss, d.primitive, d.ties);
        let oracle = match &self.from_oracle {
            Some(d) if d.hit_or_miss + d.primitive + d.ties > 0 => {
                format!("  WRONG: oracle {} of {}", told(d), d.rays)
            }
            _ => String::new(),
        };
        self.difference.as_ref().map_or("-".into(), told) + &oracle
    }
}

fn cut(text: &str, length: usize) -> String {
    text.chars().take(length).collect()
}

fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or("-".into(), |value| format!("{value:.digits$}"))
}

/// The names of [`Row::line`]'s columns.
pub(crate) const HEADER: &str = "\
                                     Mrays/s, one thread                            luch to         all threads     unlike robust:
scene          triangles rays           luch   embree   robust embree16   linear   embree  emb16       luch  /one   hit/prim/tie";

/// The list that is kept in `target/rays.json`.
pub(crate) fn json(rows: &[Row]) -> Value {
    let of_row = |row: &Row| -> Vec<Value> {
        let of_engine = |m: &Measured| {
            json!({
                "scene": row.scene,
                "triangles": row.triangles,
                "rays": row.kind.name(),
                "engine": m.engine.name(),
                "isa": m.isa,
                "threads": m.threads.count(),
                "mrays_per_second": m.median(),
                "ratio_to_embree": row.ratio_to_embree(m.engine, m.threads),
            })
        };
        row.measured.iter().map(of_engine).collect()
    };
    rows.iter().flat_map(of_row).collect()
}
