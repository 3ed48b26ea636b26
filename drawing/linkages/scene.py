"""What every view of a linkage needs: the solved mechanism, scale factors, words, and sizes of the format."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ...plans.board import POSITION
from ...plans.linkages.mechanism import Driver
from ...plans.linkages.solved import SolvedLinkage
from ...plans.linkages.structure import Structure
from ...plans.names import inertia, rate, role
from ...plans.quantities import unit_of
from ...scales.scale import Scale
from ..formats import Style
from ..printed import segment_decimals
from ..shapes import Vector
from ..words import Given as Given
from ..words import Words

if TYPE_CHECKING:
    from ...plans.linkages.cycles.swept import Runs

DRIVER = "driver"  # the figure of the driver apart, among the plans that have scale factors
ROUNDING = 1e-12  # part of the largest quantity of its unit below which a value is nothing but rounding


@dataclass(frozen=True, slots=True)
class Scene:
    """A solved mechanism on a certain format, in certain words; `scales` are by plan, `runs` of sliders by guide."""

    solved: SolvedLinkage
    scales: Mapping[str, Scale]
    words: Words
    style: Style
    givens: Mapping[str, Given]  # what the task states, in its own units
    runs: Runs = field(default_factory=dict)
    _largest: dict[str, float] = field(default_factory=dict, compare=False)

    def mm(self, mark: str) -> complex:
        """Return a mark in mm from the origin of its plan."""
        plan = role(mark).plan
        return self.solved.point(mark) * (1.0 / self.scales[plan].mu)

    def direction(self, name: str) -> complex:
        """Return the unit direction of a vector, or 0 when it is zero."""
        size = self.solved.size(name)
        return 0j if self.vanishes(name) else complex(self.solved.values[name]) / size

    def vanishes(self, name: str) -> bool:
        """Whether a quantity is zero, or rounding beside the largest of its unit."""
        unit = unit_of(role(name).shown)
        if unit not in self._largest:
            sizes = (abs(q.value or 0.0) for q in self.solved.quantities.values() if q.unit == unit)
            self._largest[unit] = max(sizes, default=0.0)
        return self.solved.size(name) <= ROUNDING * self._largest[unit]

    def defined(self, name: str) -> bool:
        """Whether a value exists and is a number."""
        value = self.solved.values.get(name)
        return value is not None and value == value

    def vector(self, name: str, tail: str, tip: str) -> Vector:
        """Return the vector `name` of a plan from one mark to another."""
        scale = self.scales[role(tail).plan]
        a, b = self.mm(tail), self.mm(tip)
        size = self.solved.size(name) if name in self.solved.values else abs(b - a) * scale.mu
        return Vector(a, b, name, size, scale.unit, scale.mu, title=name)

    def segment(self, name: str) -> str:
        """Return the printed millimetres of a quantity that a plan shows."""
        item = self.solved.quantities[name]
        value = item.value or 0.0
        plan = self.figure_of(name)
        places, _ = segment_decimals(value, self.scales[plan].mu)
        return self.words.number(abs(value) / self.scales[plan].mu, places)

    def figure_of(self, name: str) -> str:
        """Return the plan, or the figure with a scale factor of its own, on which a quantity is a segment, or ""."""
        plan = self.solved.shown_on.get(name, "")
        own = plan == POSITION and DRIVER in self.scales and name in arms_of_driver(self.solved)
        return DRIVER if own else plan

    def letter(self, vector: str) -> str:
        """Return the letter of a vector, with its bar."""
        return self.words.symbol(role(vector).shown, bar=True)

    def heading(self, key: str, *plans: str, **fill: str) -> tuple[str, ...]:
        """Return the heading lines of a view: its name and the scale factors of `plans`."""
        scales = dict.fromkeys(self.words.scale(self.scales[plan]) for plan in plans)
        return (self.words[key].format(**fill), *scales)


def plan_heading(words: Words, structure: Structure, plan: str) -> str:
    """Return the heading of a plan; that of a plan of forces names its group or its link."""
    drawn = role(plan)
    if drawn.kind != "forces":
        return words[f"heading.{plan}"]
    links = structure.parts.get(drawn.of, ())
    if len(links) > 1:
        return words["heading.group_forces"].format(links=", ".join(map(str, links)))
    return words["heading.link_forces"].format(link=drawn.of)


def arms_of_driver(solved: SolvedLinkage) -> frozenset[str]:
    """Return the arms about the driver's pivot of the forces on the driver, which its own figure shows."""
    driver = solved.mechanism.driver
    if not isinstance(driver, Driver):
        return frozenset()
    loads = {load.name for load in solved.mechanism.loads_on(driver.link)}
    forces = {inertia("F", driver.link), rate("G", driver.link), *loads}
    forces |= {solved.mechanism.pair("R", link.number, driver.link) for link in solved.mechanism.links}
    taken = {s.name for s in solved.program if s.verb == "moment" and s.operands[0] in forces}
    taken &= {s.name for s in solved.program if s.verb == "moment" and s.operands[2] == driver.pivot}
    return frozenset(s.name for s in solved.program if s.verb == "arm" and s.operands[0] in taken)
