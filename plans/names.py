"""Names with their roles: what a step makes and needs is called by a word, and the word carries what it names.

A name is a plain string for whoever prints it or looks a value up. Nobody takes it apart: constructions make names by
the functions below, which know what they name, and the board keeps them. Names that a task gives are read here, once.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from functools import lru_cache
from typing import TypeVar, cast

POINT, POLE, NORMAL, CORIOLIS = "", "p", "n", "k"  # kinds of marks: a point, the pole, ends of parts of accelerations
MAGNITUDE = "|"  # kind of the size of a load, beside its vector
ORIGIN = "origin"  # the mark on a guide from which distances count
INERTIA, LEVER, COUPLE = "i", "lever", "couple"  # parts of forces, moments and arms
FORCES = "forces"  # kind of the plans of forces
# Parts of vectors: normal, tangential, Coriolis, sliding; in compound motion those of transport (e) and relative
# rotation (r).
PARTS = {**dict.fromkeys(("V", "a"), ("n", "t", "k", "r", "e", "en", "et", "rn", "rt")), "R": ("n", "t", "m", "p")}
# How names are written behind their kinds.
_WRITTEN = {
    **{kind: (re.compile(f"(?P<of>.+)_(?P<part>{'|'.join(parts)})"),) for kind, parts in PARTS.items()},
    **dict.fromkeys(("omega", "epsilon"), (re.compile("(?P<part>r)_(?P<of>.+)"),)),
    "mu": (re.compile("(?P<of>[^_]+)_(?P<about>.+)"),),
    "h": (
        re.compile(r"(?P<of>\d+(_\d+)*)(_(?P<part>[nt]))?(_(?P<about>[A-Z].*))?"),
        re.compile(f"(?P<part>{LEVER})_(?P<of>M_.+?)(_(?P<about>[A-Z][^_]*))?"),
        re.compile(f"(?P<part>{LEVER})_(?P<of>.+)"),
    ),
}
_COUPLE = re.compile(f"(?P<of>.+)_(?P<part>{COUPLE})(_(?P<about>.+))?")
_END = re.compile(f"(?P<kind>[{NORMAL}{CORIOLIS}])_(?P<of>.+)")


class Name(str):
    """A name with its role.

    kind    what it is: the letter of a quantity (`V`, `a`, `omega`, `R`, `M`, `h`, `l`, `mu`), of a direction (`e`,
            `n`, `u`) or of a mark; a plan has its own word, `forces`
    of      whose it is: the letter of a point, the number of a link, the name of a force; all behind the kind where
            nobody has said more
    about   the point that it is relative to
    part    which part of a vector, `n`, `t`, `k`, `r`; of a force the way in which it is found, `lever`, `couple`
    links   numbers of the links that it concerns: of a reaction the one that acts, then the one acted upon
    plan    the plan on which a mark stands; that of the mechanism for all other names
    hidden  whether it is an intermediate value, which begins with an underscore

    >>> name = vector("a", "B", "A", NORMAL)
    >>> name, name.kind, name.of, name.about, name.part
    ('a_BA_n', 'a', 'B', 'A', 'n')
    >>> Name("velocity.B").plan, Name("_V_A").hidden
    ('velocity', True)
    """

    __slots__ = ("_shown", "_size", "about", "hidden", "kind", "links", "of", "part", "plan")
    kind: str
    of: str
    about: str
    part: str
    links: tuple[int, ...]
    plan: Name
    hidden: bool
    _shown: Name | None
    _size: Name | None

    def __new__(
        cls, text: str, kind: str | None = None, of: str = "", about: str = "", part: str = "",
        links: Iterable[int] = (), plan: str = "",
    ) -> Name:  # fmt: skip
        """Return `text` as a name; what nobody says of it is read from its letters."""
        name = super().__new__(cls, text)
        before, _, letter = text.rpartition(".")
        name.plan = _plan(plan or before) if plan or before else POSITION
        name.hidden = text.startswith("_")
        name._shown = None if name.hidden or kind == MAGNITUDE else name
        name._size = None
        if kind is None:
            kind, of, about, part = _read_mark(letter) if before else _read(letter)
        name.kind, name.of, name.about, name.part, name.links = kind, of, about, part, tuple(links)
        return name

    @property
    def shown(self) -> Name:
        """The quantity whose size a hidden name is, such as `a_BA_n` of `_a_BA_n`; any other name itself."""
        if self._shown is None:
            self._shown = role(self.of) if self.kind == MAGNITUDE else self._like(self.lstrip("_"))
        return self._shown

    @property
    def across_guide(self) -> bool:
        """Whether a direction is the normal to a guide."""
        return self.kind == "n" and role(self.of).kind == "u"

    @property
    def letters(self) -> str:
        """Letters or numbers of what it names, without its kind and part."""
        return f"{self.of}{self.about}"

    @property
    def whole(self) -> Name:
        """The quantity of which this is a part, such as `R_12` of `R_12_t`."""
        if self.part == COUPLE:
            return spelled(self.kind, self.of, part=COUPLE, links=self.links)
        return spelled(self.kind, self.of, self.about, links=self.links) if self.part else self

    @property
    def size(self) -> Name:
        """The hidden name of a quantity's size."""
        if self._size is None:
            self._size = self._like(f"_{self}")
        return self._size

    def _like(self, text: str) -> Name:
        return Name(text, self.kind, self.of, self.about, self.part, self.links)


