"""What the driver and the peers tell each other: jobs, rows, and where a peer is found."""

import importlib.util
import json
import math
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple, Optional

HERE = Path(__file__).resolve().parent


class Absent(Exception):
    """A peer that is not here: what is missing, and the command that brings it."""


class Job(NamedTuple):
    """One picture to draw. Lengths are in the model's units, y is up, angles are degrees."""

    model: str  # A GLB file.
    converted: Optional[str]  # The folder that convert.py made of it.
    output: str  # A PNG file.
    width: int
    height: int
    samples: int
    threads: int
    bounces: int
    eye: list
    target: list
    fov: float  # Vertical.
    radius: float  # Of a sphere about the target that holds the model.
    lamp: Optional[list]  # Where a point light hangs; None for a sun.
    sun: list  # The unit vector towards the sun.

    @property
    def near(self):
        return self.distance * 0.01

    @property
    def far(self):
        return self.distance + 4 * self.radius

    @property
    def distance(self):
        """From the eye to the target."""
        return math.dist(self.eye, self.target)

    @property
    def horizontal_fov(self):
        """The horizontal field of view, in degrees."""
        return math.degrees(2 * math.atan(math.tan(math.radians(self.fov) / 2) * self.width / self.height))

    def write(self, path):
        Path(path).write_text(json.dumps(self._asdict(), indent=1))

    @classmethod
    def read(cls, path):
        return cls(**json.loads(Path(path).read_text()))


class Row(NamedTuple):
    """A row of the table: a renderer in one of its ways of drawing."""

    name: str
    version: str
    raster: bool
    command: object  # (job, the job's file) -> the list of words that the driver runs.
    needs: Optional[str] = None  # What must be converted before: "mesh" or "pov".
    environment: dict = {}


class Place:
    """Where peers are looked for: a virtual environment, the PATH, and luch's own binary."""

    def __init__(self, python, luch, luch_arguments):
        self.python = python
        self.luch = luch
        self.luch_arguments = luch_arguments

    def module_version(self, module):
        """The version of a Python package in the virtual environment."""
        ask = "import sys; from importlib.metadata import version; print(version(sys.argv[1]))"
        done = subprocess.run([self.python, "-c", ask, module], capture_output=True, text=True)
        if done.returncode != 0:
            raise Absent(
                f"{self.python} has no package {module}; {self.python} -m pip install {module}, "
                "or name another environment with --venv"
            )
        return done.stdout.strip()

    def program(self, name):
        """The path of a program of the system."""
        path = shutil.which(name)
        if path is None:
            raise Absent(f"no program {name} on the PATH; apt-get install {name}")
        return path

    def script(self, module, variant="", arguments=()):
        """A command that draws by running one of our own files in the virtual environment."""
        file = str(HERE / f"{module}.py")
        return lambda job, path: [self.python, file, *arguments, str(path), *([variant] if variant else [])]


def first_line_with(command, word):
    """The first line that a program prints with a word in it; its version, as a rule."""
    done = subprocess.run(command, capture_output=True, text=True)
    lines = (done.stdout + "\n" + done.stderr).splitlines()
    return next((line.strip() for line in lines if word in line), "unknown")


def load_peer(name):
    """The module of a file beside this one, by name."""
    spec = importlib.util.spec_from_file_location(name, HERE / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def drawn_by(draw):
    """Runs a peer's own drawing: the first argument is the job's file, the second its variant."""
    draw(Job.read(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else "")
