//! How much memory there is to read files into, as the system says it.

use std::fs;
use std::path::Path;

/// Where a system says nothing, as all but Linux do.
const UNKNOWN: u64 = 8 << 30;

/// Three quarters of the least of what the machine has, what its control groups leave and what the process may take:
/// the rest is for the program itself and for others.
pub(super) fn usual_limit() -> u64 {
    least(Path::new("/")).unwrap_or(UNKNOWN) / 4 * 3
}

/// The least limit that a Linux system says below `root`, in bytes.
fn least(root: &Path) -> Option<u64> {
    let read = |name: &str| fs::read_to_string(root.join(name)).unwrap_or_default();
    let machine = of_machine(&read("proc/meminfo"));
    let process = of_process(&read("proc/self/limits"));
    let groups = of_groups(&read("proc/self/cgroup"), &read);
    machine.into_iter().chain(process).chain(groups).min()
}

/// As in "MemTotal:       24731700 kB".
fn of_machine(meminfo: &str) -> Option<u64> {
    let total = meminfo.lines().find_map(|l| l.strip_prefix("MemTotal:"))?;
    let kilobytes: u64 = total.split_whitespace().next()?.parse().ok()?;
    kilobytes.checked_mul(1024)
}

/// RLIMIT_DATA and RLIMIT_AS, the soft ones: as in "Max data size   1073741824   unlimited   bytes".
fn of_process(limits: &str) -> Vec<u64> {
    let soft = |name: &str| {
        let limit = limits.lines().find_map(|line| line.strip_prefix(name))?;
        limit.split_whitespace().next()?.parse().ok()
    };
    let limits = ["Max data size", "Max address space"].map(soft);
    limits.into_iter().flatten().collect()
}

/// The limits of the process's control groups and of those above them, of either version (Linux's cgroup-v2.rst and
/// cgroup-v1/memory.rst). Inside a container the groups' paths may be the host's, and its own limit stands at the top.
fn of_groups(groups: &str, read: &impl Fn(&str) -> String) -> Vec<u64> {
    let mut limits = Vec::new();
    for line in groups.lines() {
        let mut fields = line.splitn(3, ':').skip(1);
        let (Some(controllers), Some(path)) = (fields.next(), fields.next()) else {
            continue;
        };
        let (folder, file) = if controllers.is_empty() {
            ("sys/fs/cgroup", "memory.max")
        } else if controllers.split(',').any(|one| one == "memory") {
            ("sys/fs/cgroup/memory", "memory.limit_in_bytes")
        } else {
            continue;
        };
        // "max" is no number, and no limit.
        let above = Path::new(path).ancestors().filter_map(Path::to_str);
        limits.extend(above.filter_map(|group| {
            let limit = read(&format!("{folder}{}/{file}", group.trim_end_matches('/')));
            limit.trim().parse::<u64>().ok()
        }));
    }
    limits
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

    use super::*;

    fn system(files: &[(&str, &str)]) -> Option<u64> {
        let root = tempfile::tempdir().unwrap();
        for (name, text) in files {
            let path = root.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        least(root.path())
    }

    const MEMINFO: (&str, &str) = ("proc/meminfo", "MemTotal:    8000 kB\nMemFree:  1 kB\n");

    #[test]
    fn the_least_limit_counts() {
        let limits = |data: &str, space: &str| {
            format!(
                "Limit  Soft Limit  Hard Limit  Units\nMax data size  {data}  9  bytes\nMax address space  {space}  9  bytes\n"
            )
        };
        let with = |data, space| system(&[MEMINFO, ("proc/self/limits", &limits(data, space))]);
        assert_eq!(with("unlimited", "unlimited"), Some(8_192_000));
        assert_eq!(with("4096", "unlimited"), Some(4096));
        assert_eq!(with("4096", "1024"), Some(1024));
        assert_eq!(system(&[]), None);
    }

    #[test]
    fn a_control_group_and_those_above_it_bound_what_is_below() {
        let second = [
            MEMINFO,
            ("proc/self/cgroup", "0::/a/b\n"),
            ("sys/fs/cgroup/a/b/memory.max", "max\n"),
            ("sys/fs/cgroup/a/memory.max", "5000\n"),
        ];
        assert_eq!(system(&second), Some(5000));
        let first = [
            MEMINFO,
            ("proc/self/cgroup", "3:cpuset:/\n4:memory:/gone\n0::/\n"),
            ("sys/fs/cgroup/memory/memory.limit_in_bytes", "6000\n"),
        ];
        assert_eq!(system(&first), Some(6000));
    }
}
