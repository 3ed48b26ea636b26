"""Speed against accuracy: error across, time per position upwards, one field for each kind of quantities."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from ...plans.lab.cams import BOARD, BOARDS, CLOSED, MIDPOINT, MISSED, SIMPSON, TRAVELS, VELOCITIES
from ...plans.lab.finders import BISECTION, BRENT, ILLINOIS, SECANT
from ...plans.lab.finders import NEWTON as NEWTON_ROOT
from ...plans.lab.hoists import COURSE, DRAWN, FORMULAS, LIFT_OFF, PEAK
from ...plans.lab.hoists import MISSED as MISSED_LIFT_OFF
from ...plans.lab.integrators import EXPLICIT, RK4, SYMPLECTIC, TRAPEZOID, VERLET
from ...plans.lab.linkages import CHORDS, DIFFERENCES, EXTENDED, HAND, NEWTON, PLAN, SINGLE
from ...plans.lab.race import Contest, Entry
from ..words import Words
from .paper import BLACK, GREY, SMALL, TEXT, Label, box, page, put

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FIELDS = ((24.0, 116.0), (164.0, 116.0), (24.0, 25.0), (164.0, 25.0))  # left and bottom of four fields, mm
SIZE = (126.0, 60.0)
BAND, PAPER = 14.0, 3.2  # mm above a field with bars of the hand, which has no time; a row of it
RING = 10.0  # pixels around the middle of a ring that stay free of labels
OF_HOIST = (LIFT_OFF, COURSE, PEAK)
# in parts of something else than vectors
ERRORS = {TRAVELS: "chart.error.travel", VELOCITIES: "chart.error.speed"}
ERRORS |= {kind: f"chart.error.{kind}" for kind in OF_HOIST}
TIMES = dict.fromkeys(OF_HOIST, "chart.time.hoist")  # of something else than a position
SECTIONED = (CHORDS, BOARD, BOARDS, MIDPOINT, MISSED, SIMPSON, DRAWN)  # methods whose setting is a number of sections
LARGEST = 3.0  # error beyond which a method means nothing


@dataclass(frozen=True, slots=True)
class Look:
    """How a method is drawn: its marker, filled or not, the line between its points, where labels go."""

    marker: str
    filled: bool
    line: Any
    prefer: tuple[float, float]
    words: str

    @property
    def face(self) -> dict[str, Any]:
        """How matplotlib draws the marker."""
        return {"ms": 4.2, "mfc": BLACK if self.filled else "white", "mec": BLACK, "mew": 0.9}


LOOKS: Mapping[str, Look] = {
    PLAN: Look("o", True, "-", (1, 0), "plan"),
    SINGLE: Look("s", False, "", (0, -1), "plan-single"),
    EXTENDED: Look("s", False, "", (0, 1), "plan-single"),
    NEWTON: Look("^", False, (0, (5, 2)), (0, 1), "newton"),
    DIFFERENCES: Look("D", True, (0, (1, 1.5)), (0, -1), "differences"),
    CHORDS: Look("x", True, (0, (6, 1.5, 1, 1.5)), (1, 0), "chords"),
    CLOSED: Look("o", True, "-", (1, 0), "closed"),
    BOARD: Look("x", True, (0, (6, 1.5, 1, 1.5)), (0, 1), "board"),
    BOARDS: Look("+", True, (0, (6, 1.5, 1, 1.5)), (0, -1), "boards"),
    MIDPOINT: Look("D", True, (0, (1, 1.5)), (0, -1), "midpoint"),
    MISSED: Look("s", False, (0, (5, 2)), (0, 1), "missed"),
    SIMPSON: Look("^", False, (0, (3, 1, 1, 1)), (0, -1), "simpson"),
    FORMULAS: Look("o", True, "-", (1, 0), "hoist-closed"),
    BISECTION: Look("s", True, (0, (1, 1.5)), (0, 1), BISECTION),
    NEWTON_ROOT: Look("^", True, (0, (5, 2)), (0, -1), NEWTON_ROOT),
    SECANT: Look("D", True, (0, (3, 1, 1, 1)), (0, -1), SECANT),
    ILLINOIS: Look("v", True, (0, (6, 1.5, 1, 1.5)), (0, 1), ILLINOIS),
    BRENT: Look("P", True, (0, (10, 3)), (0, -1), BRENT),
    DRAWN: Look("+", True, (0, (3, 1, 1, 1)), (0, -1), DRAWN),
    RK4: Look("o", False, "-", (0, -1), RK4),
    MISSED_LIFT_OFF: Look("x", True, "-", (0, 1), MISSED_LIFT_OFF),
    VERLET: Look("s", False, (0, (6, 2)), (0, -1), VERLET),
    TRAPEZOID: Look("^", False, (0, (6, 1.5, 1, 1.5)), (0, 1), TRAPEZOID),
    SYMPLECTIC: Look("D", False, (0, (1, 1.5)), (0, -1), SYMPLECTIC),
    EXPLICIT: Look("v", False, (0, (10, 3)), (0, 1), EXPLICIT),
}
# steps of all integrators, and tolerances of all ways to a root, are the same
UNLABELLED = (MISSED_LIFT_OFF, VERLET, SYMPLECTIC, NEWTON_ROOT, SECANT, ILLINOIS, BRENT)
STEPPED = (RK4, TRAPEZOID, EXPLICIT)  # methods whose setting is a step
WIDELY = 8  # rows of the key that leave room for more


def accuracy_page(contest: Contest, words: Words, title: str, note: str, hand: str, places: str) -> Figure:
    """Draw a contest, with a note of how and on what it was measured, and with the name of the hand that draws.

    `places` is the SI unit of the places of entries, rad, m or s: of angles the steps are angles, too.
    """
    with page(title, note) as figure:
        placed = list(zip(contest.kinds, FIELDS, strict=False))
        shown = [field(figure, place, contest, kind.name, words) for kind, place in placed]
        _align(shown)
        for axes, (kind, place) in zip(shown, placed, strict=True):
            _hands(axes, place, [e for e in contest.of(kind.name) if e.method == HAND and e.error], words)
            letter(axes, contest, kind.name, words)
        left, bottom = FIELDS[len(shown)]
        _key(box(figure, left, bottom - 8.0, SIZE[0], SIZE[1] + BAND + 8.0), words, hand, contest, places)
    return figure


def field(figure: Figure, place: tuple[float, float], contest: Contest, kind: str, words: Words) -> Axes:
    """Draw the points and lines of one kind of quantities."""
    axes = box(figure, *place, *SIZE)
    axes.set(xscale="log", yscale="log")
    axes.set_title(words[f"chart.kind.{kind}"], fontsize=TEXT + 1.5, pad=4.0 + BAND * 72.0 / 25.4)
    for method, look in LOOKS.items():
        xs, ys = _coordinates(drawable(contest.of(kind), method))
        axes.plot(xs, ys, ls=look.line or "none", color=GREY, marker=look.marker, zorder=3, label=method, **look.face)
    xs, ys = _coordinates(e for e in contest.front(kind) if e.error and e.seconds and e.error < LARGEST)
    axes.plot(xs, ys, "o", ms=9.5, mfc="none", mec=BLACK, mew=0.7, zorder=2)
    if xs:
        axes.step(xs, ys, where="post", color=BLACK, lw=0.5, zorder=1)
    axes.set(xlabel=words[ERRORS.get(kind, "chart.error")], ylabel=words[TIMES.get(kind, "chart.time")])
    return axes


def _coordinates(entries: Iterable[Entry]) -> tuple[list[float], list[float]]:
    """Return where entries stand: errors and seconds."""
    places = [(e.error or 0.0, e.seconds or 0.0) for e in entries]
    return [x for x, _ in places], [y for _, y in places]


def drawable(entries: Iterable[Entry], method: str) -> list[Entry]:
    """Return the entries of a method that have a place in the field."""
    return [e for e in entries if e.method == method and e.error and e.seconds and e.error < LARGEST]


def _align(fields: Sequence[Axes]) -> None:
    """Give all fields the same axes, in whole powers of ten."""
    from matplotlib.ticker import LogLocator, NullFormatter, NullLocator

    lows, highs = zip(*(axes.get_ylim() for axes in fields), strict=True)
    lefts = [axes.get_xlim()[0] for axes in fields]
    low, top = 10.0 ** math.floor(math.log10(min(lows))), 10.0 ** math.ceil(math.log10(max(highs)))
    for axes in fields:
        axes.set(xlim=(10.0 ** math.floor(math.log10(min(lefts))), 10.0), ylim=(low, top))
        axes.xaxis.set_major_locator(LogLocator(100.0, numticks=20))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.yaxis.set_major_locator(LogLocator(10.0, numticks=20))
        axes.yaxis.set_minor_locator(NullLocator())
        axes.yaxis.set_minor_formatter(NullFormatter())


def letter(axes: Axes, contest: Contest, kind: str, words: Words) -> None:
    """Put a label beside every point, of steps beside the best and every second one."""
    entries = contest.of(kind)
    named = {SINGLE: "chart.float32", EXTENDED: "chart.extended"}
    rings = axes.transData.transform([(e.error or 0.0, e.seconds or 0.0) for e in contest.front(kind)] or [(1.0, 1.0)])
    labels, points = [], []
    for method, look in LOOKS.items():
        shown = drawable(entries, method)
        best = min(shown, key=lambda e: e.error or 0.0, default=None)
        for entry in shown:
            points.append((entry.error or 0.0, entry.seconds or 0.0))
            text = words[named[method]] if method in named else words.decimal(setting(entry))
            if method in UNLABELLED or (method == BISECTION and kind != LIFT_OFF):
                continue
            if method != DIFFERENCES or round(_powers(entry, best)) % 2 == 0:
                labels.append(Label(*points[-1], text, _side(entry, best, look), method in named))
    taken = [(x - RING, y - RING, x + RING, y + RING) for x, y in rings.tolist()]
    taken += [(x, y - 2.0, end, y + 2.0) for (x, y), (end, _) in pairwise(rings.tolist())]  # the line between them
    put(axes, labels, points, taken)


def _powers(step: Entry, best: Entry | None) -> float:
    """Return how many powers of ten a step is away from the best one."""
    return 0.0 if best is None else math.log10(float(step.setting) / float(best.setting))


def _side(entry: Entry, best: Entry | None, look: Look) -> tuple[float, float]:
    """Return the side of a point for its label: steps so small that rounding counts stand above the others."""
    if entry.method == PLAN:  # large batches cost about the same: their labels stand on either side
        return (1, 0) if round(math.log10(float(entry.setting))) % 2 else (-1, 0)
    if entry.method != DIFFERENCES:
        return look.prefer
    return (0, 1) if _powers(entry, best) < 0.0 else (0, -1)


def setting(entry: Entry) -> str:
    """Return the setting of a method as its point has it.

    >>> setting(Entry("plan", 1000, "velocity", None, None, "", 0.0, None, 1, 0.0))
    '$10^{3}$'
    """
    if entry.method in SECTIONED or isinstance(entry.setting, str):
        return str(entry.setting)
    if entry.method in STEPPED:
        return f"{entry.setting:g}"
    power = math.log10(entry.setting)
    return f"$10^{{{round(power)}}}$".replace("-", "−") if entry.setting != 1 else "1"


def _hands(axes: Axes, place: tuple[float, float], entries: Sequence[Entry], words: Words) -> None:
    """Draw a bar for every paper above a field, from the typical to the worst error: a hand has no time."""
    if not entries:
        return
    left, bottom = place
    band = box(axes.figure, left, bottom + SIZE[1], SIZE[0], BAND)  # type: ignore[arg-type]
    band.set(xscale="log", ylim=(BAND, 0.0), yticks=[])
    band.set_xticks(axes.get_xticks(), minor=False)
    band.set_xlim(axes.get_xlim())
    band.minorticks_off()
    band.tick_params(bottom=False, labelbottom=False)
    first = (BAND - PAPER * (len(entries) - 1)) / 2.0
    for row, entry in enumerate(entries):
        low, high, y = entry.typical or 0.0, entry.error or 0.0, first + PAPER * row
        band.plot([low, high], [y, y], marker="|", ms=5.0, color=BLACK, lw=2.0, zorder=4)
        said = f"{words['chart.hand']}: {entry.setting}"
        band.text(low / 1.6, y, said, fontsize=SMALL, va="center", ha="right")


def _key(axes: Axes, words: Words, hand: str, contest: Contest, places: str) -> None:
    """Say what markers and numbers mean."""
    axes.set_axis_off()
    axes.set(xlim=(0.0, 126.0), ylim=(SIZE[1] + BAND + 8.0, 0.0))
    present = {entry.method for entry in contest.entries}
    rows = [(look, look.words) for method, look in LOOKS.items() if method in present and method != EXTENDED]
    y = 6.0
    for look, key in rows:
        text = "differences-slide" if key == DIFFERENCES and places != "rad" else key
        axes.plot([0.0, 5.0, 10.0], [y] * 3, linestyle=look.line or "none", color=GREY, lw=1.0)
        axes.plot(5.0, y, look.marker, **look.face)
        axes.text(13.0, y, words[f"chart.key.{text}"], va="center", fontsize=TEXT)
        y += 6.5 if len(rows) <= WIDELY else 4.9
    axes.plot([0.0, 5.0, 10.0], [y] * 3, color=BLACK, lw=0.5)
    axes.plot(5.0, y, "o", ms=9.5, mfc="none", mec=BLACK, mew=0.7)
    axes.text(13.0, y, words["chart.key.front"], va="center", fontsize=TEXT)
    if HAND in present:
        y += 8.0
        axes.plot([1.0, 9.0], [y] * 2, marker="|", ms=6.0, color=BLACK, lw=2.2)
        text = textwrap.fill(words["chart.key.hand"].format(hand=words[f"hand.{hand}"]), 64)
        axes.text(13.0, y, text, va="center", fontsize=TEXT, linespacing=1.3)
