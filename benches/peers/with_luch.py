"""luch itself, from the binary that --luch names: the same command that a user types."""

import shlex

from peer import Absent, Row, first_line_with


def rows(place):
    """luch with the common view and nothing else said; and once more with the arguments of --luch-arguments."""
    if place.luch is None:
        raise Absent("no --luch; cargo build --release, then --luch target/release/luch")
    version = first_line_with([place.luch, "--version"], "luch").removeprefix("luch ")
    found = [Row("luch", version, False, lambda job, path: command(place.luch, job, []))]
    if place.luch_arguments:
        extra = shlex.split(place.luch_arguments)
        name = f"luch {place.luch_arguments}"
        found.append(Row(name, version, False, lambda job, path: command(place.luch, job, extra)))
    return found


def command(luch, job, extra):
    """The command line. The equals signs let numbers begin with a minus."""
    point = lambda p: ",".join(f"{a:.9g}" for a in p)
    return [
        luch, "render", job.model, "--output", job.output, "--size", f"{job.width}x{job.height}",
        "--samples", str(job.samples), "--threads", str(job.threads), "--max-depth", str(job.bounces),
        f"--eye={point(job.eye)}", f"--target={point(job.target)}", f"--fov={job.fov}", "--quiet", *extra,
    ]  # fmt: skip
