"""Charts of a task: what a chart answers, the one of speed against accuracy, all of a case as text and files."""

from __future__ import annotations

import math
import os
import platform
import re
import textwrap
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import astuple, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar, cast

import numpy as np

from ...drawing.charts.paper import SUFFIXES as PICTURES
from ...drawing.charts.paper import saved
from ...drawing.charts.race import accuracy_page
from ...drawing.words import Words
from ...drawing.writers import Files
from ...plans.hands.shaky import PRESETS, Hand, preset
from ...plans.lab.race import FULL, Contest, Entry
from ...plans.laws import TURN
from ...plans.linkages.cycle import Cycle
from ...scales.errors import InputError, KulmanError
from ...scales.names import all_known, names_of, of_its_kinds
from ...scales.numbers import quote
from ...scales.units import parse, unit
from ...scales.version import __version__
from ..case import Case, Request, Settings, Wanted, beside, positions_of
from ..hands import is_own
from ..reader import load_task
from ..tables import FILES, Cell, OfCase, Result, Table, aligned, picture, plain
from ..task import AnyTask, LocatedError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SUFFIXES = (*PICTURES, *FILES)
PAGED = ".pdf"  # one file holds all pictures
TOLERANCE = 1.0  # per cent
HAND = "normal"
WRONG = ("quantity-unknown", "quantity-unknown-like")  # what is wrong on every chart
DIGITS = 3
LINE = 110  # characters
PERCENT = 100.0
PLACES = {"rad": ("place", "deg"), "m": ("place", "mm"), "s": ("t", "s")}  # in files: what they are called, their unit
EFFORT = FULL
HANDS: Mapping[str, Hand] = {name: found.hand for name, found in PRESETS.items()}
HEAD = ("method", "setting", "kind", "error", "typical", "quantity")  # errors in parts of the largest: without a unit
TIMES = ("seconds [s]", "at_once", "failed", "front")
Advance = Callable[[int, int], None]
Found = TypeVar("Found")  # what has been found, for a chart


@dataclass(frozen=True, slots=True)
class Scene:
    """What charts are made of: a case, its words, what is asked; cycles by their numbers of positions."""

    case: Case
    words: Words
    hand: str  # the name of the one that draws
    quantities: tuple[str, ...] = ()  # none: all
    positions: int | None = None  # of the cycle; None: the chart's own
    tolerance: float = TOLERANCE  # per cent
    cycles: dict[int, Cycle] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Refuse a hand that nobody knows, and one of the user's own."""
        if is_own(self.hand):
            raise InputError("hand-chart", text=quote(self.hand), known=", ".join(PRESETS))
        preset(self.hand)

    def title(self, key: str) -> str:
        """Return the title of a chart."""
        task = self.case.task
        of = self.words["chart.variant"].format(title=task.title[self.words.language], variant=self.case.variant)
        return f"{self.words[key]}. {of}"


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Chart(ABC, Generic[Found]):
    """One chart of a variant: a table, rows, data, a picture; `heading` is the key of what it shows."""

    heading: ClassVar[str]
    noted: ClassVar[str] = ""  # key of what the numbers mean, of a picture and mostly of the table
    page: ClassVar[Callable[..., Figure]]  # draws what has been found, with words, a title and a note
    scene: Scene
    found: Found

    def __repr__(self) -> str:
        """Return which one it is."""
        return f"<Chart {self.heading.removeprefix('chart.')}>"

    def table(self, words: Words) -> str:
        """Return it as text: its parts, then what the numbers mean."""
        return "\n\n".join(part for part in (*self._parts(words), textwrap.fill(self.note(words), LINE)) if part)

    def _parts(self, words: Words) -> Iterable[str]:
        """Go through the tables and sentences that it is told by."""
        return ()

    def note(self, words: Words) -> str:
        """Return what the numbers mean."""
        return words[self.noted] if self.noted else ""

    @abstractmethod
    def _rows(self) -> Iterable[Sequence[Cell]]:
        """Go through the rows of files, the head first."""

    def data(self, words: Words) -> Table:
        """Return all its rows."""
        columns, *rows = map(tuple, self._rows())
        heads = (re.sub(r"(?<= \[).+(?=]$)", lambda of: words.spelled(of[0]), str(head)) for head in columns)
        return Table((*heads,), tuple(rows), words.language, self.scene.title(self.heading))

    @abstractmethod
    def _data(self) -> dict[str, Any]:
        """Return it as data in SI."""

    def to_json(self) -> dict[str, Any]:
        """Return it as data in SI, null in the place of what is no number."""
        return cast("dict[str, Any]", plain(self._data()))

    def _shown(self, words: Words) -> tuple[Any, ...]:
        """Return what the picture shows beside what has been found."""
        return ()

    def figure(self, words: Words) -> Figure:
        """Draw the picture."""
        title = self.scene.title(self.heading)
        return type(self).page(self.found, words, title, self.note(words), *self._shown(words))


