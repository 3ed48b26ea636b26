"""What every view of a linkage needs: the solved mechanism, scale factors, words, and sizes of the format."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, TypeVar

from ...plans.board import POSITION, Program, Step
from ...plans.linkages.compound import ACCELERATION, VELOCITY
from ...plans.linkages.legs import guide_letters
from ...plans.linkages.mechanism import FRAME, Mechanism, Prismatic, Revolute
from ...plans.linkages.solved import DRIVER, SolvedLinkage
from ...plans.linkages.structure import Structure
from ...plans.names import FORCES, role
from ...plans.quantities import Quantity, unit_of
from ...scales.scale import Scale
from ..figure import ANSWERS, SubjectScene
from ..printed import segment_text
from ..shapes import Group, Pen, Vector
from ..view import Canvas
from ..words import Words
from .reading import Edge, Reading, ends_of, read

if TYPE_CHECKING:
    from ...plans.linkages.cycle import Runs

Made = TypeVar("Made")
NORMAL_TO = "⊥"
ROUNDING = 1e-12  # part of the largest quantity of its unit below which a value is nothing but rounding


class _Scales(dict[str, Scale]):
    """Scale factors by plan that note which of them a figure has `used`."""

    def __init__(self, scales: Mapping[str, Scale]) -> None:
        super().__init__(scales)
        self.used = dict[str, Scale]()

    def __getitem__(self, plan: str) -> Scale:
        """Return the scale factor of a plan and note it."""
        scale = self.used[plan] = super().__getitem__(plan)
        return scale


@dataclass(frozen=True, slots=True)
class Scene(SubjectScene[SolvedLinkage]):
    """A solved mechanism on a certain format, in certain words; `scales` are by plan, `runs` of sliders by guide.

    What is `found` for it stays, by what was asked and with the scale factors that it used. If it is `rough`, what is
    read off has the digits of a ruler, whatever is reckoned with it.
    """

    scales: Mapping[str, Scale]
    runs: Runs = field(default_factory=dict)
    rough: bool = False
    _largest: dict[str, float] = field(default_factory=dict, compare=False)
    found: dict[Hashable, list[tuple[dict[str, Scale], Any]]] = field(default_factory=dict, compare=False)
    skeletons: dict[int, Any] = field(default_factory=dict, init=False, compare=False)  # of links, found at its scales

    def once(self, make: Callable[[Scene], Made], *asked: Hashable) -> Made:
        """Return what is made for this scene, unless it has been `asked` for at the same scale factors before."""
        before = self.found.setdefault((*asked, self.words.display, self.rough), [])
        for used, made in before:
            if all(self.scales[plan] == scale for plan, scale in used.items()):
                return made  # type: ignore[no-any-return]
        watched = _Scales(self.scales)
        made = make(replace(self, scales=watched))
        before.append(({plan: self.scales[plan] for plan in watched.used}, made))
        return made

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism that is solved."""
        return self.solved.mechanism

    @property
    def program(self) -> Program:
        """The recorded steps."""
        return self.solved.program

    @property
    def reading(self) -> Reading:
        """What is looked up in the steps."""
        return read(self.solved.program)

    @property
    def made(self) -> Mapping[str, Step]:
        """The recorded steps by the names that they make."""
        return self.reading.made

    @property
    def values(self) -> Mapping[str, Any]:
        """What the steps have made."""
        return self.solved.values

    @property
    def quantities(self) -> Mapping[str, Quantity]:
        """The results."""
        return self.solved.quantities

    @property
    def points(self) -> dict[str, None]:
        """The letters of the points of all links, in their order."""
        return dict.fromkeys(point for link in self.mechanism.links for point in link.points)

    @property
    def numbers(self) -> list[int]:
        """The numbers of the moving links."""
        return [link.number for link in self.mechanism.links]

    def sliding(self, number: int = FRAME) -> list[Prismatic]:
        """Return the pairs in which a link slides, or the frame."""
        return [pair for pair in self.mechanism.pairs if isinstance(pair, Prismatic) and number in pair.links]

    def turning(self, number: int = FRAME) -> list[Revolute]:
        """Return the pairs in which a link turns, or the frame."""
        return [pair for pair in self.mechanism.pairs if isinstance(pair, Revolute) and number in pair.links]

    def canvas(self, parts: Mapping[str, str] | None = None) -> Canvas:
        """Return an empty canvas: what is drawn is an answer until it is a `part`, by the step of the program.

        What some steps draw belongs to others, which `parts` names.
        """
        canvas = Canvas(self.style, parts=parts or {})
        canvas.part(ANSWERS)
        return canvas

    def last(self, names: Iterable[str]) -> str:
        """Return which of some names the program makes last: the step with which all of them are drawn."""
        return max(names, key=lambda name: self.reading.number.get(name, len(self.reading.number)))

    def point(self, at: complex, name: str) -> Group:
        """Return the small circle of a point that is no joint."""
        return self.node(at, name, "point", pen=Pen.MAIN)

    def mm(self, mark: str) -> complex:
        """Return a mark in mm from the origin of its plan."""
        return self.solved.point(mark) * (1.0 / self.scales[role(mark).plan].mu)

    def run_of(self, pair: Prismatic) -> tuple[float, float]:
        """Return how far a slider goes back and forth of its place, mm."""
        low, high = self.runs.get(self.solved.guide_name(pair), (0.0, 0.0))
        per_mm = 1.0 / self.scales[POSITION].mu
        return low * per_mm, high * per_mm

    def direction(self, name: str) -> complex:
        """Return the unit direction of a vector, or 0 when it is zero."""
        size = self.solved.size(name)
        return 0j if self.vanishes(name) else complex(self.values[name]) / size

    def vanishes(self, name: str) -> bool:
        """Whether a quantity is zero, or rounding beside the largest of its unit."""
        if (unit := unit_of(role(name).shown)) not in self._largest:
            sizes = (abs(q.value or 0.0) for q in self.quantities.values() if q.unit == unit)
            self._largest[unit] = max(sizes, default=0.0)
        return self.solved.size(name) <= ROUNDING * self._largest[unit]

    def defined(self, name: str) -> bool:
        """Whether a value exists and is a number."""
        value = self.values.get(name)
        return value is not None and value == value

    def ends(self, edge: Edge) -> tuple[complex, complex]:
        """Return tail and tip of a vector of a plan, mm from the plan's origin."""
        return self.mm(edge.tail), self.mm(edge.tip)

    def vector(self, edge: Edge, at: complex = 0j) -> Vector:
        """Return a vector of a plan whose origin is `at`, mm."""
        scale, name = self.scales[role(edge.tail).plan], edge.name
        a, b = (end + at for end in self.ends(edge))
        size = self.solved.size(name) if name in self.values else abs(b - a) * scale.mu
        return Vector(a, b, name, size, scale.unit, scale.mu, title=name)

    def segment(self, name: str, plan: str = "", fine: bool = False) -> str:
        """Return the printed millimetres of a quantity on a plan, the one that shows it if none is said."""
        size = abs(self.quantities[name].value or 0.0) / self.scales[plan or self.figure_of(name)].mu
        return self.length(size, fine)

    def length(self, drawn: float, fine: bool = False) -> str:
        """Return millimetres of a drawing as they are printed, if `fine` with hundredths however many they are."""
        return segment_text(self.words, self.words.display.segment(drawn), fine)

    def span(self, start: str, end: str, plan: str) -> float:
        """Return how far ends of vectors are apart on a plan: as their vector was read, else as a ruler shows it."""
        size = abs(self.solved.point(end) - self.solved.point(start))
        if not self.words.ruler:
            return size
        from ...plans.hands.shaky import read_by_ruler

        mu = self.scales[plan].mu
        edge = self.reading.between(start, end) or self.reading.between(end, start)
        if edge is not None and edge.name in self.quantities and mu == self.scales[role(end).plan].mu:
            return abs(self.quantities[edge.name].value or 0.0)
        return read_by_ruler(size / mu) * mu

    def hung(self, letter: str, point: str) -> str:
        """Say at which point the vector stands that has this letter."""
        return self.words["said.hung"].format(vector=letter, point=self.words.mark(point))

    def figure_of(self, name: str) -> str:
        """Return the plan, or the figure with a scale factor of its own, on which a quantity is a segment, or ""."""
        plan = self.solved.shown_on.get(name, "")
        return POSITION if plan == DRIVER and DRIVER not in self.scales else plan

    def letter(self, vector: str, known: int = 0) -> str:
        """Return the letter of a vector, with its bar; underlined twice if it is known in full, once by direction."""
        text = self.words.symbol(role(vector).shown, bar=True)
        return f"\\{'u' * known}{{{text}}}" if known else text

    def link_name(self, number: int) -> str:
        """Return a link by its ends, or its number."""
        return self.words.ends.get(str(number), str(number))

    def heading(self, key: str, *plans: str, **fill: str) -> tuple[str, ...]:
        """Return the heading lines of a view: its name and the scale factors of `plans`."""
        scales = dict.fromkeys(self.words.scale(self.scales[plan]) for plan in plans)
        return (self.words[key].format(**fill), *scales)


def plan_heading(words: Words, structure: Structure, plan: str) -> str:
    """Return the heading of a plan; that of a plan of forces names its group or its link."""
    links, number = structure.parts.get(role(plan).of, ()), role(plan).of
    key = "group_forces" if len(links) > 1 else "link_forces"
    text: str = words[f"heading.{key if role(plan).kind == FORCES else plan}"]
    return text.format(links=", ".join(map(str, links)), link=number)


def line_of(scene: Scene, direction: str) -> str:
    """Return a line by the name of its direction: ∥ AB, ⊥ AB, ∥ x–x."""
    return " ".join(sided(scene, direction))


def sided(scene: Scene, direction: str) -> tuple[str, str]:
    """Return the sign of a direction, and the letters of the line to which it is normal or parallel."""
    step = scene.made[direction]
    sign, along = (NORMAL_TO, step.operands[0]) if step.verb == "normal" else ("∥", direction)
    letters = guide_letters(scene.program).get(along)
    return sign, letters or "".join(map(scene.words.mark, ends_of(scene.reading, along)))


def is_at_point(plan: str) -> bool:
    """Whether a plan is drawn at a point itself."""
    return role(plan).kind in (VELOCITY, ACCELERATION)
