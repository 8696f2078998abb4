"""The figures as a table in Markdown, as CSV with every round, and the circumstances they were made in."""

import csv
import datetime
import hashlib
import io
import platform
import shlex
import statistics
import subprocess
import sys
from pathlib import Path

from peer import HERE

QUANTITIES = (("wall", "s"), ("cpu", "s"), ("peak_mb", "MB"))


class Results:
    """Everything that was measured."""

    def __init__(self, arguments, cells, converted, said, work):
        self.arguments, self.cells, self.converted, self.said, self.work = arguments, cells, converted, said, work
        self.date = datetime.datetime.now().strftime("%Y-%m-%d %H:%M")
        self.models = list({cell.model.name: cell.model for cell in cells}.values())
        self.rows = list(dict.fromkeys(cell.row.name for cell in cells))

    def cell(self, row, model):
        """The cell of a row and a model, if there is one."""
        return next((c for c in self.cells if c.row.name == row and c.model is model), None)

    def table(self):
        """A row a renderer, a column a model."""
        heads = [f"{m.name}, {m.triangles:,} triangles" for m in self.models]
        lines = ["| | " + " | ".join(heads) + " |", "| --- " * (len(heads) + 1) + "|"]
        for row in self.rows:
            cells = [self.text(self.cell(row, model)) for model in self.models]
            lines.append(f"| {row} | " + " | ".join(cells) + " |")
        told = "wall seconds (least to greatest) / CPU seconds / peak MB, times luch's wall: medians of"
        return "\n".join(lines) + f"\n\n{told} {self.arguments.rounds} rounds, whole processes\n"

    def text(self, cell):
        """A cell's medians, and its time as a multiple of luch's."""
        if cell is None:
            return "-"
        if cell.failure:
            return "failed"
        if not cell.costs:
            return "not timed"
        wall, cpu, peak = (median(cell, name) for name, _ in QUANTITIES)
        walls = [cost.wall for cost in cell.costs]
        text = f"{wall:.2f} ({min(walls):.2f} to {max(walls):.2f}) / {cpu:.2f} / {peak:.0f}"
        ours = self.cell("luch", cell.model)
        if ours and ours.costs and cell is not ours:
            text += f", {wall / median(ours, 'wall'):.1f} x"
        return text

    def write(self, path):
        """Writes `path`.csv and `path`.txt."""
        Path(f"{path}.csv").write_text(self.csv())
        text = [*self.circumstances(), "", self.table(), "command lines", *self.command_lines()]
        Path(f"{path}.txt").write_text("\n".join(text) + "\n")

    def csv(self):
        """A line for every figure, every round by itself."""
        out = io.StringIO()
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow("model triangles renderer version kind quantity median unit rounds colours failure".split())
        for cell in self.cells:
            row, model = cell.row, cell.model
            kind = "raster" if row.raster else "rays"
            known = [model.name, model.triangles, row.name, row.version, kind]
            for name, unit in QUANTITIES if cell.costs else ():
                rounds = " ".join(f"{getattr(cost, name):.4f}" for cost in cell.costs)
                writer.writerow([*known, name, f"{median(cell, name):.4f}", unit, rounds, cell.colours, cell.failure])
            if not cell.costs:
                writer.writerow([*known, "", "", "", "", cell.colours, self.plain(str(cell.failure))])
        for (model, form), seconds in self.converted.items():
            writer.writerow([model, "", f"convert.py {form}", "", "conversion", "wall", f"{seconds:.4f}", "s"] + [""] * 3)
        return out.getvalue()

    def circumstances(self):
        """What, where and when, a line each, and what the run said."""
        a = self.arguments
        versions = {cell.row.name: cell.row.version for cell in self.cells}
        own = self.plain(shlex.join(["run.py", *sys.argv[1:]]))
        conversions = ", ".join(f"{m} {form} {s:.1f} s" for (m, form), s in self.converted.items())
        return [
            f"commit       {commit()}",
            f"command      {own}",
            f"binary       luch, sha256 {digest(a.luch)}",
            f"date         {self.date}",
            f"cpu          {processor()}, {a.threads} CPUs used; Linux {platform.release()}",
            f"picture      {a.size[0]} x {a.size[1]}, {a.samples} samples a pixel, at most {a.bounces} bounces",
            f"conversions  not in the times: {conversions or 'none'}",
            *(f"version      {name}: {version}" for name, version in versions.items()),
            "",
            *map(self.plain, self.said),
        ]

    def command_lines(self):
        """Every row's, on the first model."""
        return [
            f"  {cell.row.name}: {self.plain(shlex.join(cell.words))}"
            for cell in self.cells
            if cell.model is self.models[0]
        ]

    def plain(self, text):
        """A text without the folders of this machine."""
        folders = [(str(self.work), "WORK"), (str(HERE), "benches/peers")]
        if self.arguments.venv:
            folders.append((str(self.arguments.venv).rstrip("/"), "VENV"))
        if self.arguments.luch:
            folders += [(str(Path(self.arguments.luch).resolve()), "luch"), (self.arguments.luch, "luch")]
        folders += [(str(Path(model.path).parent), "MODELS") for model in self.models]
        folders += [(str(Path(asked.path).parent), "MODELS") for asked in self.arguments.model]
        for folder, name in sorted(folders, key=lambda pair: -len(pair[0])):
            text = text.replace(folder, name) if len(folder) > 1 else text
        return text


def median(cell, quantity):
    """The median over the rounds."""
    return statistics.median(getattr(cost, quantity) for cost in cell.costs)


def commit():
    """The project's commit, and whether the work tree differs from it. Not that of the binary, which --luch names."""
    ask = lambda *words: subprocess.run(["git", "-C", str(HERE), *words], capture_output=True, text=True).stdout.strip()
    changed = " and changes since" if ask("status", "--porcelain", "--untracked-files=no") else ""
    return (ask("rev-parse", "--short", "HEAD") or "unknown") + changed


def digest(path):
    """The first digits of a file's SHA-256; it is read in pieces, for memory held here would count as the peers'."""
    if path is None:
        return "none"
    found = hashlib.sha256()
    with open(path, "rb") as file:
        while piece := file.read(65536):
            found.update(piece)
    return found.hexdigest()[:16]


def processor():
    """The CPU by its own name."""
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor() or "unknown"