POSITION: Name = str.__new__(Name, "position")
POSITION.plan, POSITION.kind, POSITION.hidden, POSITION.links = POSITION, "position", False, ()
POSITION.of = POSITION.about = POSITION.part = ""
POSITION._shown, POSITION._size = POSITION, None


def _read(text: str) -> tuple[str, str, str, str]:
    """Return kind, whose, about what, and part of a quantity that a user has written."""
    kind, parted, rest = text.lstrip("_").partition("_")
    if not parted:
        return POINT, kind, "", ""
    found = next((match for way in (*_WRITTEN.get(kind, ()), _COUPLE) if (match := way.fullmatch(rest))), None)
    said = found.groupdict() if found else {"of": rest}
    return kind, said["of"], said.get("about") or "", said.get("part") or ""


def _read_mark(letter: str) -> tuple[str, str, str, str]:
    """Return the same of a mark of a plan, behind the name of the plan."""
    end = _END.fullmatch(letter)
    return (end["kind"], end["of"], "", "") if end else (POLE if letter == POLE else POINT, letter, "", "")


def _plan(name: str) -> Name:
    return name if isinstance(name, Name) else Name(name, _read(name)[0] or name, _read(name)[1])


def role(name: str) -> Name:
    """Return a name with its role; one that a task or a user gives has that of its letters."""
    return name if isinstance(name, Name) else _read_name(name)


@lru_cache(maxsize=16_384)  # each variant of a task, and each mistake in it, makes the same names
def _read_name(text: str) -> Name:
    return Name(text)


def is_shown(name: str) -> bool:
    """Whether a name is that of a quantity or of a point of the mechanism, no mark of a plan and no way to one."""
    return not role(name).hidden and role(name).plan == POSITION


Maker = TypeVar("Maker", bound=Callable[..., Name])


def _kept(maker: Maker) -> Maker:
    """Keep the names of a maker that looks at letters and numbers alone: each position makes the same.

    Of `of` and `about` only the letters hold: another mechanism may have made the name first.
    """
    return cast(Maker, lru_cache(maxsize=16_384)(maker))


def _joined(*parts: str) -> str:
    return "_".join(filter(None, parts))


@_kept
def spelled(kind: str, of: str | int, about: str = "", part: str = "", links: tuple[int, ...] = ()) -> Name:
    """Return a quantity, a direction, a plan of forces: kind, whose, part."""
    whose = str(of) if isinstance(of, int) else of
    return Name(f"{kind}_{of}{about}{part and '_'}{part}", kind, whose, about, part, links)


