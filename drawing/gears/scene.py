"""What every view of a gear pair needs: the pair solved, scale factors as drawn, words, sizes of the format."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ...plans.gears.construction import MESHING
from ...plans.gears.geometry import POINTS
from ...plans.gears.meshing import Meshing, Wheel, wheels
from ...plans.gears.solve import SAME, SolvedGear
from ...scales.scale import Scale
from ..rungs import SubjectScene
from ..words import Words

TALL = 7.0  # heights of letters that a tooth must have for what is measured on it
OF_POINTS = {"y_1": "y_{1}", "y_2": "y_{2}", "theta_12": "θ_{12}", "theta_21": "θ_{21}"}
# rho_1 of a place, its distance from N1: by the name of a quantity
PLACES = {"A1": "rho_p1", "P": "rho_w1", "A2": "rho_a1"}
NUMBERS = ("03", "06", "08")  # points of the table at the three places, in the order in which they lie


@dataclass(frozen=True, slots=True)
class Ordinates:
    """Ordinates of velocities on the paper: `reduction` times those of the table, whose `highest` is so many mm."""

    reduction: float
    highest: float

    def mm(self, value: float) -> float:
        """Return an ordinate of the table, m, as it is drawn."""
        return value * 1e3 * self.reduction


@dataclass(frozen=True, slots=True)
class GearScene(SubjectScene[SolvedGear]):
    """A solved pair on a certain format, in certain words.

    `mu_l` is the scale factor of the meshing with both centres, `near` that of its middle, which has a view of its own
    where teeth are too small beside their letters, `rolled` that of the construction of the involutes;
    m/mm. `part` is how much of their usual size the diagrams of sliding have; `close` is the scene of that middle.
    """

    mu_l: float
    near: float
    rolled: float
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

    def wheels(self, rho_1: float | None = None) -> tuple[Wheel, Wheel]:
        """Return both wheels on the paper while they touch at `rho_1`, m from N1; by default at the pole."""
        return wheels(self.meshing, self.solved.sizes, self.mu_l, rho_1)

    def factor(self, mu: float) -> str:
        """Return the scale of a view as drawings have it, and its scale factor: M 5:1; mu_l = 0.0002 m/mm."""
        return f"{self.words.drawn_at(mu)};  {self.words.scale(Scale('mu_l', mu, 'm'))}"

    def stated(self, name: str, decimals: int = 2) -> str:
        """Return a quantity in mm as a dimension has it: d_a1 = 86.53."""
        return f"{self.words.symbol(name)} = {self.length(self.size(name), decimals)}"

    def length(self, value: float, decimals: int = 2) -> str:
        """Return a length in mm."""
        return self.words.number(value * 1e3, decimals)

    def angle(self, name: str) -> str:
        """Return an angle with its letter: alpha_w = 26.65°."""
        return f"{self.words.symbol(name)} = {self.degrees(self.size(name))}"


def lettered(words: Words) -> Words:
    """Return the words with the letters of a gear pair; what is of a point of the sliding table has its number."""
    table = words.letters_of("gears")
    for name, letter in OF_POINTS.items():
        table |= {f"{name}_{point}": f"{letter}({int(point)})" for point in POINTS}
    return words.lettered(table)


def places(values: Mapping[str, Any]) -> dict[str, float]:
    """Return the named places in their order on the line of action: their distances from N1, m.

    A1 and A2 lie between N1 and N2 in a pair without interference.
    """
    line = float(values["l_N1N2"])
    found = {"N1": 0.0, **{name: float(values[rho]) for name, rho in PLACES.items()}, "N2": line}
    return dict(sorted(found.items(), key=lambda item: item[1]))


def marks(values: Mapping[str, Any]) -> dict[str, str]:
    """Return the points of the table that stand at the named places, by the names of these."""
    line = float(values["l_N1N2"])
    inner = sorted(PLACES, key=lambda name: min(max(float(values[PLACES[name]]), 0.0), line))
    return {"N1": POINTS[0], **dict(zip(inner, NUMBERS, strict=True)), "N2": POINTS[-1]}
