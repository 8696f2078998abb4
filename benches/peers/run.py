#!/usr/bin/env python3
"""Times luch beside other renderers, whole processes, on the same models from the same view. README.md tells how."""

import argparse
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import models
import picture
import process
import report
from peer import HERE, Absent, Job, Place, load_peer

PEERS = ("luch", "mitsuba", "blender", "luxcore", "povray", "filly", "f3d")
# Fewer colours than this is a blank picture, or one that noise alone has filled.
FEWEST_COLOURS = 64


def main():
    arguments = parsed()
    say = Log()
    # Ended from outside, too, it leaves no display behind.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("error: terminated"))
    process.hold_to(arguments.threads)
    work = Path(arguments.work).resolve()
    work.mkdir(parents=True, exist_ok=True)
    display = start_display(say)
    try:
        rows = found_rows(arguments, say)
        cells, converted = prepared(arguments, rows, work, say)
        warm_up(cells, arguments.limit, say)
        timed(cells, arguments, say)
    finally:
        if display:
            display.terminate()
            display.wait()
    results = report.Results(arguments, cells, converted, say.lines, work)
    print("\n" + results.table())
    results.write(work / "peers")
    print(f"wrote {work / 'peers.csv'} and {work / 'peers.txt'}; pictures are in {work}")
    if arguments.record:
        results.write(HERE.parent / "record" / arguments.record)


def parsed():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False)
    add = parser.add_argument
    add("--luch", metavar="FILE", help="luch's binary, a release build")
    add("--luch-arguments", metavar="WORDS", help="one more row: luch with these arguments too")
    add("--venv", metavar="FOLDER", help="the virtual environment that has the Python packages [default: this Python]")
    add("--peers", metavar="NAMES", default=",".join(PEERS), help="with commas between [default: %(default)s]")
    add("--model", metavar="NAME=FILE[@EYE/TARGET/FOV[/lamp]]", action="append", default=[], type=models.asked,
        help="a GLB, and its view where it is not to be framed, as in room=r.glb@4,1.7,3/1,1,1/60/lamp: the lamp is for "
        "rooms that the sun does not reach; may be repeated [default: helmet, room, terrain]")  # fmt: skip
    add("--size", metavar="WxH", type=size, default=(1280, 720), help="[default: 1280x720]")
    add("--samples", metavar="N", type=int, default=4, help="a pixel [default: 4]")
    add("--bounces", metavar="N", type=int, default=2, help="at most [default: 2]")
    add("--threads", metavar="N", type=int, default=2, help="and as many CPUs, for everyone [default: 2]")
    add("--rounds", metavar="N", type=int, default=5, help="that count, after one to warm up [default: 5]")
    add("--limit", metavar="SECONDS", type=float, default=300, help="the most a picture may take [default: 300]")
    add("--work", metavar="FOLDER", default=HERE.parents[1] / "target/peers",
        help="where pictures, logs and converted models go [default: target/peers]")  # fmt: skip
    add("--record", metavar="NAME", help="keep the figures as benches/record/NAME.csv and .txt")
    return parser.parse_args()


def size(text):
    """Width and height in pixels, of `1280x720`."""
    width, height = text.split("x")
    return int(width), int(height)


class Log:
    """Says things at once, and keeps them for the record."""

    def __init__(self):
        self.lines = []

    def __call__(self, line):
        print(line, flush=True)
        self.lines.append(line)


def start_display(say):
    """An X server without a screen, for what needs one; it runs beside everything and is not timed."""
    if os.environ.get("DISPLAY") or not shutil.which("Xvfb"):
        return None
    reading, writing = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writing), "-screen", "0", "1920x1200x24", "-nolisten", "tcp"],
        pass_fds=[writing], stderr=subprocess.DEVNULL,
    )  # fmt: skip
    os.close(writing)
    with os.fdopen(reading) as number:
        display = number.readline().strip()
    if display:
        os.environ["DISPLAY"] = f":{display}"
    else:
        say("note: Xvfb is there but does not start; what needs a display is skipped")
    return server