def vector(kind: str, of: str, about: str = "", part: str = "") -> Name:
    """Return a velocity or acceleration of a point, relative to another or absolute: `V_B`, `a_BA_n`."""
    return _vector(kind, of, about, part, of.links if isinstance(of, Name) else ())


@_kept
def _vector(kind: str, of: str, about: str, part: str, links: tuple[int, ...]) -> Name:
    """Return a vector of a point of these links: another mechanism's point may have the same letter."""
    return Name(f"{kind}_{of}{about}{part and '_'}{part}", kind, of, about, part)


@_kept
def rate(kind: str, link: int, part: str = "") -> Name:
    """Return an angular velocity or acceleration of a link: `omega_2`, of its relative turning `omega_r_2`."""
    return Name(f"{kind}_{part}{part and '_'}{link}", kind, str(link), part=part, links=(link,))


# the length `l_AB` between two points, the direction `e_AB` from one to the other, the normal `n_AB`
between = spelled


@_kept
def mark(plan: str, point: str, kind: str = POINT, about: str = "") -> Name:
    """Return a mark of a plan: `velocity.B`; as the end of a part of an acceleration `acceleration.n_BA`."""
    return Name(f"{plan}.{kind}{kind and '_'}{point}{about}", kind, point, about, plan=plan)


@_kept
def pole(plan: str) -> Name:
    """Return the pole of a plan of vectors."""
    return Name(f"{plan}.p", POLE, "p", plan=plan)


def arm(force: str, about: str = "") -> Name:
    """Return the arm of a force about a point: `h_2` of the inertia of link 2, `h_21` of R_21, `h_F_3` of F_3."""
    acting = role(force)
    of, part = (acting.of, acting.part) if acting.kind == "R" else (acting, "")
    of = str(acting.links[0]) if acting.part == INERTIA else of
    return Name(_joined("h", of, part, about), "h", of, about, part, acting.links)


@_kept
def inertia(kind: str, link: int) -> Name:
    """Return the force or the moment of inertia of a link: `F_i2`, `M_i2`."""
    return Name(f"{kind}_{INERTIA}{link}", kind, f"{INERTIA}{link}", part=INERTIA, links=(link,))


def on_link(couple: str, link: int) -> Name:
    """Return a couple, whatever a task calls it, with the link on which it acts."""
    said = role(couple)
    return Name(couple, said.kind, said.of, said.about, said.part, (link,))


def moment(force: str, about: str) -> Name:
    """Return the moment of a force about a point, which is hidden."""
    return Name(f"_M_{force}_{about}", "M", force, about, links=role(force).links)


def by_lever(balance: Name) -> Name:
    """Return what balances the driver as the lever gives it."""
    return Name(f"{balance}_{LEVER}", balance.kind, balance.of, part=LEVER)


def couple(moment: str, point: str = "") -> Name:
    """Return a couple as one of two equal forces, or that of them at a point: `F_i2_couple`, `F_i2_couple_B`."""
    turning = role(moment)
    kind = "F" if turning.kind == "M" else turning.kind
    text = _joined(kind, turning.of, COUPLE, point)
    return Name(text, kind, turning.of, point, COUPLE, turning.links)


def lever_arm(force: str, point: str = "") -> Name:
    """Return the arm of a force on Zhukovsky's lever; of a couple that of its force at a point."""
    return Name(_joined("h", LEVER, force, point), "h", force, point, LEVER, role(force).links)


def magnitude(load: str) -> Name:
    """Return the size of a load, whose own name may be that of a vector."""
    return Name(f"|{load}|", MAGNITUDE, load)


def scale_factor(kind: str, part: str = "", links: Iterable[int] = ()) -> Name:
    """Return the scale factor of plans that show quantities of a kind: `mu_V`; of forces by their group, `mu_F_23`."""
    return Name(_joined("mu", kind, part), "mu", kind, part, links=links)
