"""Sheets of cams to be judged, and what is drawn in their views."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from kulman import sheet, solve
from kulman.plans.cams.solve import SolvedCam
from kulman.tests.support.readback import Sheet, Stroke, View, read

NEAR, STEEP = 0.01, 0.05  # mm, degrees
Faults = Iterator[str]
MU = r"μ(?:[_^]\{[^}]*\})+"
MU_PHI, MU_S, MU_DS, MU_D2S, MU_L = "μ_{φ}", "μ_{s}", "μ_{ds/dφ}", "μ_{d}^{2}_{s/dφ}^{2}", "μ_{l}"
MU_S_DS, MU_S_D2S = "μ_{S(ds/dφ)}", "μ_{S(d}^{2}_{s/dφ}^{2}_{)}"  # of plans with one scale factor on both axes
DERIVATIVE = {"diagram_s": 0, "diagram_v": 1, "diagram_a": 2}


@dataclass(frozen=True)
class CamCase:
    """One cam as a task with changes, on a format, in a language."""

    changes: tuple[tuple[str, str], ...] = ()
    format: str = "A1"
    lang: str = "uk"
    task: str = "madi-cam"
    only: str | None = None

    def __str__(self) -> str:
        changed = ",".join(f"{name}={value}" for name, value in self.changes)
        return f"{self.task}-{self.format}-{self.lang}-{changed}"

    @cached_property
    def solved(self) -> SolvedCam:
        found = solve(self.task, set=dict(self.changes) or None).solved
        assert isinstance(found, SolvedCam)
        return found

    @cached_property
    def pages(self) -> tuple[str, ...]:
        changes = dict(self.changes) or None
        drawn = sheet(self.task, set=changes, only=self.only, format=self.format, lang=self.lang)
        return tuple(drawn.svg(number) for number in range(1, len(drawn.pages) + 1))

    @cached_property
    def sheet(self) -> Sheet:
        return read(*self.pages)

    @property
    def sense(self) -> int:
        return self.solved.cam.sense

    def travel(self, line: int) -> float:
        return float(self.solved.motion.at(self.solved.angles[line])[0])


def unless(good: bool, fault: str) -> Faults:
    if not good:
        yield fault


# What is drawn in a view.


def tips(view: View, name: str) -> list[complex]:
    """Tips of the arrowheads of a dimension."""
    return [t.corners[0] for t in view.tips if ("dimension", name) in t.path]


def measured(view: View, name: str) -> float:
    """Distance between the two arrowheads of a dimension, mm."""
    a, b = tips(view, name)
    return abs(b - a)


def ring(view: View, role: str, name: str) -> tuple[complex, float]:
    (found,) = [r for r in view.rings if (role, name) in r.path]
    return found.centre, found.radius


def curve(view: View, name: str) -> list[complex]:
    """All points of a curve, its pieces one after the other."""
    return [p for s in view.inside("curve", name) for p in s.points]


def level(stroke: Stroke) -> float:
    return stroke.points[0].imag


@dataclass(frozen=True)
class Diagram:
    """One diagram: where its axes meet, mm for a unit of the angle and of its ordinate."""

    origin: complex
    across: float
    up: float

    def at(self, phi: float, value: float) -> complex:
        return self.origin + complex(phi * self.across, value * self.up)


def printed_scales(view: View) -> dict[str, float]:
    """Scale factors in the headings and beside the axes of a view, by symbol, a unit a mm."""
    found = {}
    for text in view.texts:
        for symbols, number in re.findall(rf"(?<!/)((?:{MU} = )+)(\d+[.,]?\d*)", text.string):
            found |= dict.fromkeys(re.findall(MU, symbols), float(number.replace(",", ".")))
    return found


def ratio(view: View, over: str, under: str) -> float:
    """The printed ratio of two scale factors."""
    (found,) = [
        m[1] for t in view.texts if (m := re.search(re.escape(f"{over}/{under}") + r" = (\d+[.,]?\d*)", t.string))
    ]
    return float(found.replace(",", "."))


def mu_l(view: View) -> float:
    """The printed scale factor of lengths, m a mm."""
    return printed_scales(view)[MU_L]


def drawn_diagrams(case: CamCase, view: View) -> dict[str, Diagram]:
    """The diagrams from the top: their origins are read back, their scale factors are those that are printed."""
    plans = [plan for plan in DERIVATIVE if view.inside("curve", plan)]
    plans.sort(key=lambda plan: -DERIVATIVE[plan])
    x_0 = min(p.real for s in view.inside("section", "0") for p in s.points)
    axes = [s for s in view.lines("axis") if abs(s.points[0] - complex(x_0, level(s))) < NEAR]
    levels = sorted({round(level(s), 3) for s in axes if level(s) == s.points[1].imag}, reverse=True)
    mus, k = printed_scales(view), reduction(case, view)
    symbols = {"diagram_a": ("mu_d2s", MU_D2S), "diagram_v": ("mu_ds", MU_DS), "diagram_s": ("mu_s", MU_S)}
    found = {}
    for plan, y in zip(plans, levels, strict=True):
        mu = case.solved.values[symbols[plan][0]] / k
        assert abs(mus[symbols[plan][1]] / mu - 1.0) < 5e-5, f"the scale factor of {plan} is printed otherwise"
        found[plan] = Diagram(complex(x_0, y), k / case.solved.values["mu_phi"], 1.0 / mu)
    return found


def reduction(case: CamCase, view: View) -> float:
    """How many times smaller than the task says the diagrams are drawn: their printed scale factor of angles tells."""
    return float(f"{case.solved.values['mu_phi'] / printed_scales(view)[MU_PHI]:.4g}")