# the charts of a subject by name: what makes each, and which arguments change it; the maker raises InputError where the
# case cannot have it, PositionError where no position of a cycle can be assembled
Gallery = Mapping[str, tuple[Callable[[Scene], Chart[Any]], tuple[str, ...]]]


@dataclass(frozen=True, slots=True)
class Places:
    """Places of the driver, or times, by their SI unit: `rad`, `m`, `s`; `name` is that of the driver's variable."""

    unit: str
    name: str = ""

    def head(self, words: Words) -> str:
        """Return the name of the driver's variable with its unit."""
        return f"{self.name}, {words.spelled(PLACES[self.unit][1])}"

    def told(self, words: Words, at: float) -> str:
        """Return one with its unit, an angle within a turn."""
        if self.unit == "rad":
            return f"{words.number(round(math.degrees(at) % 360.0, 2) % 360.0, 2)}°"
        return f"{words.short(at * 1e3, 6)} {words.spelled('mm')}"

    @property
    def column(self) -> str:
        """The head of a column of files with them."""
        return "{} [{}]".format(*PLACES[self.unit])

    def shown(self, at: float) -> float:
        """Return one in the unit of the column, an angle within a turn."""
        value = unit(PLACES[self.unit][1]).from_si(at)
        return float(round(value % 360.0, 9) % 360.0 if self.unit == "rad" else value)

    def si(self, at: float) -> float:
        """Return one for JSON, an angle in [0, 2 pi)."""
        return float(at % TURN % TURN if self.unit == "rad" else at)  # -1e-17 % TURN is TURN


def short(words: Words, value: float | None, digits: int = DIGITS) -> str:
    """Return a number for a table, small ones with a power of ten; a dash for none."""
    if value is None or not math.isfinite(value):
        return "–"
    if value and not 1e-4 <= abs(value) < 1e6:
        return words.decimal(f"{value:.{digits - 1}e}")
    return words.short(value, digits)


def per_cent(part: float | None) -> float | None:
    """Return a part in per cent, None for none."""
    return None if part is None else PERCENT * part


