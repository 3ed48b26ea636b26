"""What a question says of a mechanism: all that the scheme does not show, and what the quantity is that it asks for."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ...plans.linkages.mechanism import FORCE, FRAME, ZERO, Driver, Mechanism, Prismatic
from ...plans.names import INERTIA, Name, role
from ...plans.quantities import F_BAL, M_BAL
from ...scales.units import unit
from ..tables import with_unit
from ..view import View
from ..words import Words
from .scene import Scene
from .statement import FORCES, SKETCHED, data_table, given_name, kinematic_scheme, use_of

Row = tuple[str, str, str]  # symbol, what it is, value with its unit; all of it markup
# units of literals by what they are used for
OF_USES = {"inertia_factor": "1", "per_length": "kg/m", "mass": "kg", "inertia": "kg*m^2", "gravity": "m/s^2"}
OF_USES |= {"direction": "deg"}
OF_USES |= dict.fromkeys(("place_on_link", "place", "guide", "guide_on_link", "offset", "length", "on_link"), "mm")
OF_USES |= dict.fromkeys(("to_centre", "between_pivots", "distance"), "mm")
OF_LOADS = {"inertia_factor", "per_length", "mass", "inertia", "gravity", "force_direction"}
OF_SHOWN = {"diagram", "diagram_at", "start"}
PARTS = ("", "n", "t", "k", "r")  # of vectors


def scheme_of(scene: Scene) -> View:
    """Return the kinematic scheme without its heading."""
    return kinematic_scheme(scene, SKETCHED[0])


def rows_of(scene: Scene, loaded: bool) -> Iterator[Row]:
    """Go through the data: givens and literals with their names, what moves the driver, with loads how these act.

    Ordinates of load diagrams are left out: the forces in this position stand in their place. The scheme shows what a
    start is for.
    """
    words, mechanism = scene.words, scene.mechanism
    whole = data_table(scene, tuple(FORCES) if loaded else ())
    kept = [name for name in scene.givens if loaded or use_of(mechanism, words, name) not in OF_LOADS]
    uses = {words.symbol(name): use_of(mechanism, words, name) for name in kept}
    for symbol, called, value, of in whole.rows[1:]:
        if uses.get(symbol or "") not in OF_SHOWN:
            yield symbol or "", called or "", with_unit(value or "", of or "")
    for name in sorted(mechanism.givens - scene.givens.keys() - {ZERO}):
        use = use_of(mechanism, words, name)
        if use in OF_USES and (loaded or use not in OF_LOADS):
            value = words.short(round(unit(OF_USES[use]).from_si(scene.values[name]), 9), 9)
            symbol = "" if role(name).hidden else words.symbol(name)
            yield symbol, given_name(mechanism, words, name), with_unit(value, words.unit(OF_USES[use]))
    yield from _axes(scene)
    yield from _driven(scene)
    if loaded:
        yield from _acting(scene)


def _axes(scene: Scene) -> Iterator[Row]:
    """Tell where coordinates begin: those of the frame, those on links that have any."""
    words, mechanism = scene.words, scene.mechanism
    origin = next((point for point, at in mechanism.frame_points.items() if at == (ZERO, ZERO)), "")
    if origin:
        yield "", words["stated.origin"].format(point=words.mark(origin)), ""
    else:
        guide = next(pair for pair in mechanism.pairs if isinstance(pair, Prismatic) and FRAME in pair.links)
        yield "", words["stated.origin_guide"].format(point=words.mark(guide.point)), ""
    for link in mechanism.links:
        start, end = (
            next((p for p, (x, y) in link.points.items() if y == ZERO and (x == ZERO) is at), "")
            for at in (True, False)
        )
        if start and end and any(y != ZERO for _, y in link.points.values()):
            said = {"link": link.number, "start": words.mark(start), "end": words.mark(end)}
            yield "", words["stated.axes"].format(**said), ""


def _driven(scene: Scene) -> Iterator[Row]:
    words, driver = scene.words, scene.mechanism.driver
    if isinstance(driver, Driver) and not any(isinstance(given.value, str) for given in scene.givens.values()):
        about, sense = words.choice("rotation", "ccw" if scene.values[driver.sense] > 0.0 else "cw")
        yield "", about[:1].upper() + about[1:], sense
    if driver.acceleration is None:
        key = "stated.steady" if isinstance(driver, Driver) else "stated.steady_slide"
        yield "", words[key].format(link=driver.link), ""


def _acting(scene: Scene) -> Iterator[Row]:
    """Tell how loads act in this position, where that is not the data's own."""
    words, mechanism = scene.words, scene.mechanism
    if mechanism.gravity is None:
        yield "", words["stated.weightless"], ""
    for load in mechanism.loads:
        symbol, found = words.symbol(load.name), scene.quantities[load.name]
        if not found.value or found.x is None or found.y is None:
            yield "", words["stated.idle"].format(force=symbol), ""
            continue
        if load.magnitude not in scene.givens:
            yield symbol, given_name(mechanism, words, load.name), words.amount(found.value, found.unit, 6)
        angle = math.degrees(math.atan2(found.y, found.x)) % 360.0
        if load.direction not in scene.givens:
            yield "", words["called.force_direction"].format(force=symbol), f"{words.short(round(angle, 6))}°"
    for couple in mechanism.couples:
        symbol, found = words.symbol(couple.name), scene.quantities[couple.name]
        if not found.value:
            yield "", words["stated.idle_moment"].format(moment=symbol), ""
            continue
        if couple.magnitude not in scene.givens:
            size = words.amount(abs(found.value), found.unit, 6)
            yield symbol, given_name(mechanism, words, couple.name), size
        yield "", words["stated.sense"].format(moment=symbol), words["choice.ccw" if found.value > 0.0 else "choice.cw"]


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


def _of_point(mechanism: Mechanism, words: Words, said: Name) -> str:
    """Name a velocity or acceleration of a point, or a part of it, relative to another point or absolute."""
    if said.part not in PARTS:
        return ""
    of, about = (_point(mechanism, words, point) for point in (said.of, said.about))
    relative = words["sought.about"].format(point=about) if about else ""
    key = f"sought.{said.kind}.{said.part}" if said.part else f"sought.{said.kind}"
    return words[key].format(point=of, about=relative)


def _point(mechanism: Mechanism, words: Words, letter: str) -> str:
    """Return the letter of a point; of one that only coincides with another, on which link it is."""
    points = {point for link in mechanism.links for point in link.points} | {*mechanism.frame_points}
    plain = not letter or letter in points or not letter[-1].isdigit()
    return words.mark(letter) if plain else words["sought.on_link"].format(point=words.mark(letter), link=letter[-1])
