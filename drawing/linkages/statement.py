"""The statement of a task: the kinematic scheme, the data with their names, what is to be found and how it is written.

What a given is called follows from where the mechanism uses it: `l_OA` is the length of its link OA.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace

from ...plans.board import POSITION
from ...plans.linkages.mechanism import FRAME, Link, Mechanism, Prismatic, SlidingDriver, positive
from ...plans.names import role
from ...scales.scale import Scale, steps
from ..page import SCHEME, TASK
from ..tables import givens_view, text_block
from ..view import View
from ..words import Words
from .calculations.tables import results_parts
from .figures.links import draw_links, letter_links
from .figures.scheme import draw_axes, draw_driver, letter_axes, letter_frame
from .scene import Scene

# mm that the links of the scheme take at most, as there is room; so large where directions are taken off it
BOXES = (140.0, 84.0), (110.0, 66.0), (80.0, 52.0)
SKETCHED = BOXES[2:]
ROUND = (1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0)  # scale factors of a scheme, but for powers of ten
# names of what a task without forces does not need
LOADED = {"mass", "per_length", "inertia", "inertia_factor", "force", "force_direction", "moment", "gravity"}
LOADED |= {"diagram", "diagram_at"}
FOUND = ("R", "M", "F")  # kinds of quantities that a force plan is drawn for
BREAKS = re.compile(r" (?![^{]*\})")  # where a line may break: not within an index
JOINT = re.compile(r"[A-Z]\d*")  # a lettered point in the name of a length
RATES = ("n", "omega", "epsilon", "v", "V", "a")  # kinds of what moves the driver
AXES = "xy"
FORCES = {"forces", "lever"}
Told = tuple[str, dict[str, str]]
NOTHING: Told = "", {}


def given_name(mechanism: Mechanism, words: Words, name: str) -> str:
    """Return the words for a given of a mechanism, as markup; nothing for one whose use does not tell what it is."""
    key, said = _told(mechanism, words, name)
    return words[f"called.{key}"].format(**said) if key else ""


def use_of(mechanism: Mechanism, words: Words, name: str) -> str:
    """Return the key of what the mechanism uses a value for; nothing where that does not tell what it is."""
    return _told(mechanism, words, name)[0]


def _told(mechanism: Mechanism, words: Words, name: str) -> Told:
    ways = (_of_driver, _of_length, _of_link, _of_place, _of_load)
    return next((told for way in ways if (told := way(mechanism, words, name)) != NOTHING), NOTHING)


def _of_driver(mechanism: Mechanism, words: Words, name: str) -> Told:
    driver, kind = mechanism.driver, role(name).kind
    if name == driver.coordinate:
        return "s" if isinstance(driver, SlidingDriver) else "phi", {"link": str(driver.link)}
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
    links = [link for link in mechanism.links if name in (*link.givens, *_coordinates(link))]
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


def _coordinates(link: Link) -> list[str]:
    return [xy for at in _places(link).values() for xy in at]


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


def statements(
    scene: Scene, plans: Collection[str], variant: str, width: float, fixed: Iterable[Scale] = ()
) -> Iterator[list[View]]:
    """Go through the views of the statement with ever smaller schemes: scheme, data, what the plans have to find.

    Lines of text are at most `width` mm long; they say which scale factors are `fixed` by the task. Where no plan of
    the mechanism is asked for, the scheme is to scale.
    """
    task = task_text(scene, plans, variant, width, fixed)
    scaled, others = POSITION not in plans, [data_table(scene, plans), task]
    yield from ([kinematic_scheme(scene, box, scaled), *others] for box in (BOXES if scaled else SKETCHED))


def kinematic_scheme(scene: Scene, box: tuple[float, float] = SKETCHED[0], scaled: bool = False) -> View:
    """Draw the links in a box, mm: pairs, the driver with its angle and its sense; where `scaled`, with its scale."""
    places = [scene.solved.point(point) for point in (*scene.points, *scene.mechanism.frame_points)]
    sides = (max(of) - min(of) for of in zip(*((at.real, at.imag) for at in places), strict=True))
    mu = steps(max(side / most for side, most in zip(sides, box, strict=True)), ROUND)[0]
    scene = replace(scene, scales={**scene.scales, POSITION: Scale("mu_l", mu, "m")}, runs={})
    canvas = scene.canvas()
    draw_axes(canvas, scene)
    figures = draw_links(canvas, scene, scene.numbers)
    draw_driver(canvas, scene)
    letter_axes(canvas, scene)
    letter_frame(canvas, scene, figures)
    letter_links(canvas, scene, figures)
    heading = scene.heading("heading.kinematic", *((POSITION,) if scaled else ()))
    return replace(canvas.finish(SCHEME, heading), parts=())


def data_table(scene: Scene, plans: Collection[str]) -> View:
    """Return the givens that the plans need, with what they are called."""
    told = {name: use_of(scene.mechanism, scene.words, name) for name in scene.givens}
    needless = set[str]() if FORCES & {*plans} else LOADED
    needless = needless if {"acceleration", *FORCES} & {*plans} else needless | {"a", "epsilon"}
    needed = {name: given for name, given in scene.givens.items() if told[name] not in needless}
    called = {name: given_name(scene.mechanism, scene.words, name) for name in needed}
    return givens_view(needed, scene.words, scene.style, called=called)


def task_text(scene: Scene, plans: Collection[str], variant: str, width: float, fixed: Iterable[Scale] = ()) -> View:
    """Return what is to be found, a line for each plan, at which fixed scale factors, and how answers are written."""
    words, lines = scene.words, aims(scene, plans)
    scales = ", ".join(map(words.scale, fixed))
    lines += [words["task.scales"].format(scales=scales)] if scales else []
    angle = words["task.angles"] if words.notation["angles"] else ""
    lines += [words["task.reading"], words["task.senses"], *([angle] if angle else [])]
    return text_block(
        TASK, words["heading.task"].format(variant=variant), [BREAKS.split(line) for line in lines], scene.style, width
    )


def aims(scene: Scene, plans: Collection[str]) -> list[str]:
    """Return what the plans have to find, a sentence each."""
    return [scene.words[f"task.{plan}"].format(names=", ".join(_sought(scene, plan))) for plan in plans]


def _sought(scene: Scene, plan: str) -> Iterator[str]:
    """Go through the symbols of what a plan finds, but for each force of a load and each arm."""
    for part in (part for part in results_parts(scene.solved) if part.kind == plan):
        for name in part.names:
            quantity = role(name)
            if plan not in FORCES or (quantity.kind in FOUND and not quantity.part and not quantity.about):
                yield scene.words.symbol(name)
