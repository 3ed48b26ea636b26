"""What is said of a mechanism in words: the data with their names, what the scheme does not show, what is asked for.

What a given is called follows from where the mechanism uses it: `l_OA` is the length of its link OA.
"""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterator
from itertools import chain
from typing import TypeAlias

from ...plans.linkages.compound import found_here
from ...plans.linkages.mechanism import FORCE, FRAME, ZERO, Driver, Link, Mechanism, Prismatic, SlidingDriver, positive
from ...plans.names import INERTIA, Name, role
from ...plans.quantities import F_BAL, M_BAL
from ...scales.units import unit
from ..tables import givens_view
from ..words import Words
from .scene import Scene

Row: TypeAlias = tuple[str, str, str, str]  # symbol, what it is, value, unit: all of it markup; no value: a sentence
# units of literals by what they are used for
OF_USES = {"inertia_factor": "1", "per_length": "kg/m", "mass": "kg", "inertia": "kg*m^2", "gravity": "m/s^2"}
OF_USES |= {"direction": "deg", "phi": "deg", "omega": "rad/s", "epsilon": "rad/s^2", "v": "m/s", "a": "m/s^2"}
OF_USES |= dict.fromkeys(("place_on_link", "place", "guide", "guide_on_link", "offset", "length", "on_link"), "mm")
OF_USES |= dict.fromkeys(("to_centre", "between_pivots", "distance", "s"), "mm")
FORCES = {"forces", "lever"}
# uses of what a task without forces, or without accelerations does not need
LOADED = {"mass", "per_length", "inertia", "inertia_factor", "force", "force_direction", "moment", "gravity"}
LOADED |= {"diagram", "diagram_at"}
SPED_UP = {"a", "epsilon"}
DRAWN = {"diagram", "diagram_at", "start"}  # uses of what stands on a figure
JOINT = re.compile(r"[A-Z]\d*")  # a lettered point in the name of a length
RATES = ("n", "omega", "epsilon", "v", "V", "a")  # kinds of what moves the driver
AXES = "xy"
ROTATION = "rotation"  # the choice that is called so says the sense of the driver
PARTS = ("", "n", "t", "k", "r")  # of vectors
Told = tuple[str, dict[str, str]]
NOTHING: Told = "", {}


def given_name(mechanism: Mechanism, words: Words, name: str) -> str:
    """Return the words for a given of a mechanism, as markup; nothing for one whose use does not tell what it is."""
    key, said = _told(mechanism, words, name)
    return words[f"called.{key}"].format(**said) if key else ""


def _use_of(mechanism: Mechanism, words: Words, name: str) -> str:
    """Return the key of what the mechanism uses a value for; nothing where that does not tell what it is."""
    return _told(mechanism, words, name)[0]


def _told(mechanism: Mechanism, words: Words, name: str) -> Told:
    ways = (_of_driver, _of_length, _of_link, _of_place, _of_load)
    return next((told for way in ways if (told := way(mechanism, words, name)) != NOTHING), NOTHING)


def _of_driver(mechanism: Mechanism, words: Words, name: str) -> Told:
    driver, kind = mechanism.driver, role(name).kind
    slides = isinstance(driver, SlidingDriver)
    if name == driver.coordinate:
        return "s" if slides else "phi", {"link": str(driver.link)}
    if role(name).hidden and name in (driver.speed, driver.acceleration):
        speed, acceleration = ("v", "a") if slides else ("omega", "epsilon")
        return speed if name == driver.speed else acceleration, {"link": str(driver.link)}
    if (kind or name) in RATES and role(name).of in ("", name, str(driver.link)):
        return (kind or name).lower(), {"link": str(driver.link)}
    return NOTHING


