"""Speed against accuracy: error across, time per position upwards, one field for each kind of quantities."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterable, Mapping
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

from ...plans.lab.race import Contest, Entry
from ..words import Words
from . import paper
from .paper import BLACK, CHAINED, DASHED, DOTTED, GREY, LONG, MIXED, SMALL, SOLID, TEXT, Label, box, page, put

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FIELDS = ((24.0, 116.0), (164.0, 116.0), (24.0, 25.0), (164.0, 25.0))  # left and bottom of four fields, mm
SIZE = (126.0, 60.0)
BAND, PAPER = 14.0, 3.2  # mm above a field with bars of the hand, which has no time; a row of it
RING = 10.0  # pixels around the middle of a ring that stay free of labels
# in parts of something else than vectors, and of something else than a position
ERRORS = {kind: f"chart.error.{kind}" for kind in ("travel", "speed", "lift_off", "course", "peak")}
TIMES = dict.fromkeys(("lift_off", "course", "peak"), "chart.time.hoist")
# methods whose setting is a number of sections, and those whose setting is a step
SECTIONED = ("chords", "board", "boards", "midpoint", "missed", "simpson", "hoist-drawn")
STEPPED = ("rk4", "trapezoid", "euler")
LARGEST = 3.0  # error beyond which a method means nothing
RIGHT, UP, DOWN = (1, 0), (0, 1), (0, -1)


class _Look(NamedTuple):
    """How a method is drawn: its marker, filled or not, the line between its points, where labels go."""

    marker: str
    filled: bool
    line: Any
    prefer: tuple[float, float]

    @property
    def face(self) -> dict[str, Any]:
        """How matplotlib draws the marker."""
        return {"ms": 4.2, "mfc": BLACK if self.filled else "white", "mec": BLACK, "mew": 0.9}


LOOKS: Mapping[str, _Look] = {
    "plan": _Look("o", True, SOLID, RIGHT),
    "plan-single": _Look("s", False, "none", DOWN),
    "plan-extended": _Look("s", False, "none", UP),
    "newton": _Look("^", False, DASHED, UP),
    "differences": _Look("D", True, DOTTED, DOWN),
    "chords": _Look("x", True, CHAINED, RIGHT),
    "closed": _Look("o", True, SOLID, RIGHT),
    "board": _Look("x", True, CHAINED, UP),
    "boards": _Look("+", True, CHAINED, DOWN),
    "midpoint": _Look("D", True, DOTTED, DOWN),
    "missed": _Look("s", False, DASHED, UP),
    "simpson": _Look("^", False, MIXED, DOWN),
    "hoist-closed": _Look("o", True, SOLID, RIGHT),
    "bisection": _Look("s", True, DOTTED, UP),
    "newton-root": _Look("^", True, DASHED, DOWN),
    "secant": _Look("D", True, MIXED, DOWN),
    "illinois": _Look("v", True, CHAINED, UP),
    "brent": _Look("P", True, LONG, DOWN),
    "hoist-drawn": _Look("+", True, MIXED, DOWN),
    "rk4": _Look("o", False, SOLID, DOWN),
    "rk4-missed": _Look("x", True, SOLID, UP),
    "verlet": _Look("s", False, DASHED, DOWN),
    "trapezoid": _Look("^", False, CHAINED, UP),
    "symplectic": _Look("D", False, DOTTED, DOWN),
    "euler": _Look("v", False, LONG, UP),
}
FRONT: Mapping[str, Any] = {"ms": 9.5, "mfc": "none", "mec": BLACK, "mew": 0.7}  # rings of what no other beats
# steps of all integrators, and tolerances of all ways to a root, are the same
UNLABELLED = ("rk4-missed", "verlet", "symplectic", "newton-root", "secant", "illinois", "brent")
NAMED = {"plan-single": "chart.float32", "plan-extended": "chart.extended"}
WIDELY = 8  # rows of the key that leave room for more


def accuracy_page(contest: Contest, words: Words, title: str, note: str, hand: str, places: str) -> Figure:
    """Draw a contest, with a note of how and on what it was measured, and with the name of the hand that draws.

    `places` is the SI unit of the places of entries, rad, m or s: of angles the steps are angles, too.
    """
    with page(title, note) as figure:
        shown = [
            _field(figure, place, contest, kind.name, words) for kind, place in zip(contest.kinds, FIELDS, strict=False)
        ]
        _align(shown)
        for axes, kind, (left, bottom) in zip(shown, contest.kinds, FIELDS, strict=False):
            bars = [entry for entry in contest.of(kind.name) if entry.seconds is None and entry.error]
            if bars:
                band = box(figure, (left, bottom + SIZE[1], SIZE[0], BAND), xscale="log", ylim=(BAND, 0.0), yticks=[])
                _hands(band, axes, bars, words)
            _letter(axes, contest, kind.name, words)
        left, bottom = FIELDS[len(shown)]
        key = box(figure, (left, bottom - 8.0, SIZE[0], SIZE[1] + BAND + 8.0))
        _key(key, words, words[f"hand.{hand}"], {entry.method for entry in contest.entries}, places)
    return figure


def _field(figure: Figure, place: tuple[float, float], contest: Contest, kind: str, words: Words) -> Axes:
    """Draw the points and lines of one kind of quantities."""
    axes = box(figure, (*place, *SIZE), xscale="log", yscale="log")
    axes.set_title(words[f"chart.kind.{kind}"], fontsize=TEXT + 1.5, pad=4.0 + BAND * 72.0 / 25.4)
    for method, look in LOOKS.items():
        xs, ys = _coordinates(_drawable(contest.of(kind), method))
        axes.plot(xs, ys, ls=look.line, color=GREY, marker=look.marker, zorder=3, label=method, **look.face)
    xs, ys = _coordinates(_drawable(contest.front(kind)))
    axes.plot(xs, ys, "o", zorder=2, **FRONT)
    if xs:
        axes.step(xs, ys, where="post", color=BLACK, lw=0.5, zorder=1)
    axes.set(xlabel=words[ERRORS.get(kind, "chart.error")], ylabel=words[TIMES.get(kind, "chart.time")])
    return axes


def _coordinates(entries: Iterable[Entry]) -> tuple[list[float], list[float]]:
    """Return where entries stand: errors and seconds."""
    places = [(e.error or 0.0, e.seconds or 0.0) for e in entries]
    return [x for x, _ in places], [y for _, y in places]


def _drawable(entries: Iterable[Entry], method: str = "") -> list[Entry]:
    """Return the entries of a method, of all without one, that have a place in the field."""
    return [e for e in entries if e.method == (method or e.method) and e.error and e.seconds and e.error < LARGEST]


def _align(fields: list[Axes]) -> None:
    """Give all fields the same axes, in whole powers of ten."""
    from matplotlib.ticker import LogLocator, NullFormatter, NullLocator

    lows, highs = zip(*(axes.get_ylim() for axes in fields), strict=True)
    low, top = 10.0 ** math.floor(math.log10(min(lows))), 10.0 ** math.ceil(math.log10(max(highs)))
    left = 10.0 ** math.floor(math.log10(min(axes.get_xlim()[0] for axes in fields)))
    for axes in fields:
        axes.set(xlim=(left, 10.0), ylim=(low, top))
        for axis, base in ((axes.xaxis, 100.0), (axes.yaxis, 10.0)):
            axis.set_major_locator(LogLocator(base, numticks=20))
            axis.set_minor_locator(NullLocator())
        paper.powers(axes.xaxis, axes.yaxis)
        axes.yaxis.set_minor_formatter(NullFormatter())


def _letter(axes: Axes, contest: Contest, kind: str, words: Words) -> None:
    """Put a label beside every point, of steps beside the best and every second one."""
    entries, front = contest.of(kind), zip(*_coordinates(contest.front(kind)), strict=True)
    rings = axes.transData.transform([*front] or [(1.0, 1.0)]).tolist()
    labels, points = [], []
    for method, look in LOOKS.items():
        shown = _drawable(entries, method)
        points += list(zip(*_coordinates(shown), strict=True))
        if method in UNLABELLED or (method == "bisection" and kind != "lift_off"):
            continue
        best = min(shown, key=lambda e: e.error or 0.0, default=None)
        for entry in shown:
            powers, side = 0.0, look.prefer
            if method == "differences" and best:  # steps so small that rounding counts stand above the others
                powers = math.log10(float(entry.setting) / float(best.setting))
                side = UP if powers < 0.0 else DOWN
            elif method == "plan":  # large batches cost about the same: their labels stand on either side
                side = (1, 0) if round(math.log10(float(entry.setting))) % 2 else (-1, 0)
            text = words[NAMED[method]] if method in NAMED else words.decimal(_setting(entry))
            if round(powers) % 2 == 0:
                labels.append(Label(entry.error or 0.0, entry.seconds or 0.0, text, side, method in NAMED))
    taken = [(x - RING, y - RING, x + RING, y + RING) for x, y in rings]
    taken += [(x, y - 2.0, end, y + 2.0) for (x, y), (end, _) in pairwise(rings)]  # the line between them
    put(axes, labels, points, taken)


def _setting(entry: Entry) -> str:
    """Return the setting of a method as its point has it.

    >>> _setting(Entry("plan", 1000, "velocity", None, None, "", 0.0, None, 1, 0.0))
    '10³'
    """
    if entry.method in SECTIONED or isinstance(entry.setting, str):
        return str(entry.setting)
    if entry.method in STEPPED:
        return f"{entry.setting:g}"
    return paper.power_of_ten(entry.setting) if entry.setting != 1 else "1"


def _hands(band: Axes, below: Axes, entries: list[Entry], words: Words) -> None:
    """Draw a bar for every paper above a field, from the typical to the worst error: a hand has no time."""
    band.set_xticks(below.get_xticks(), minor=False)
    band.set_xlim(below.get_xlim())
    band.minorticks_off()
    band.tick_params(bottom=False, labelbottom=False)
    first = (BAND - PAPER * (len(entries) - 1)) / 2.0
    for row, entry in enumerate(entries):
        low, high, y = entry.typical or 0.0, entry.error or 0.0, first + PAPER * row
        band.plot([low, high], [y, y], marker="|", ms=5.0, color=BLACK, lw=2.0, zorder=4)
        band.text(low / 1.6, y, f"{words['chart.hand']}: {entry.setting}", fontsize=SMALL, va="center", ha="right")


def _key(axes: Axes, words: Words, hand: str, present: set[str], places: str) -> None:
    """Say what markers and numbers mean."""
    axes.set_axis_off()
    axes.set(xlim=(0.0, 126.0), ylim=(SIZE[1] + BAND + 8.0, 0.0))
    rows = [(look, method) for method, look in LOOKS.items() if method in present and method != "plan-extended"]
    y = 6.0
    for look, method in rows:
        text = "differences-slide" if method == "differences" and places != "rad" else method
        axes.plot([0.0, 5.0, 10.0], [y] * 3, linestyle=look.line, color=GREY, lw=1.0)
        axes.plot(5.0, y, look.marker, **look.face)
        axes.text(13.0, y, words[f"chart.key.{text}"], va="center", fontsize=TEXT)
        y += 6.5 if len(rows) <= WIDELY else 4.9
    axes.plot([0.0, 5.0, 10.0], [y] * 3, color=BLACK, lw=0.5)
    axes.plot(5.0, y, "o", **FRONT)
    axes.text(13.0, y, words["chart.key.front"], va="center", fontsize=TEXT)
    if "hand" in present:
        y += 8.0
        axes.plot([1.0, 9.0], [y] * 2, marker="|", ms=6.0, color=BLACK, lw=2.2)
        text = textwrap.fill(words["chart.key.hand"].format(hand=hand), 64)
        axes.text(13.0, y, text, va="center", fontsize=TEXT, linespacing=1.3)
