//! Whether the machine was busy with something else.

use std::fs;

/// The share of the machine's processors that others use while something is measured.
#[derive(Clone, Copy, Debug)]
pub struct Watch(Option<Ticks>);

/// Processor time since some beginning, all in the system's clock ticks, of which only ratios are used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Ticks {
    /// Of all processors, idle or not.
    total: u64,
    /// Of all processors that did something, for whomever.
    busy: u64,
    /// Of this process.
    own: u64,
}

impl Watch {
    /// Starts watching.
    pub fn start() -> Watch {
        Watch(Ticks::now())
    }

    /// The share of the processor time of the whole machine that other processes have taken since the start, from 0 to
    /// 1: on two cores, 0.5 is one core. A virtual machine's stolen time counts, someone took it.
    ///
    /// The clock ticks a hundred times a second as a rule: over less than a second this is rough. `None` where the
    /// system does not say or the clock has not ticked.
    pub fn others_share(&self) -> Option<f64> {
        others_share(self.0?, Ticks::now()?)
    }
}

/// Threads that run or wait to run, the mean of about the last minute, this process's own included. `None` where the
/// system does not say.
pub fn load_average() -> Option<f64> {
    last_minute(&fs::read_to_string("/proc/loadavg").ok()?)
}

impl Ticks {
    fn now() -> Option<Ticks> {
        let (total, busy) = of_machine(&fs::read_to_string("/proc/stat").ok()?)?;
        let own = of_process(&fs::read_to_string("/proc/self/stat").ok()?)?;
        Some(Ticks { total, busy, own })
    }
}

fn others_share(start: Ticks, end: Ticks) -> Option<f64> {
    let total = end.total.checked_sub(start.total).filter(|&t| t > 0)?;
    // The three are read one after another and rounded each for itself: a tick may seem to be missing.
    let busy = end.busy.saturating_sub(start.busy);
    let own = end.own.saturating_sub(start.own);
    Some((busy.saturating_sub(own) as f64 / total as f64).min(1.0))
}

/// All and busy ticks of all processors, in the text of `/proc/stat`.
fn of_machine(text: &str) -> Option<(u64, u64)> {
    let mut words = text.lines().next()?.split_whitespace();
    if words.next() != Some("cpu") {
        return None;
    }
    let mut next = || words.next()?.parse::<u64>().ok();
    let [user, nice, system, idle] = [next()?, next()?, next()?, next()?];
    // Later systems say more. What follows, a guest's time, is in the user's already.
    let [waiting, interrupts, soft_interrupts, stolen] =
        std::array::from_fn(|_| next().unwrap_or(0));
    let sum = |parts: &[u64]| {
        parts
            .iter()
            .try_fold(0u64, |sum, &part| sum.checked_add(part))
    };
    let busy = sum(&[user, nice, system, interrupts, soft_interrupts, stolen])?;
    Some((sum(&[busy, idle, waiting])?, busy))
}

/// The ticks of a process's threads, in programs and in the system for them, in the text of `/proc/self/stat`.
fn of_process(text: &str) -> Option<u64> {
    // The second field is the program's name in brackets, which may hold spaces and brackets itself.
    let (_, after_name) = text.rsplit_once(')')?;
    // Fields 14 and 15; the third is the first here.
    let mut fields = after_name.split_whitespace().skip(11);
    let mut next = || fields.next()?.parse::<u64>().ok();
    next()?.checked_add(next()?)
}

/// The first number of the text of `/proc/loadavg`.
fn last_minute(text: &str) -> Option<f64> {
    let load: f64 = text.split_whitespace().next()?.parse().ok()?;
    (load.is_finite() && load >= 0.0).then_some(load)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_guest_is_not_counted_twice_and_stolen_time_is_busy() {
        // user nice system idle iowait irq softirq steal guest guest_nice
        let text = "cpu  100 20 30 400 5 6 7 8 90 10\ncpu0 1 2 3 4\n";
        assert_eq!(of_machine(text), Some((576, 171)));
    }

    #[test]
    fn an_old_systems_four_numbers_are_enough() {
        assert_eq!(of_machine("cpu 1 2 3 4"), Some((10, 6)));
    }

    #[test]
    fn a_short_or_hostile_text_tells_nothing() {
        let most = u64::MAX;
        for text in [
            "",
            "cpu",
            "cpu 1 2 3",
            "cpu0 1 2 3 4",
            "cpu 1 2 x 4",
            &format!("cpu {most} 1 0 0"),
        ] {
            assert_eq!(of_machine(text), None);
        }
        for text in [
            "",
            "1 (luch)",
            "1 luch R 1 2 3",
            "1 (a) R 0 0 0 0 0 0 0 0 0 0 5",
            "1 (a) R 0 0 0 0 0 0 0 0 0 0 5 -6",
        ] {
            assert_eq!(of_process(text), None);
        }
        for text in ["", "x", "NaN 1 1", "-1", "inf"] {
            assert_eq!(last_minute(text), None);
        }
    }

    #[test]
    fn a_process_may_be_called_anything() {
        let text = "7 (a) b) c) R 1 2 3 4 5 6 7 8 9 10 300 45 0 0 20 0 1 0 99";
        assert_eq!(of_process(text), Some(345));
    }

    #[test]
    fn others_have_what_is_busy_and_not_ours() {
        let start = Ticks {
            total: 1000,
            busy: 500,
            own: 100,
        };
        let end = Ticks {
            total: 1400,
            busy: 800,
            own: 300,
        };
        assert_eq!(others_share(start, end), Some(0.25));
    }

    #[test]
    fn a_clock_that_has_not_ticked_tells_nothing_and_a_late_one_no_less_than_none() {
        let start = Ticks {
            total: 1000,
            busy: 500,
            own: 100,
        };
        assert_eq!(others_share(start, start), None);
        let end = Ticks {
            total: 1010,
            busy: 509,
            own: 110,
        };
        assert_eq!(others_share(start, end), Some(0.0));
    }

    #[test]
    fn the_load_is_that_of_the_last_minute() {
        assert_eq!(last_minute("0.50 0.46 0.80 1/85 26468\n"), Some(0.5));
    }
}