def error_rows(
    label: str, settings: Sequence[str], errors: Iterable[Iterable[float]], last: Sequence[str], words: Words
) -> list[list[str]]:
    """Return rows of a table: errors in parts, a column for each quantity, as per cents for every setting.

    The label stands before the first of them, and at the end what is said `last`.
    """
    cells = ([short(words, PERCENT * float(error)) for error in row] for row in zip(*errors, strict=True))
    rows = [["", setting, *row] for setting, row in zip(settings, cells, strict=True)]
    rows[0][0] = label
    return [*rows, ["", *last]]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class AccuracyChart(Chart[Contest]):
    """Speed against accuracy: an entry for every method, setting and kind of quantities.

    `places` are those of entries; `compared` is the key of what errors and times are.
    """

    heading, page = "chart.accuracy", staticmethod(accuracy_page)
    places: Places
    compared: str = "chart.compared"

    def table(self, words: Words) -> str:
        """Return a row for every method and setting: error and time by kinds; * where no other method beats it."""
        kinds = [kind.name for kind in self.found.kinds]
        head = [words["chart.method"], words["chart.setting"]]
        head += [text for kind in kinds for text in (words[f"chart.kind.{kind}"], words["chart.seconds"], "")]
        fronts = {kind: set(map(id, self.found.front(kind))) for kind in kinds}
        rows: dict[tuple[str, float | str], dict[str, list[str]]] = {}
        for entry in self.found.entries:
            row = rows.setdefault((entry.method, entry.setting), {})
            mark = "*" if id(entry) in fronts[entry.kind] else ""
            row[entry.kind] = [short(words, entry.error), short(words, entry.seconds), mark]
        lines = [head]
        for (method, setting), row in rows.items():
            shown = words.decimal(f"{setting:g}" if isinstance(setting, float) else str(setting))
            cells = [cell for kind in kinds for cell in row.get(kind, ["", "", ""])]
            lines.append([words[f"chart.{method}"], shown, *cells])
        marked = words["chart.front_mark"].format(text=words["chart.key.front"])
        notes = (textwrap.fill(line, LINE) for line in self.note(words).split("\n"))
        return "\n".join((aligned(lines), "", marked, *notes))

    def note(self, words: Words) -> str:
        """Return how and on what it was measured."""
        batch = words.number(self.found.effort.at_once, 0)
        return f"{words[self.compared].format(positions=len(self.found.places), batch=batch)}\n{_machine(words)}"

    def _rows(self) -> Iterator[tuple[Cell, ...]]:
        yield (*HEAD, self.places.column, *TIMES)
        for entry in self.found.entries:
            item = self._item(entry)
            item |= {"at": self.places.shown(entry.place), "front": int(item["front"])}
            yield tuple(item.values())

    def _data(self) -> dict[str, Any]:
        """Return all entries as data."""
        return {
            "machine": _machine(Words.of("en", self.scene.case.task.notation)),
            "hand": self.scene.hand,
            "places": [self.places.si(at) for at in self.found.places],
            "entries": [self._item(entry) for entry in self.found.entries],
        }

    def _item(self, entry: Entry) -> dict[str, Any]:
        """Return an entry as data, in the order of the columns of the CSV."""
        front = any(entry is one for one in self.found.front(entry.kind))
        item = dict(zip((*HEAD, "at", "seconds", "at_once", "failed"), astuple(entry), strict=True))
        return item | {"at": self.places.si(entry.place), "front": front}

    def _shown(self, words: Words) -> tuple[Any, ...]:
        return self.scene.hand, self.places.unit


def _machine(words: Words) -> str:
    """Return the machine and the versions on which times were measured."""
    return words["chart.machine"].format(
        machine=f"{platform.system()} {platform.machine()}",
        cores=os.cpu_count() or 1,
        python=platform.python_version(),
        numpy=np.__version__,
        version=__version__,
    )


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Charts(OfCase):
    """Charts of one variant of a task, by name: of a linkage `accuracy`, `stability`, `depth`.

    A PDF of them has a page for each; of other kinds there is a file for each, `x-accuracy.svg`, `x-stability.svg`, or
    `x.svg` where there is one chart only. `warnings` say which chart has been left out, and why, and what changes
    nothing on those that are wanted.
    """

    suffixes = SUFFIXES
    charts: dict[str, Chart[Any]]
    warnings: tuple[KulmanError, ...] = ()

    def __getitem__(self, name: str) -> Chart[Any]:
        """Return a chart by its name."""
        all_known("chart-unknown", [name], self.charts)
        return self.charts[name]

    def table(self, language: str | None = None) -> str:
        """Return all charts as text."""
        words = self._words(language)
        parts = (f"{words[chart.heading]}\n\n{chart.table(words)}" for chart in self.charts.values())
        return "\n\n\n".join(parts)

    def to_json(self) -> dict[str, Any]:
        """Return what `kulman chart --json` prints: everything in SI."""
        head = {"task": self.task.id, "variant": self.variant}
        return head | {name: chart.to_json() for name, chart in self.charts.items()}

    def drawn(self) -> list[Figure]:
        """Draw the pictures of all charts."""
        return [chart.figure(self.words) for chart in self.charts.values()]

    def _files(self, path: Path, drawn: Callable[[], Sequence[Figure]]) -> Files:
        """Return the files that a path stands for."""
        suffix = path.suffix.lower()
        names = list(self.charts)
        if suffix == ".json":
            return Result._files(self, path, drawn)
        several = len(names) > 1 and suffix != PAGED
        targets = [path.with_name(f"{path.stem}-{name}{path.suffix}") for name in names] if several else [path]
        if suffix not in FILES:
            return list(zip(targets, saved(drawn(), suffix), strict=True))
        charts = zip(targets, self.charts.values(), strict=True)
        return [(target, chart.data(self.words).file(suffix)) for target, chart in charts]

    def data(self, language: str | None = None) -> Table:
        """Return the rows of the only chart; of several each has its own."""
        if len(self.charts) > 1:
            raise InputError("chart-several", known=", ".join(self.charts))
        [only] = self.charts.values()
        return only.data(self._words(language))

    def _repr_html_(self) -> str:
        """Show the pictures and the table in a notebook."""
        titles = (chart.scene.title(chart.heading) for chart in self.charts.values())
        shown = map(picture, saved(self.drawn(), ".svg"), titles)
        tables = (chart.data(self.words).small() for chart in self.charts.values())
        return "".join((*shown, *tables))

    def __repr__(self) -> str:
        """Return task, variant and the names of the charts."""
        return f"<Charts {self.task.id} {self.variant}: {', '.join(self.charts)}>"