def _of_length(mechanism: Mechanism, words: Words, name: str) -> Told:
    """Tell the distance of two points: a link from pin to pin, a centre of mass from a pin, two pivots."""
    letters = role(name).of
    ends = JOINT.findall(letters)
    if role(name).kind != "l" or "".join(ends) != letters or len(ends) != len("AB"):
        return NOTHING
    a, b = map(words.mark, ends)
    if {*ends} <= mechanism.frame_points.keys():
        return "between_pivots", {"a": a, "b": b}
    pins = {pair.point for pair in mechanism.pairs}
    for link in mechanism.links:
        points = {*link.points}
        if {*ends} <= points or (role(name).of in points and points & {*ends}):
            if link.centre == ends[1] and ends[1] not in pins:
                return "to_centre", {"a": a, "b": b}
            whole = {*ends} <= pins
            return "length" if whole else "on_link", {"a": a, "b": b, "link": str(link.number)}
    return "distance", {"a": a, "b": b}


def _of_link(mechanism: Mechanism, words: Words, name: str) -> Told:
    links = [link for link in mechanism.links if name in (*link.givens, *chain.from_iterable(_places(link).values()))]
    if not links:
        return NOTHING
    link, numbers = links[0], words.listed([str(link.number) for link in links])
    if name in (link.mass, link.per_length):
        return "mass" if name == link.mass else "per_length", {"link": numbers}
    if name in (link.inertia, link.inertia_factor):
        about = words.mark(link.centre or "S")
        return "inertia" if name == link.inertia else "inertia_factor", {"link": numbers, "point": about}
    point, axis = next((p, AXES[at.index(name)]) for p, at in _places(link).items() if name in at)
    return "place_on_link", {"axis": axis, "point": words.mark(point), "link": str(link.number)}


def _places(link: Link) -> dict[str, tuple[str, ...]]:
    return {point: tuple(map(positive, at)) for point, at in link.points.items()}


def _of_place(mechanism: Mechanism, words: Words, name: str) -> Told:
    """Tell where a pair stands, or how its guide runs."""
    for pair in mechanism.pairs:
        at = tuple(map(positive, pair.coordinates))
        said = {"point": words.mark(pair.point)}
        if isinstance(pair, Prismatic):
            if name == positive(pair.offset):
                return "offset", said
            if name == pair.direction:
                return "direction", said
            if name in at:
                return "guide" if FRAME in pair.links else "guide_on_link", {**said, "axis": AXES[at.index(name)]}
        elif name in at:
            return "place", {**said, "axis": AXES[at.index(name)]}
    start = next((start for start in mechanism.starts if name in (start.x, start.y, start.angle)), None)
    return NOTHING if start is None else ("start", {"link": str(start.link)})


def _of_load(mechanism: Mechanism, words: Words, name: str) -> Told:
    for load in mechanism.loads:
        if name in (load.magnitude, load.name):
            return "force", {"point": words.mark(load.point), "link": str(load.link)}
        if name == load.direction:
            return "force_direction", {"force": words.symbol(load.name)}
    for couple in mechanism.couples:
        if name in (couple.magnitude, couple.name):
            return "moment", {"link": str(couple.link)}
    for diagram in mechanism.diagrams:
        if name in (*diagram.sizes, *diagram.at):
            return "diagram" if name in diagram.sizes else "diagram_at", {}
    return ("gravity", {}) if name == mechanism.gravity else NOTHING


