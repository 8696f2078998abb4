"""POV-Ray, from the system. It reads its own language alone: the driver converts before, and it parses in its own time."""

from pathlib import Path

from peer import Row, first_line_with


def rows(place):
    """Its own ray tracing: what luch does, the nearest of kin."""
    program = place.program("povray")
    version = first_line_with([program, "--version"], "POV-Ray 3").removeprefix("POV-Ray ")
    return [Row("POV-Ray", version, False, lambda job, path: command(program, job), needs="pov")]


def command(program, job):
    """The command line. Method 1 at a threshold of 0 takes one sample and R x R more of every pixel, so one above the job's."""
    import pov

    folder = Path(job.converted)
    (folder / "scene.pov").write_text(pov.scene(job))
    side = max(1, round(job.samples**0.5))
    return [
        program, f"+I{folder / 'scene.pov'}", f"+O{job.output}", f"+L{folder}", f"+W{job.width}", f"+H{job.height}",
        f"+WT{job.threads}", "+FN", "-D", "-GA", "-J", "+AM1", "+A0.0", f"+R{side}",
    ]  # fmt: skip
