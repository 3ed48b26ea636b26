"""A planar mechanism as data: links and pairs, driver, masses and loads, all numbers by name.

Every numeric field is the *name* of a value (`"l_AB"`), never a number: the values come separately, as one position
or as arrays, so that one mechanism serves a variant, a sweep and a batch. The name `zero` stands for a value that is
zero by the form of the mechanism (a point at the origin of its link, a guide without offset).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

ZERO = "zero"
FRAME = 0


@dataclass(frozen=True, slots=True)
class Link:
    """A rigid link: its lettered points in local coordinates (x, y), its centre of mass, mass and moment of inertia."""

    number: int
    points: Mapping[str, tuple[str, str]]
    centre: str | None = None
    mass: str | None = None
    inertia: str | None = None


@dataclass(frozen=True, slots=True)
class Revolute:
    """A revolute pair at a lettered point; `at` is where it stands when one of its links is the frame."""

    point: str
    links: tuple[int, int]
    at: tuple[str, str] | None = None


@dataclass(frozen=True, slots=True)
class Prismatic:
    """A prismatic pair: point `point` of the slider runs along a guide of the other link.

    `links` is (slider, guide link); the guide passes through `through` along the angle `direction`; the point runs at
    `offset` to the left of it; `branch` (+1 or -1) says which of two positions along the direction is meant.
    """

    point: str
    links: tuple[int, int]
    through: tuple[str, str]
    direction: str
    offset: str = ZERO
    branch: str | None = None


@dataclass(frozen=True, slots=True)
class Driver:
    """The crank: link `link` turns about `pivot`, carries `point`, at `angle`, with `speed`, in the sense `sense`."""

    link: int
    pivot: str
    point: str
    angle: str
    speed: str
    sense: str


@dataclass(frozen=True, slots=True)
class Load:
    """A force `name` on a point of a link, with its magnitude and the angle of its direction."""

    name: str
    link: int
    point: str
    magnitude: str
    direction: str


Pair = Revolute | Prismatic


@dataclass(frozen=True, slots=True)
class Mechanism:
    """Links (without the frame, number 0), pairs, the driver and the loads."""

    links: tuple[Link, ...]
    pairs: tuple[Pair, ...]
    driver: Driver
    loads: tuple[Load, ...] = field(default=())

    def link(self, number: int) -> Link:
        """Return the moving link with this number."""
        return next(link for link in self.links if link.number == number)

    def loads_on(self, number: int) -> tuple[Load, ...]:
        """Return the loads on link `number`."""
        return tuple(load for load in self.loads if load.link == number)