def rows_of(scene: Scene, plans: Collection[str], here: bool = False) -> Iterator[Row]:
    """Go through the data that the plans need: givens and literals with their names, senses, then sentences.

    Ordinates of load diagrams are left out where the forces stand in their place that act `here`, in this position.
    """
    words, mechanism = scene.words, scene.mechanism
    loaded = bool(FORCES & {*plans})
    needless = (set() if loaded else LOADED) | (set() if {"acceleration", *FORCES} & {*plans} else SPED_UP)
    needless |= DRAWN if here else set()
    kept = {name: given for name, given in scene.givens.items() if _use_of(mechanism, words, name) not in needless}
    called = {name: given_name(mechanism, words, name) for name in kept}
    for symbol, said, value, of in givens_view(kept, words, scene.style, called=called).rows[1:]:
        yield symbol or "", said or "", value or "", of or ""
    for name in sorted((mechanism.givens | _rates(mechanism)) - scene.givens.keys() - {ZERO}):
        use = _use_of(mechanism, words, name)
        if use in OF_USES and use not in needless:
            value = words.short(round(unit(OF_USES[use]).from_si(scene.values[name]), 9), 9)
            yield _symbol(words, name), given_name(mechanism, words, name), value, words.unit(OF_USES[use])
    acting = [*_acting(scene, here)] if loaded else []
    more = [*_axes(scene), *_driven(scene, bool(needless & SPED_UP)), *acting]
    yield from sorted(more, key=lambda row: not row[2])  # sentences are last


def _rates(mechanism: Mechanism) -> set[str]:
    driver = mechanism.driver
    return {driver.coordinate, driver.speed, driver.acceleration or ZERO}


def _symbol(words: Words, name: str) -> str:
    return "" if role(name).hidden else words.symbol(name)


def _axes(scene: Scene) -> Iterator[Row]:
    """Tell where coordinates begin: those of the frame, those on links that have any."""
    words, mechanism = scene.words, scene.mechanism
    origin = next((point for point, at in mechanism.frame_points.items() if at == (ZERO, ZERO)), "")
    if origin:
        yield _sentence(words["stated.origin"].format(point=words.mark(origin)))
    else:
        guide = next(pair for pair in mechanism.pairs if isinstance(pair, Prismatic) and FRAME in pair.links)
        yield _sentence(words["stated.origin_guide"].format(point=words.mark(guide.point)))
    for link in mechanism.links:
        start, end = (
            next((p for p, (x, y) in link.points.items() if y == ZERO and (x == ZERO) is at), "")
            for at in (True, False)
        )
        if start and end and any(y != ZERO for _, y in link.points.values()):
            said = {"link": link.number, "start": words.mark(start), "end": words.mark(end)}
            yield _sentence(words["stated.axes"].format(**said))


def _sentence(text: str) -> Row:
    return "", text, "", ""


def _driven(scene: Scene, steady: bool) -> Iterator[Row]:
    """Tell the sense of the driver; of one that moves steadily that it does, unless that goes without saying."""
    words, driver = scene.words, scene.mechanism.driver
    if isinstance(driver, Driver) and ROTATION not in scene.givens:
        sense = words["choice.ccw" if scene.values[driver.sense] > 0.0 else "choice.cw"]
        yield "", words["stated.rotation"].format(link=driver.link), sense, ""
    if driver.acceleration is None and not steady:
        key = "stated.steady" if isinstance(driver, Driver) else "stated.steady_slide"
        yield _sentence(words[key].format(link=driver.link))


def _acting(scene: Scene, here: bool) -> Iterator[Row]:
    """Tell how loads act in this position, where that is not the data's own; of diagrams how much only if `here`."""
    words, mechanism = scene.words, scene.mechanism
    drawn = {} if here else {diagram.name for diagram in mechanism.diagrams}
    if mechanism.gravity is None:
        yield _sentence(words["stated.weightless"])
    for load in mechanism.loads:
        symbol, found = words.symbol(load.name), scene.quantities[load.name]
        if not found.value or found.x is None or found.y is None:
            yield _sentence(words["stated.idle"].format(force=symbol))
            continue
        if load.magnitude not in {*scene.givens, *drawn}:
            size, of = words.short(float(f"{found.value:.6g}")), words.unit(found.unit)
            yield symbol, given_name(mechanism, words, load.name), size, of
        angle = math.degrees(math.atan2(found.y, found.x)) % 360.0
        if load.direction not in scene.givens:
            called = words["called.force_direction"].format(force=symbol)
            yield "", called, words.short(round(angle, 6)), words.unit("deg")
    for couple in mechanism.couples:
        symbol, found = words.symbol(couple.name), scene.quantities[couple.name]
        if not found.value:
            yield _sentence(words["stated.idle_moment"].format(moment=symbol))
            continue
        if couple.magnitude not in {*scene.givens, *drawn}:
            size, of = words.short(float(f"{abs(found.value):.6g}")), words.unit(found.unit)
            yield symbol, given_name(mechanism, words, couple.name), size, of
        sense = words["choice.ccw" if found.value > 0.0 else "choice.cw"]
        yield "", words["stated.sense"].format(moment=symbol), sense, ""


