"""What every view of a cam needs: the cam solved, scale factors as they are drawn, words, sizes of the format."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TypeVar

from ...plans.cams.construction import DIAGRAMS, EXACT, EXACT_OF
from ...plans.cams.course import pressed
from ...plans.cams.followers import RIGHT_ANGLE, PlateCam, RollerCam
from ...plans.cams.motion import Division
from ...plans.cams.solve import SCALES, SolvedCam, unit_of
from ...plans.names import role
from ...plans.solved import PAPER_MM
from ...scales.scale import Scale
from ..figure import SubjectScene
from ..words import Words

Size = TypeVar("Size", float, complex)
SHOWN = 0.6  # part of the greatest pressure angle: a ray clear of its limit, and of the vertical
MU_DIGITS = 5  # of a scale factor that follows from a drawing: enough for 0.01 mm
CENTRAL = 0.05  # mm, of a circle of the offset that is not drawn
INDEXED = re.compile(r"([^_]+)(?:_\{?(.*?)\}?)?")  # a symbol: its letter, its index
CHORD = "chord"  # the mark in the index of what is read from chords: above it, it would meet the squares of derivatives


@dataclass(frozen=True, slots=True)
class CamScene(SubjectScene[SolvedCam]):
    """A solved cam on a certain format, in certain words.

    `solved` has the diagrams as large as they are drawn, `reduction` times as large as the task's lengths on paper;
    `mus` are the scale factors that are chosen, m/mm.
    """

    mus: Mapping[str, float]
    reduction: float = 1.0

    @property
    def mu_l(self) -> float:
        """The scale factor of the profiles, m/mm."""
        return self.mus["mu_l"]

    @property
    def division(self) -> Division:
        """The section lines."""
        return self.solved.layout.division

    def symbol(self, name: str) -> str:
        """Return the letter of a quantity."""
        return self.words.symbol(name)

    def value_of(self, name: str) -> float:
        """Return a quantity or an intermediate value, SI."""
        return float(self.solved.values[name])

    def mu(self, symbol: str) -> float:
        """Return a scale factor as it is drawn, SI per mm."""
        return self.mus[symbol] if symbol in self.mus else self.value_of(symbol)

    def scale(self, plan: str) -> Scale:
        """Return the scale factor of a plan as it is drawn."""
        return Scale(SCALES[plan], self.mu(SCALES[plan]), "m")

    @property
    def across(self) -> Scale:
        """The scale factor of the axis of angles, rad/mm."""
        return Scale("mu_phi", self.mu("mu_phi"), "rad")

    @property
    def axis(self) -> str:
        """What a millimetre of that axis is, in words."""
        return self.words["said.cam_axis"].format(angle=self.degrees(self.across.mu))

    def mm(self, mark: str) -> complex:
        """Return a mark in mm from the origin of its plan."""
        plan = role(mark).plan
        if plan in DIAGRAMS:
            return self.solved.point(mark) * (1.0 / PAPER_MM)
        return self.solved.point(mark) * (1.0 / self.scale(plan).mu)

    def drawn(self, size: Size, plan: str = "") -> Size:
        """Return a length or a place of the mechanism as a plan shows it, or without one the profiles, mm."""
        mu = self.scale(plan).mu if plan else self.mu_l
        return size / mu if isinstance(size, float) else size * (1.0 / mu)

    def sizes(self, *names: str) -> list[float]:
        """Return lengths of the mechanism by their names as the profiles show them, mm."""
        return [self.drawn(self.value_of(name)) for name in names]

    def curve(self, places: Iterable[complex], plan: str = "") -> tuple[complex, ...]:
        """Return a curve as a plan shows it, or without one the profiles, mm."""
        return tuple(self.drawn(place, plan) for place in places)

    def paper(self, name: str) -> float:
        """Return a length on the diagrams, mm as drawn."""
        return self.value_of(EXACT.get(name, name)) / PAPER_MM

    def factor(self, scale: Scale) -> str:
        """Return a scale factor with as many digits as drawings of 0.01 mm need."""
        rounded = Scale(scale.symbol, float(f"{scale.mu:.{MU_DIGITS}g}"), scale.unit, scale.paper)
        return self.words.scale(rounded)

    def dimension(self, name: str, length: float) -> str:
        """Return a length of the mechanism with its letter, as a dimension has it."""
        return f"{self.symbol(name)} = {self.length(length)}"

    def lettered(self, *names: str) -> list[str]:
        """Return quantities that are not infinite with their letters, as dimensions have them."""
        sizes = {name: self.value_of(name) for name in names}
        written = {name: self.angle if unit_of(name) == "rad" else self.dimension for name in names}
        return [written[name](name, size) for name, size in sizes.items() if math.isfinite(size)]

    def angle(self, name: str, angle: float, line: int | None = None) -> str:
        """Return an angle with its letter, with the number of a section line for one of its position."""
        return f"{self.symbol(name)}{'' if line is None else f'_{{{line}}}'} = {self.degrees(angle)}"

    def heading(self, key: str, plan: str) -> tuple[str, str]:
        """Return the heading of a plan to the scale of the profiles: its name, its scale."""
        return self.words[key], f"{self.words.drawn_at(self.mu_l)};  {self.factor(self.scale(plan))}"

    def stated(self, name: str, value: float) -> str:
        """Return a length of the mechanism with its letter in mm, as a sentence has it; a given as it is given."""
        given = self.givens.get(name)
        if given is not None and given.unit == "mm" and not isinstance(given.value, str):
            return f"{self.symbol(name)} = {self.words.short(given.value)} {self.words.unit('mm')}"
        return f"{self.dimension(name, value)} {self.words.unit('mm')}"

    @property
    def rolling(self) -> RollerCam:
        """The cam for a follower with a roller."""
        assert self.solved.rolling is not None
        return self.solved.rolling

    @property
    def plate(self) -> PlateCam:
        """The cam for a plate."""
        assert self.solved.plate is not None
        return self.solved.plate

    @property
    def shown(self) -> int:
        """The section line whose position is lettered."""
        return pressed(self.solved, SHOWN)

    def pressed(self) -> list[str]:
        """Return the pressure angle of that position, and its transmission angle, with their letters."""
        theta = float(self.rolling.profile.pressure(self.solved.angles[self.shown]))
        angles = {"theta": theta, "gamma": RIGHT_ANGLE - abs(theta)}
        return [self.angle(name, angle, self.shown) for name, angle in angles.items()]


def given(*names: str) -> Callable[[CamScene], str]:
    """Return what the key of a sentence about a size ends with: the `names` that are given."""
    return lambda scene: "".join(f"_{name}" for name in names if name in scene.solved.givens)


def is_aside(scene: CamScene) -> bool:
    """Whether the follower's line has an offset that is drawn."""
    roller = scene.solved.roller
    return roller is not None and abs(roller.sizes.e) > CENTRAL * scene.mu_l


def lettered(words: Words, solved: object = None) -> Words:
    """Return the words with the letters of a cam."""
    table = words.letters_of("cams")
    mark = table.pop(CHORD)
    for name, exact in EXACT_OF.items():
        letter, index = INDEXED.fullmatch(table.get(exact) or words.symbol(exact)).groups("")  # type: ignore[union-attr]
        table[name] = f"{letter}_{{{' '.join(filter(None, (index, mark)))}}}"
    return words.lettered(table)
