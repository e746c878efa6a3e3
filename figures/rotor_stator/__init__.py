"""explore from Python: its tables as arrays and keys, and runs of it.

    import rotor_stator
    orbit = rotor_stator.run("orbit", "my.toml", frequency=25, tolerance=1e-3, plot=True)
    orbit["x_r"], orbit.value("regime"), orbit.keys(), orbit.svg
    measured = rotor_stator.read("measured.tsv")

From the clone PYTHONPATH=figures finds it; `cmake --install` puts it into
lib/python3/dist-packages.
"""
import base64
import os
import shlex
import shutil
import subprocess
import tempfile
from pathlib import Path

if not Path(__file__).with_name("tables.py").exists():  # in the clone: beside figures
    __path__.append(str(Path(__file__).parents[1]))
from .tables import Table, read  # noqa: E402

__all__ = ["NoAnswer", "Table", "attempt", "explore", "map_at", "read", "run"]


class NoAnswer(RuntimeError):
    """explore found none, status 3; `table` is what it printed until then, or None."""

    def __init__(self, why, table):
        super().__init__(why)
        self.table = table


def explore():
    """The words that run it: EXPLORE of the environment ("apptainer exec rotor.sif
    explore" has four), the program of the clone, of the installation, or of the PATH."""
    here, given = Path(__file__).resolve(), os.environ.get("EXPLORE")
    if given and not Path(given).is_file():
        return shlex.split(given)
    for file in (given, here.parents[2] / "build/explore", here.parents[4] / "bin/explore",
                 shutil.which("explore")):
        if file and Path(file).is_file():
            return [str(file)]
    raise FileNotFoundError("explore: not built, not installed; EXPLORE names it")


def words_of(options):
    """frequency=25, columns=["x_r", "y_r"], quiet=True as words; from_=1 is --from 1.
    None and False leave an option out."""
    for name, value in options.items():
        if value is not None and value is not False:
            yield "--" + name.strip("_").replace("_", "-")
            if value is not True:
                is_list = isinstance(value, (list, tuple))
                yield ",".join(map(str, value)) if is_list else str(value)


class Run(Table):
    """A table with the figure of its run: `svg`, which a notebook shows."""
    svg = None

    def _repr_html_(self):
        """As a picture: nbconvert empties an SVG that stands in a page."""
        data = base64.b64encode(self.svg.encode()).decode() if self.svg else None
        return data and f'<img alt="" src="data:image/svg+xml;base64,{data}">'


def run(command, *words, plot=None, **options):
    """The table of a run of explore; `plot=True` draws it too, a name draws into that
    file. Options stand for those of the command (`words_of`), `words` for themselves.
    What is refused raises ValueError with explore's line, what has no answer NoAnswer."""
    with tempfile.TemporaryDirectory() as folder:
        figure = Path(folder, "figure.svg") if plot is True else plot
        asked = [*explore(), command, *words, *words_of({**options, "plot": figure})]
        ran = subprocess.run([str(word) for word in asked], stdin=subprocess.DEVNULL,
                             capture_output=True, encoding="utf-8", check=False)
        has_rows = any(line and line[0] != "#" for line in ran.stdout.splitlines())
        table = Run.of(ran.stdout) if has_rows else None
        why = ran.stderr.strip()
        if ran.returncode == 3:
            raise NoAnswer(why, table)
        if ran.returncode:
            raise ValueError(why or f"explore {command}: status {ran.returncode}")
        if plot is True:
            table.svg = figure.read_text(encoding="utf-8")
        return table


def attempt(command, *words, **options):
    """The same; where there is no answer, what was found until then, or None."""
    try:
        return run(command, *words, **options)
    except NoAnswer as end:
        return end.table


def map_at(machine, keys, points, **options):
    """`explore map` over a list of points, a value for each key: the rows of a point follow each other."""
    with tempfile.NamedTemporaryFile("w", suffix=".tsv", encoding="utf-8") as listed:
        print("\t".join(keys), *("\t".join(map(str, point)) for point in points), sep="\n", file=listed, flush=True)
        return run("map", machine, list=listed.name, **options)