def found_rows(arguments, say):
    """The rows of all peers that are here; the others are said, with the command that brings them."""
    python = str(Path(arguments.venv) / "bin/python") if arguments.venv else sys.executable
    if not Path(python).exists():
        sys.exit(f"error: --venv {arguments.venv}: no bin/python there; python3 -m venv {arguments.venv}")
    luch = arguments.luch and str(Path(arguments.luch).resolve())
    place = Place(python, luch, arguments.luch_arguments)
    rows = []
    for name in arguments.peers.split(","):
        if name not in PEERS:
            sys.exit(f"error: --peers {name}: no such peer; there are {', '.join(PEERS)}")
        try:
            rows += load_peer(f"with_{name}").rows(place)
        except Absent as absent:
            say(f"SKIPPED {name}: {absent}")
    if not rows:
        sys.exit("error: no renderer is here; README.md says how to get them")
    return rows


class Cell:
    """A row on one model: its job, and what every round cost."""

    def __init__(self, row, model, job, folder):
        self.row, self.model, self.job, self.folder = row, model, job, folder
        self.words = row.command(job, folder / "job.json")
        self.colours = 0
        self.failure = None
        self.costs = []

    def run(self, limit):
        """Draws once; nothing of an earlier picture is left to be taken for this one."""
        Path(self.job.output).unlink(missing_ok=True)
        # Mesa's rasteriser takes as many threads as it is told.
        environment = {"LP_NUM_THREADS": str(self.job.threads), **self.row.environment}
        return process.cost_of(self.words, self.folder / "log.txt", environment, limit)


def prepared(arguments, rows, work, say):
    """A cell for every row on every model, with what it needs converted; and the seconds that took."""
    cells, seconds = [], {}
    python = str(Path(arguments.venv) / "bin/python") if arguments.venv else sys.executable
    for model in models.found(arguments.model, work, say):
        made = {}
        for row in rows:
            if row.needs and row.needs not in made:
                folder, start = work / model.name / row.needs, time.perf_counter()
                words = [python, str(HERE / "convert.py"), model.path, str(folder), row.needs]
                done = subprocess.run(words, capture_output=True, text=True)
                made[row.needs] = str(folder) if done.returncode == 0 else None
                seconds[model.name, row.needs] = time.perf_counter() - start
                if done.returncode != 0:
                    say(f"SKIPPED on {model.name}, what needs {row.needs}: {(done.stderr.strip() or '?').splitlines()[-1]}")
            if row.needs and made[row.needs] is None:
                continue
            folder = work / model.name / "".join(c if c.isalnum() else "-" for c in row.name.lower())
            folder.mkdir(parents=True, exist_ok=True)
            job = Job(
                model.path, made.get(row.needs), str(folder / "picture.png"), *arguments.size, arguments.samples,
                arguments.threads, arguments.bounces, model.eye, model.target, model.fov, model.radius, model.lamp, model.sun,
            )  # fmt: skip
            job.write(folder / "job.json")
            cells.append(Cell(row, model, job, folder))
    return cells, seconds


def warm_up(cells, limit, say):
    """Draws everything once, uncounted: files come into memory, kernels are compiled; every picture is looked at."""
    for cell in cells:
        try:
            cell.run(limit)
            cell.colours = colours_of(cell.job)
            if cell.colours < FEWEST_COLOURS:
                cell.failure = f"blank: {cell.colours} colours, fewer than {FEWEST_COLOURS}"
        except (process.Failed, picture.NoPicture) as failure:
            cell.failure = str(failure)
        if cell.failure:
            say(f"FAILED {cell.row.name} on {cell.model.name}: {cell.failure}; {cell.folder / 'log.txt'}")


def colours_of(job):
    """The colours of a picture, counted in a process of its own: memory held here would count as the peers'."""
    words = [sys.executable, str(HERE / "picture.py"), job.output, str(job.width), str(job.height)]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        raise picture.NoPicture(done.stderr.strip().splitlines()[-1])
    return int(done.stdout)


def timed(cells, arguments, say):
    """The rounds that count. Every round gives each row its turn, so that a slow minute hits all alike."""
    for number in range(arguments.rounds):
        load = os.getloadavg()[0]
        say(f"round {number + 1} of {arguments.rounds}, load average {load:.1f}")
        for cell in cells:
            if cell.failure is None:
                try:
                    cell.costs.append(cell.run(arguments.limit))
                except process.Failed as failure:
                    cell.failure = str(failure)
                    say(f"FAILED {cell.row.name} on {cell.model.name}: {failure}")


if __name__ == "__main__":
    main()