def meaning(mechanism: Mechanism, words: Words, name: str) -> str:
    """Return in words, as markup, what a quantity is; nothing for arms, couples, parts of reactions, what is given."""
    said = role(name)
    if said.kind in ("V", "a"):
        return _of_point(mechanism, words, said)
    if said.kind in ("omega", "epsilon") and not said.part:
        return words[f"sought.{said.kind}"].format(link=said.of)
    if said.part == INERTIA and said.kind in ("F", "M"):
        return words[f"sought.{said.kind}_i"].format(link=said.of.removeprefix(INERTIA))
    if said.kind == "R" and not said.part and len(said.links) == len("ij"):
        first, second = said.links
        acting = words["sought.link" if first else "sought.frame"].format(link=first)
        acted = words["sought.link_on" if second else "sought.frame_on"].format(link=second)
        return words["sought.R"].format(symbol=words.symbol(name), first=acting, second=acted)
    if name == M_BAL:
        return words["sought.M_bal"].format(link=mechanism.driver.link)
    driver = mechanism.driver
    if name == F_BAL and (not isinstance(driver, Driver) or driver.balance == FORCE):
        key = "sought.F_bal" if isinstance(driver, Driver) else "sought.F_slide"
        return words[key].format(point=words.mark(driver.point))
    return ""


def meanings(scene: Scene) -> dict[str, str]:
    """Return what the symbols of quantities mean that are found, in words, as markup."""
    found, compound = dict[str, str](), found_here(scene.program)
    for name in (name for name in scene.quantities if name not in compound):
        said, symbol = role(name), scene.words.symbol(name)
        if said.kind in ("omega", "epsilon") and not said.part:
            found[symbol] = scene.words[f"meant.{said.kind}"].format(link=said.of)
        elif told := meaning(scene.mechanism, scene.words, name):
            found[symbol] = told
    return found


def _of_point(mechanism: Mechanism, words: Words, said: Name) -> str:
    """Name a velocity or acceleration of a point, or a part of it, relative to another point or absolute."""
    if said.part not in PARTS:
        return ""
    of, about = (_point(mechanism, words, point) for point in (said.of, said.about))
    relative = words["sought.about"].format(point=about) if about else ""
    key = f"sought.{said.kind}.{said.part}" if said.part else f"sought.{said.kind}"
    return words[key].format(point=of, about=relative)


def _points(mechanism: Mechanism) -> set[str]:
    return {point for link in mechanism.links for point in link.points} | {*mechanism.frame_points}


def on_scheme(mechanism: Mechanism, name: str) -> bool:
    """Whether the points of a quantity stand on the scheme: a triad's special point stands on no link of it."""
    points = _points(mechanism)
    told = (letter for letter in (role(name).of, role(name).about) if role(name).kind in ("V", "a") and letter)
    return all(letter in points or letter.rstrip("0123456789") in points for letter in told)


def _point(mechanism: Mechanism, words: Words, letter: str) -> str:
    """Return the letter of a point; of one that only coincides with another, on which link it is."""
    plain = not letter or letter in _points(mechanism) or not letter[-1].isdigit()
    return words.mark(letter) if plain else words["sought.on_link"].format(point=words.mark(letter), link=letter[-1])
