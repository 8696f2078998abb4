//! The machine a study ran on, and the program that ran: what a report opens with.

mod watch;

pub use watch::{Watch, load_average};

use std::env::consts::{ARCH, OS};
use std::fs;
use std::thread::available_parallelism;

/// The commit the program was made of, short, `-dirty` where its sources differed; `unknown` outside a repository.
pub const COMMIT: &str = env!("LUCH_COMMIT");
/// The version line of the compiler that made the program.
pub const COMPILER: &str = env!("LUCH_RUSTC");
/// The program's own version.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The machine. Known in full on Linux; elsewhere, what the standard library knows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Machine {
    /// The processor's name; `unknown` and its architecture where the system does not say.
    pub cpu: String,
    /// Threads that may run at once, at least 1.
    pub logical_cores: usize,
    /// All of it, used or not.
    pub memory_bytes: Option<u64>,
    /// The operating system and its release.
    pub system: String,
}

impl Machine {
    /// This machine. What cannot be found out is `unknown`, `None` or 1.
    pub fn read() -> Machine {
        let of = |path: &str| fs::read_to_string(path).unwrap_or_default();
        let system = system(
            &of("/proc/sys/kernel/ostype"),
            &of("/proc/sys/kernel/osrelease"),
        );
        Machine {
            cpu: cpu(&of("/proc/cpuinfo")).unwrap_or_else(|| format!("unknown ({ARCH})")),
            logical_cores: available_parallelism().map_or(1, usize::from),
            memory_bytes: kibibytes(&of("/proc/meminfo"), "MemTotal"),
            system: system.unwrap_or_else(|| format!("{OS} {ARCH}")),
        }
    }
}

/// The most memory this process has ever had at once, in bytes. It never falls: of several runs in one process, it
/// tells only of the largest. `None` where the system does not say.
pub fn peak_memory() -> Option<u64> {
    kibibytes(&fs::read_to_string("/proc/self/status").ok()?, "VmHWM")
}

/// The processor's name in the text of `/proc/cpuinfo`.
fn cpu(text: &str) -> Option<String> {
    field(text, "model name").map(str::to_owned)
}

/// Bytes, from a field in "kB", which means KiB there.
fn kibibytes(text: &str, name: &str) -> Option<u64> {
    let count = field(text, name)?.strip_suffix("kB")?.trim_end();
    count.parse::<u64>().ok()?.checked_mul(1024)
}

/// What stands behind `name:`, on the first line that has it.
fn field<'a>(text: &'a str, name: &str) -> Option<&'a str> {
    let mut fields = text.lines().filter_map(|line| line.split_once(':'));
    let (_, value) = fields.find(|(key, _)| key.trim() == name)?;
    Some(value.trim()).filter(|value| !value.is_empty())
}

/// `Linux 6.1.0`.
fn system(kind: &str, release: &str) -> Option<String> {
    let (kind, release) = (kind.trim(), release.trim());
    let known = !kind.is_empty() && !release.is_empty();
    known.then(|| format!("{kind} {release}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_processor_is_the_first_model_name() {
        let text = "processor\t: 0\nmodel name\t: Some(R) CPU: 3 GHz\n\nprocessor\t: 1\nmodel name\t: Another\n";
        assert_eq!(cpu(text).as_deref(), Some("Some(R) CPU: 3 GHz"));
    }

    #[test]
    fn a_processor_without_a_name_has_none() {
        for text in [
            "",
            "model name",
            "model name:\n",
            "processor : 0\nmodel : 7",
            "\0\u{fffd}:",
        ] {
            assert_eq!(cpu(text), None);
        }
    }

    #[test]
    fn memory_is_in_bytes() {
        let text = "MemFree:  1 kB\nMemTotal:       24731700 kB\n";
        assert_eq!(kibibytes(text, "MemTotal"), Some(24_731_700 * 1024));
        let status = "Name:\tluch\nVmPeak:\t    3060 kB\nVmHWM:\t    1672 kB\n";
        assert_eq!(kibibytes(status, "VmHWM"), Some(1_712_128));
    }

    #[test]
    fn memory_that_is_no_number_of_kilobytes_is_unknown() {
        for text in [
            "",
            "MemTotal:",
            "MemTotal: 5",
            "MemTotal: -5 kB",
            "MemTotal: kB",
            "MemTotal: 18446744073709551615 kB",
        ] {
            assert_eq!(kibibytes(text, "MemTotal"), None);
        }
    }

    #[test]
    fn a_system_has_a_kind_and_a_release() {
        assert_eq!(
            system("Linux\n", "6.1.0-1\n").as_deref(),
            Some("Linux 6.1.0-1")
        );
        assert_eq!(system("Linux\n", ""), None);
    }

    #[test]
    fn every_machine_and_every_program_can_be_described() {
        let machine = Machine::read();
        assert!(machine.logical_cores > 0);
        for text in [&machine.cpu, &machine.system, COMMIT, COMPILER, VERSION] {
            assert!(!text.is_empty());
        }
    }
}
