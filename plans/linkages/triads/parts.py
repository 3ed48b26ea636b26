"""Parts of the triad: its central link, and the names that its constructions use."""

from __future__ import annotations

from dataclasses import dataclass

from ...names import POINT, Name
from ..mechanism import Link, Mechanism
from ..parts import Body, Passed, Span
from .legs import Leg


@dataclass(frozen=True, slots=True)
class Central(Span):
    """The central link between two of its joints; its `third` is found before the points of its figure."""

    third: str

    @property
    def others(self) -> tuple[str, ...]:
        """The points beside the joints."""
        return tuple(point for point in self.link.points if point not in (self.start, self.end, self.third))


@dataclass(frozen=True, slots=True)
class Triad:
    """The names that the constructions of one triad use.

    `legs` are in the order of construction: the lines of the first two meet in the special point, then the third.
    """

    mechanism: Mechanism
    name: str
    numbers: tuple[int, ...]
    central: Central
    legs: tuple[Leg, Leg, Leg]

    @property
    def link(self) -> Link:
        """The central link."""
        return self.central.link

    @property
    def number(self) -> int:
        """Its number."""
        return self.central.link.number

    @property
    def X(self) -> Name:
        """Letter of Assur's special point, `X3` for the central link 3 (not S3, which is a centre of mass)."""
        letter = f"X{self.number}"
        return Name(letter, POINT, letter, links=(self.number,))

    @property
    def D(self) -> str:
        """Joint of the third leg."""
        return self.legs[2].joint

    @property
    def XD(self) -> str:
        """The central link between the special point and that joint."""
        return self.X + self.D

    @property
    def joints(self) -> tuple[str, ...]:
        """The joints of the central link, in the order of the legs' numbers."""
        return tuple(leg.joint for leg in sorted(self.legs, key=lambda leg: leg.number))

    @property
    def spans(self) -> tuple[Span, ...]:
        """Its links with two joints."""
        return self.central, *(span for leg in self.legs for span in leg.spans)

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The links for those attached to them."""
        own = self.central.body(self.central.omega, self.central.epsilon)
        return own, *(leg.body for leg in self.legs)

    def passed(self) -> tuple[Passed, ...]:
        """Reactions on the links before."""
        return tuple(leg.passed() for leg in self.legs)


def start_names(number: int) -> tuple[str, str, str, str, str]:
    """Return the names of the values that say where the central link lies, about, before it is laid down.

    x, y of its first joint, cosine and sine of its x axis, and how far it went astray on the way there (zero: it did
    not). They come from `following`, not from the task.
    """
    x, y, cosine, sine, astray = (f"_{what}_{number}" for what in ("near_x", "near_y", "near_c", "near_s", "astray"))
    return x, y, cosine, sine, astray
