"""The models: those that were asked for, or else a textured one, a room and a landscape of a million triangles."""

import argparse
import os
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple, Optional

import view
from gltf import Glb, Unreadable
from peer import HERE

HELMET = "DamagedHelmet.glb"


class Asked(NamedTuple):
    """A model as the command line has it."""

    name: str
    path: str
    seen: Optional[tuple]  # Eye, target, vertical field of view in degrees, and whether a lamp lights it.


class Model(NamedTuple):
    """A model with its view and its light."""

    name: str
    path: str
    triangles: int
    eye: list
    target: list
    fov: float
    radius: float
    lamp: Optional[list]
    sun: list


def asked(text):
    """Of `room=room.glb@4,1.7,3/1,1,1/60`, with or without `/lamp`; the whole view may be missing."""
    name, _, rest = text.partition("=")
    path, _, seen = rest.partition("@")
    if not name.isidentifier() or not path:
        raise argparse.ArgumentTypeError(f"{text}: expected NAME=FILE or NAME=FILE@EYE/TARGET/FOV[/lamp]")
    return Asked(name, path, point_of_view(seen) if seen else None)


def point_of_view(text):
    """Of `4,1.7,3/1,1,1/60` or `4,1.7,3/1,1,1/60/lamp`."""
    try:
        eye, target, fov, *lamp = text.split("/")
        eye, target = ([float(a) for a in point.split(",")] for point in (eye, target))
        if len(eye) == len(target) == 3 and eye != target and lamp in ([], ["lamp"]):
            return eye, target, float(fov), bool(lamp)
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"{text}: expected EYE/TARGET/FOV[/lamp], as in 4,1.7,3/1,1,1/60")


def found(wanted, work, say):
    """The models that can be read; of the others, why not."""
    for one in wanted or usual(work, say):
        try:
            low, high, triangles = Glb(one.path).bounds()
        except Unreadable as why:
            say(f"SKIPPED model {one.name}: {why}")
            continue
        eye, target, fov, radius = view.framed(low, high)
        lamp = None
        if one.seen:
            eye, target, fov, lit = one.seen
            lamp = view.lamp_for(eye, target) if lit else None
        sun = view.sun_for(eye, target)
        yield Model(one.name, str(Path(one.path).resolve()), triangles, eye, target, fov, radius, lamp, sun)


def usual(work, say):
    """The helmet of the test models, and what generate.py makes."""
    root = os.environ.get("LUCH_TEST_MODELS")
    helmet = next(Path(root).rglob(HELMET), None) if root else None
    if helmet:
        yield Asked("helmet", str(helmet), None)
    else:
        say(f"SKIPPED model helmet: no {HELMET} below LUCH_TEST_MODELS ({root or 'not set'}); --model helmet=FILE names it")
    for name, seen in (("room", ([4.6, 1.7, 4.2], [1.6, 0.8, 0.8], 60.0, False)), ("terrain", None)):
        path = work / f"{name}.glb"
        if not path.exists():
            # In a process of its own, for memory held here would count as the peers'.
            subprocess.run([sys.executable, str(HERE / "generate.py"), name, str(path)], check=True)
        yield Asked(name, str(path), seen)
