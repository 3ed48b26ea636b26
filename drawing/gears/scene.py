"""What every view of a gear pair needs: sizes on paper, letters, scale factors."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...plans.gears.construction import MESHING, SLIDING, THETA
from ...plans.gears.geometry import POINTS
from ...plans.gears.solve import SAME, SCALES, SolvedGear
from ...plans.gears.teeth import Meshing, Wheel, wheels
from ...plans.solved import PAPER_MM
from ...scales.scale import Scale, steps
from ..extents import not_a_point
from ..figure import SubjectScene
from ..words import Words

TALL = 7.0  # heights of letters that a tooth must have for what is measured on it
OF_POINTS = {"y_1": "y_{1}", "y_2": "y_{2}", "theta_12": "θ_{12}", "theta_21": "θ_{21}"}
# rho_1 of a place, its distance from N1: by the name of a quantity
PLACES = {"A1": "rho_p1", "P": "rho_w1", "A2": "rho_a1"}
TOOTH = 50.0  # mm, by which a drawn tooth should be high at least
# mm of the line of action and of the axis of specific sliding on the diagrams, by the height of letters
ALONG, HIGH = {5.0: 250.0, 3.5: 140.0}, {5.0: 125.0, 3.5: 62.0}
CURVES = {1: "theta_12", 2: "theta_21"}  # of specific sliding
ENDS = {"A1": "rho_p1", "A2": "rho_a1"}  # of the active line, and the quantities that are their distances from N1
CUTS = 2.0, 10.0  # the least and the greatest depth at which curves are cut off
USUAL = 5.0  # where sliding has no limit on the active line
ROOM = 1.25  # how far below the extremes
UNITS = {MESHING: "m", SLIDING: "m", THETA: "1"}


@dataclass(frozen=True, slots=True)
class GearScene(SubjectScene[SolvedGear]):
    """A solved pair on a certain format, in certain words.

    `mu_l` is the scale factor of the meshing with both centres, `near` that of its middle, which has a view of its own
    where teeth are too small beside their letters, `rolled` that of the construction of the involutes;
    m/mm. `part` is how much of their usual size the diagrams of sliding have; `close` is the scene of that middle.
    """

    mu_l: float = 1.0
    near: float = 1.0
    rolled: float = 1.0
    part: float = 1.0
    close: bool = False

    @property
    def meshing(self) -> Meshing:
        """The teeth and how they mesh."""
        return self.solved.meshing

    @property
    def apart(self) -> bool:
        """Whether the middle of the meshing has a view of its own."""
        return self.paper("h") < TALL * self.style.label

    @property
    def lacking(self) -> bool:
        """Whether undercut or pointed teeth lack a part of the flanks that would touch on the active line."""
        first, last = self.touching
        return last - first < self.size("g_alpha") * (1.0 - SAME)

    @property
    def touching(self) -> tuple[float, float]:
        """Between which rho_1 flanks touch, m; the same number twice where none do."""
        first, last = self.meshing.touching
        return first, max(first, last)

    @property
    def places(self) -> dict[str, float]:
        """The named places in their order on the line of action, by their distances from N1, m.

        A1 and A2 lie between N1 and N2 in a pair without interference.
        """
        rhos = {"N1": 0.0, **{name: self.size(rho) for name, rho in PLACES.items()}, "N2": self.size("l_N1N2")}
        return dict(sorted(rhos.items(), key=lambda item: item[1]))

    def size(self, name: str) -> float:
        """Return a quantity, SI."""
        return float(self.solved.sizes[name])

    def paper(self, name: str) -> float:
        """Return a length as it is drawn in the meshing, mm."""
        return self.drawn(self.size(name))

    def drawn(self, length: float) -> float:
        """Return the millimetres that show a length of the meshing, m."""
        return length / self.mu_l

    def mm(self, mark: str) -> complex:
        """Return a mark of the meshing in mm from the pole."""
        return self.solved.point(f"{MESHING}.{mark}") * (1.0 / self.mu_l)

    def scale(self, plan: str) -> Scale:
        """Return the scale factor of a plan as it is drawn."""
        mu = self.mu_l if plan == MESHING else sliding_mu(self.solved, plan, self.style.label, self.part)
        return Scale(SCALES[plan], mu, UNITS[plan])

    def wheels(self, rho_1: float | None = None) -> tuple[Wheel, Wheel]:
        """Return both wheels on the paper while they touch at `rho_1`, m from N1; by default at the pole."""
        return wheels(self.meshing, self.solved.sizes, self.mu_l, rho_1)

    @property
    def factor(self) -> str:
        """The scale of a view as drawings have it, and its scale factor: M 5:1; mu_l = 0.0002 m/mm."""
        return f"{self.words.drawn_at(self.mu_l)};  {self.words.scale(Scale('mu_l', self.mu_l, 'm'))}"

    def stated(self, name: str) -> str:
        """Return a quantity in mm as a dimension has it: d_a1 = 86.53."""
        return f"{self.words.symbol(name)} = {self.length(self.size(name))}"

    def shift(self, name: str) -> str:
        """Return a profile shift with its letter: x_1 = 0.5."""
        return f"{self.words.symbol(name)} = {self.words.short(round(self.size(name), 4))}"

    def angle(self, name: str) -> str:
        """Return an angle with its letter: alpha_w = 26.65°."""
        return f"{self.words.symbol(name)} = {self.degrees(self.size(name))}"


def lettered(words: Words, solved: object = None) -> Words:
    """Return the words with the letters of a gear pair; what is of a point of the sliding table has its number."""
    of_points = {f"{name}_{n}": f"{letter}({int(n)})" for name, letter in OF_POINTS.items() for n in POINTS}
    return words.lettered(words.letters_of("gears") | of_points)


def sliding_mu(solved: SolvedGear, plan: str, letters: float, part: float) -> float:
    """Return the scale factor of a diagram of sliding, the given one or a coarser one of its series, SI per mm.

    `letters` are so high, mm; diagrams have `part` of their usual size. Raises InputError where the given one of
    specific sliding is so coarse that the diagram is a line.
    """
    wanted = float(solved.values[SCALES[plan]]) * PAPER_MM
    if plan == SLIDING:
        return steps(max(wanted, solved.sizes["l_N1N2"] / (ALONG[letters] * part)))[0]
    depth = 1.0 - cut_of(solved)
    not_a_point(SCALES[plan], wanted, depth, UNITS[plan])
    return steps(max(depth / (HIGH[letters] * part), wanted * (1.0 - 1e-9)))[0]


def cut_of(solved: SolvedGear) -> float:
    """Return the value at which the curves are cut off: a whole number below both extremes of the active line."""
    lowest = min(solved.sizes[f"{name}_{end}"] for name in CURVES.values() for end in ENDS)
    if not math.isfinite(lowest):
        return -USUAL
    return -min(max(math.ceil(-ROOM * lowest), CUTS[0]), CUTS[1])