@of_its_kinds()
def chart(
    task: AnyTask,
    variant: str | int | None = None,
    *,
    set: Settings | None = None,
    only: Wanted = None,
    scales: Settings | None = None,
    chart: Wanted = None,
    positions: int | None = None,
    quantities: Wanted = None,
    tolerance: str | float = TOLERANCE,
    hand: str = HAND,
    notation: str | None = None,
    lang: str | None = None,
    advance: Advance | None = None,
) -> Charts:
    """Measure one variant of a task.

    Parameters
    ----------
    task, variant, set, only, scales, notation, lang
        As for `solve`.
    chart : str or iterable of str, optional
        Of a linkage `accuracy`, `stability`, `depth`, of a cam `sections`, `accuracy`, `stability`, of gears
        `scale`, of a hoist `accuracy`, `stability`, `roots`, `depth`, `choice`; all when left out.
    positions : int, optional
        Positions of the cycle of a linkage that are looked at: 24 for `accuracy`, else 120 when left out.
    quantities : str or iterable of str, optional
        Names of quantities, `"V_B,a_B,M_bal"`; when left out all that can be compared, for `stability` of a linkage the
        motion of the output and what balances the driver.
    tolerance : str or number
        Per cent by which a simpler model may miss.
    hand : str
        Preset of the hand that draws: `cad`, `careful`, `normal`, `lenient`.
    advance : callable, optional
        Is told how many charts more are made, and of how many.

    Returns
    -------
    Charts

    Raises
    ------
    InputError
        As for `solve`; also an unknown chart, quantity or hand, a number of positions that makes no cycle.
    PositionError
        The mechanism cannot be assembled in any position.

    >>> from kulman.variants.charts.charts import chart
    >>> chart("nau-slider-crank", "example", chart="depth", positions=36)["depth"].found.needed
    ('F_i2', 'M_i2', 'F_i3')
    """
    language = "en" if lang is None else lang
    case = Request(load_task(task), variant, set, only, scales, notation, language).case()
    gallery: Gallery = beside(case.task, "charts").CHARTS
    names, wanted = names_of("chart", chart), names_of("quantities", quantities)
    all_known("chart-unknown", names, gallery)
    if positions is not None:
        positions_of(positions)
    most = _per_cent(tolerance)
    scene = Scene(case, case.words(), hand, wanted, positions, most)
    changed = {"quantities": bool(wanted), "hand": hand != HAND}
    changed |= {"tolerance": most != TOLERANCE, "positions": positions is not None}
    made, warnings = names or tuple(gallery), list[KulmanError]()
    for name, other in changed.items():
        if other and not any(name in gallery[each][1] for each in made):
            warnings.append(InputError("chart-unused", name=f"--{name}", charts=", ".join(made)))
    found: dict[str, Chart[Any]] = {}
    for name in made:
        try:
            found[name] = gallery[name][0](scene)
        except InputError as error:  # of all charts one that the task cannot have is left out
            if names or error.key in WRONG:
                raise
            warnings.append(error)
        if advance is not None:
            advance(1, len(made))
    if not found:
        raise next(error for error in warnings if error.key != "chart-unused")
    return Charts(scene.case, scene.words, found, tuple(warnings))


def _per_cent(tolerance: str | float) -> float:
    """Return a tolerance in per cent, zero or more."""
    per_cent = unit("%")
    try:
        most = parse(tolerance, per_cent, per_cent) * 100.0 if isinstance(tolerance, str) else float(tolerance)
    except InputError as error:
        raise LocatedError("--tolerance", error) from error
    if not (math.isfinite(most) and most >= 0.0):
        raise LocatedError("--tolerance", InputError("negative", text=quote(tolerance)))
    return most
