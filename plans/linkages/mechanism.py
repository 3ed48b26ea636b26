"""A planar mechanism as data: links and pairs, driver, masses and loads, all numbers by name.

Every numeric field is the *name* of a value (`"l_AB"`), never a number: the values come separately, as one position
or as arrays, so that one mechanism serves a variant, a sweep and a batch. The name `zero` stands for a value that is
zero by the form of the mechanism (a point at the origin of its link, a guide without offset); `_minus_` before the name
of a length stands for its opposite (a second crank on the other side of the shaft).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache

from ..names import POINT, Name, role, spelled

ZERO = "zero"
MINUS = "_minus_"
FRAME = 0
ONE_DIGIT = range(10)  # numbers of links that need no parting in names


@lru_cache(maxsize=4096)
def _index(parted: bool, *numbers: int | str) -> str:
    return ("_" if parted else "").join(map(str, numbers))


@lru_cache(maxsize=4096)
def _pair(parted: bool, kind: str, first: int, second: int, part: str) -> Name:
    return spelled(kind, _index(parted, first, second), part=part, links=(first, second))


@lru_cache(maxsize=4096)
def positive(place: str) -> str:
    """Return the name of a length for that of its opposite, any other name as it is."""
    name = role(place)
    return name.of if name.hidden and name.kind == "minus" else place


@dataclass(frozen=True, slots=True)
class Link:
    """A rigid link: its lettered points in local coordinates (x, y), its centre of mass, mass and moment of inertia.

    With `per_length`, kg/m, the mass follows from the distance of its two joints, m = k l; with `inertia_factor` the
    moment of inertia follows from both, J_S = k m l^2. `mass` and `inertia` then name these results.
    """

    number: int
    points: Mapping[str, tuple[str, str]]
    centre: str | None = None
    mass: str | None = None
    inertia: str | None = None
    per_length: str | None = None
    inertia_factor: str | None = None

    @property
    def givens(self) -> tuple[str, ...]:
        """Names of its values beside places: mass and moment of inertia, or what they follow from."""
        names = (self.per_length or self.mass, self.inertia_factor or self.inertia)
        return tuple(name for name in names if name)


@dataclass(frozen=True, slots=True)
class Revolute:
    """A revolute pair at a lettered point; `at` is where it stands when one of its links is the frame.

    `branch` belongs to the inner pair of a dyad RRR: whether it lies to the left (+1) or right (-1) of the way from the
    outer pair of the link with the lower number to the other outer pair.
    """

    point: str
    links: tuple[int, int]
    at: tuple[str, str] | None = None
    branch: str | None = None

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the coordinates of its place on the frame."""
        return self.at or ()


