"""What a whole process costs, from its start to its end."""

import os
import subprocess
import threading
import time
from typing import NamedTuple


class Cost(NamedTuple):
    """Seconds on the clock, seconds of all its threads, and the most memory it held at once, in MB (10^6 bytes)."""

    wall: float
    cpu: float
    peak_mb: float


class Failed(Exception):
    """A peer that did not draw: its last words."""


def hold_to(threads):
    """Holds this process, and all that it starts, to so many of the CPUs that it may use."""
    cpus = sorted(os.sched_getaffinity(0))
    if len(cpus) < threads:
        raise SystemExit(f"error: --threads {threads}: only {len(cpus)} CPUs are there; name no more")
    os.sched_setaffinity(0, cpus[:threads])


def cost_of(command, log, environment, limit_seconds):
    """Runs a command to its end and says what it cost, its children included; what it says goes to the file `log`."""
    with open(log, "wb") as out:
        start = time.perf_counter()
        # A small parent: Linux counts the memory of the process that forks among the child's.
        child = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT, env={**os.environ, **environment}
        )
        # It ends by itself or is ended; either way the wait below is over at that very moment.
        timer = threading.Timer(limit_seconds, child.kill)
        timer.start()
        _, status, usage = os.wait4(child.pid, 0)
        wall = time.perf_counter() - start
    timer.cancel()
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode == -9 and wall >= limit_seconds:
        raise Failed(f"not done after {limit_seconds} s; --limit allows more")
    if child.returncode != 0:
        raise Failed(f"exit code {child.returncode}: {last_line(log)}")
    return Cost(wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024 / 1e6)


def last_line(log):
    """The last line of a log that is not empty."""
    with open(log, errors="replace") as file:
        lines = [line.strip() for line in file if line.strip()]
    return lines[-1][:200] if lines else "no output"