@dataclass(frozen=True, slots=True)
class Prismatic:
    """A prismatic pair: point `point` of the slider runs along a guide of the other link.

    `links` is (slider, guide link); the guide passes through `through` along the angle `direction`; the point runs at
    `offset` to the left of it; `branch` (+1 or -1) says which of two positions along the direction is meant. Both are
    given on the guide link (absolute on the frame). The slider's own x axis points along the guide.
    """

    point: str
    links: tuple[int, int]
    through: tuple[str, str]
    direction: str
    offset: str = ZERO
    branch: str | None = None

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the coordinates of its place on the guide link."""
        return *self.through, self.offset


MOMENT, FORCE = "moment", "force"


@dataclass(frozen=True, slots=True)
class Driver:
    """The crank: link `link` turns about `pivot`, carries `point`, at `angle`, with `speed`, in the sense `sense`.

    `acceleration`, in the sense of rotation too, is positive while the crank speeds up; without it the crank turns
    steadily. `balance` says what keeps it moving so: a `moment`, or a `force` at `point` normal to the crank.
    """

    link: int
    pivot: str
    point: str
    angle: str
    speed: str
    sense: str
    acceleration: str | None = None
    balance: str = MOMENT

    @property
    def coordinate(self) -> str:
        """Name of the value that says where the driver stands."""
        return self.angle


@dataclass(frozen=True, slots=True)
class SlidingDriver:
    """The driver that slides on the frame: the prismatic pair of link `link` says along which guide.

    `point`, which runs in the guide, stands at `travel` from the point through which the guide passes, and moves with
    `speed` and `acceleration`, all positive along the guide's direction. A force along the guide keeps it moving so.
    """

    link: int
    point: str
    travel: str
    speed: str
    acceleration: str | None = None

    @property
    def coordinate(self) -> str:
        """Name of the value that says where the driver stands."""
        return self.travel


@dataclass(frozen=True, slots=True)
class Stroke:
    """The output of a mechanism: link `link` on the frame, which moves to and fro between two dead positions.

    Its working stroke is the one in the sense `sense`: +1 along the direction of its guide, or counter-clockwise for a
    rocker; -1 the other way. The zero position of the mechanism is where it begins.
    """

    link: int
    sense: str = "one"


STROKE, ANGLE = "stroke", "angle"


@dataclass(frozen=True, slots=True)
class Diagram:
    """A load diagram: `values` at the places `at`, joined by straight lines; `back` in the idle stroke, if it differs.

    `over` is "stroke", and the places are parts of the mechanism's stroke, from 0 to 1, counted from where the working
    stroke begins; or "angle", and the places are angles of the driver, within a turn, after which the first one comes
    again. Places do not decrease; where two are equal the diagram jumps. Outside of its places it stays level.
    """

    name: str
    over: str
    at: tuple[str, ...]
    values: tuple[str, ...]
    back: tuple[str, ...] | None = None

    @property
    def sizes(self) -> tuple[str, ...]:
        """Names of all its values, those of the idle stroke last."""
        return (*self.values, *(self.back or ()))


BOTH, WORKING, IDLE = "both", "working", "idle"


@dataclass(frozen=True, slots=True)
class Load:
    """A force `name` on a point of a link, with its magnitude and the angle of its direction.

    Without `direction` it resists the motion of its point. `magnitude` may name a diagram. `stroke` says when it acts:
    in the mechanism's working stroke, in the idle one, or in both.
    """

    name: str
    link: int
    point: str
    magnitude: str
    direction: str | None = None
    stroke: str = BOTH


@dataclass(frozen=True, slots=True)
class Couple:
    """A moment `name` on a link: its magnitude and its sense, +1 counter-clockwise, -1 clockwise.

    Without `sense` it resists the link's turning. `magnitude` may name a diagram; `stroke` as for a load.
    """

    name: str
    link: int
    magnitude: str
    sense: str | None = "one"
    stroke: str = BOTH


@dataclass(frozen=True, slots=True)
class Start:
    """Where the central link of a group of class III stands, about, when the driver is at `driver`.

    `x`, `y` are the place of the origin of its own coordinates, `angle` is that of its x axis; from there the group is
    followed to any other position. `legs` are the two links whose lines make its special point; without them the two
    are taken that make the best one.
    """

    link: int
    x: str
    y: str
    angle: str
    driver: str
    legs: tuple[int, int] | None = None


def start_names(number: int) -> tuple[str, str, str, str, str]:
    """Return the names of the values that say where the central link lies, about, before it is laid down.

    x, y of its first joint, cosine and sine of its x axis, and how far it went astray on the way there (zero: it did
    not). They come from `following`, not from the task.
    """
    x, y, cosine, sine, astray = (f"_{what}_{number}" for what in ("near_x", "near_y", "near_c", "near_s", "astray"))
    return x, y, cosine, sine, astray


Pair = Revolute | Prismatic


@dataclass(frozen=True)
class Mechanism:
    """Links (without the frame, number 0), pairs, the driver and the loads.

    `centres` are joints about which the moments of whole RRR dyads are taken, by name of the dyad: `moment_centres`.
    """

    links: tuple[Link, ...]
    pairs: tuple[Pair, ...]
    driver: Driver | SlidingDriver
    loads: tuple[Load, ...] = field(default=())
    couples: tuple[Couple, ...] = field(default=())
    diagrams: tuple[Diagram, ...] = field(default=())
    stroke: Stroke | None = None
    gravity: str | None = None  # acceleration of free fall, downwards
    starts: tuple[Start, ...] = field(default=())
    centres: tuple[tuple[str, str], ...] = field(default=())

    @cached_property
    def written(self) -> str:
        """All of it as text, under which what follows from it is kept."""
        return repr(self)

    @cached_property
    def parted(self) -> bool:
        """Whether numbers of links are parted in names: one of them has two digits."""
        return any(link.number not in ONE_DIGIT for link in self.links)

    def index(self, *numbers: int | str) -> str:
        """Return the numbers of several links as one index of a name: `12`, and `1_2` where `12` may be a link."""
        return _index(self.parted, *numbers)

    def pair(self, kind: str, first: int, second: int, part: str = "") -> Name:
        """Return what concerns a pair of links: the reaction `R_12` of the first on the second, its moment, its arm."""
        return _pair(self.parted, kind, first, second, part)

    def letter_on(self, point: str, number: int) -> Name:
        """Return the letter of a point as one of link `number`: `A3`, and `A1_3` where `A13` may be another point."""
        parting = "_" if self.parted and point[-1].isdigit() else ""
        return Name(f"{point}{parting}{number}", POINT, point, links=(number,))

    def start(self, number: int) -> Start | None:
        """Return where link `number` starts."""
        return next((start for start in self.starts if start.link == number), None)

    def link(self, number: int) -> Link:
        """Return the moving link with this number."""
        return next(link for link in self.links if link.number == number)

    @property
    def coordinates(self) -> list[str]:
        """Names of the coordinates of all points of the moving links."""
        return [xy for link in self.links for place in link.points.values() for xy in place]

    @cached_property
    def givens(self) -> frozenset[str]:
        """Names of the values that it needs under their own names; sizes of loads and the driver's rates are not."""
        names = [*self.coordinates, *(name for link in self.links for name in link.givens)]
        for pair in self.pairs:
            names += [*pair.coordinates, pair.branch or ZERO]
            names += [pair.direction] if isinstance(pair, Prismatic) else []
        names += [load.direction or ZERO for load in self.loads] + [couple.sense or ZERO for couple in self.couples]
        names += [name for start in self.starts for name in (start.x, start.y, start.angle, start.driver)]
        names += [name for diagram in self.diagrams for name in diagram.at]
        names += {name for diagram in self.diagrams for name in diagram.sizes}.difference(self.sizes)
        names += [self.gravity or ZERO, self.stroke.sense if self.stroke else ZERO]
        names += [self.driver.coordinate, self.driver.sense if isinstance(self.driver, Driver) else ZERO]
        return frozenset(names) - self.opposites.keys()

    @cached_property
    def opposites(self) -> dict[str, str]:
        """Names of opposite lengths, with the lengths."""
        names = [*self.coordinates, *(name for pair in self.pairs for name in pair.coordinates)]
        return {name: length for name in names if (length := positive(name)) != name}

    @cached_property
    def frame_points(self) -> dict[str, tuple[str, str]]:
        """Points of the frame, the pivots on it, with their coordinates."""
        return {p.point: p.at or (ZERO, ZERO) for p in self.pairs if isinstance(p, Revolute) and FRAME in p.links}

    def mark(self, plan: str, point: str) -> str:
        """Return the mark of `point` on a plan of velocities or accelerations; points of the frame are at the pole."""
        return f"{plan}.p" if point in self.frame_points else f"{plan}.{point}"

    @property
    def acting(self) -> tuple[Load | Couple, ...]:
        """All loads and couples."""
        return (*self.loads, *self.couples)

    @cached_property
    def sizes(self) -> tuple[str, ...]:
        """Names of the values that stand on the board as `|F_3|`, for `F_3` may be a vector there.

        They are the magnitudes of loads, and values of diagrams that are called like a load.
        """
        diagrams, loads = {diagram.name for diagram in self.diagrams}, {load.name for load in self.acting}
        names = [load.magnitude for load in self.acting if load.magnitude not in diagrams]
        names += [name for diagram in self.diagrams for name in diagram.sizes if name in loads]
        return tuple(dict.fromkeys(names))

    def loads_on(self, number: int) -> tuple[Load, ...]:
        """Return the loads on link `number`."""
        return tuple(load for load in self.loads if load.link == number)

    @property
    def without_loads(self) -> Mechanism:
        """The mechanism as its geometry alone."""
        return replace(self, loads=(), couples=(), diagrams=(), gravity=None)
