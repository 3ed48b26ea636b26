"""A hoist on the page that moves: beams bend, the load leaves its support, the forces on it grow with time."""

from __future__ import annotations

from ...plans.hoist.construction import ENDS
from ...plans.hoist.course import HoistCourse
from ..moving import Data, html, number
from ..moving.courses import Moving, driven
from .diagrams_view import forces_field
from .scene import HoistScene

BENT = 40  # pieces of a bent beam
LOAD = 0.2  # of the rope's length, the load's height
MOST = 0.4  # of the rope's length, the largest displacement as it is shown
LONGEST = 45.0  # mm, the arrow of the largest force
TIMES = [1.0, "times"]  # by what displacements are enlarged
ENLARGED = "\ue000"  # stands for that in the heading
SHOWN = ("t", "y", "s", "F_01", "F_12", "sigma", "w_0", "w_2")
FIRST = ("F_12", "F_01", "s", "sigma")


def moving(scene: HoistScene) -> Moving:
    """Return what moves of a hoist, its displacements enlarged."""
    words, course = scene.words, HoistCourse(scene.solved)
    size, end = scene.size, course.forces.end
    rope, tall = size("L"), LOAD * size("L")
    times: Data = {"of": ["s", "w_0", "w_2"], "round": 0.5 * MOST * rope, "now": course.enlarged(0.5 * MOST)}
    points, shapes = _beams(scene, course)
    points |= {"A0": 0j, "A2": 1j * rope, "up": 1j * tall}
    points |= {"below": complex(0.9 * tall), "above": complex(0.3 * tall, tall)}  # where the forces on the load stand
    load, top, drum = ([at, way, TIMES, 0.0] for at, way in (("A0", "load.s"), ("up", "load.s"), ("A2", "drum.w_2")))
    shapes += [
        {"k": "bar", "a": top, "b": drum},
        {"k": "box", "at": load, "wide": 1.3 * tall, "high": tall},
        {"k": "disk", "at": drum, "r": 0.25 * tall},
        _force("F_12", html(words.symbol("F_12")), "above"),
        _force("F_01", html(words.symbol("F_01")), "below"),
    ]
    xs, margin = [at.real for at in points.values()], 0.6 * tall
    extent = [min(xs) - margin, -2.5 * tall, max(xs) + margin, rope + 2.0 * tall]
    view: Data = {"name": "position", "heading": words["moving.hoist"].format(n=ENLARGED), "symbol": ""}
    view |= {"extent": extent, "shapes": shapes}
    more: Data = {"again": end, "end": "end" if course.changeable else "", "grows": True, "crank": None}
    drive = driven("t", "t", (0.0, end), 1.0, **more, by=1.0, unit=words.unit("s"), digits=4)
    over, symbols = {"forces": [_moment(scene)]}, {"s": "s", "sigma": "σ"}
    return Moving(drive, [view], points, SHOWN, FIRST, over, symbols, "forces", {"times": times})


def _force(name: str, text: str, at: str) -> Data:
    """Return the arrow of a force on the load, as long as the force is great."""
    place = [at, "load.s", TIMES, 0.0]
    return {"k": "force", "at": place, "v": f"load.{name}", "q": name, "text": text, "long": LONGEST}


def _moment(scene: HoistScene) -> Data:
    """Return what marks the moment on the diagram of forces: a line over all of it, and a spot on each curve."""
    field = forces_field(scene)
    low, high = (round(field.at(0.0, end).imag, 1) for end in (field.y.low, field.y.high))
    mm = {axis: 1.0 / of.scale.mu for axis, of in (("x", field.x), ("y", field.y))}
    return {"k": "moment", "low": low, "high": high, "of": ["F_01", "F_12"], **mm}


def _beams(scene: HoistScene, course: HoistCourse) -> tuple[dict[str, complex], list[Data]]:
    """Return the ends of the beams, and the beams with their supports, bent by what is above or below them."""
    points: dict[str, complex] = {}
    shapes: list[Data] = []
    for i, level in ((0, 0j), (2, 1j * scene.size("L"))):
        l, b = scene.size(f"l_{i}"), scene.size(f"b_{i}")
        near_left = scene.solved.layout.near[i // 2] == "left"
        left = level - (b if near_left else l - b)
        points |= {ENDS[i][0]: left, ENDS[i][1]: left + l}
        bent = course.bent(i, BENT + 1)
        line = [[number(left.real + x, 6), number(left.imag, 6)] for x, _ in bent]
        shapes.append({"k": "bent", "d": line, "by": [number(-w, 6) for _, w in bent], "v": f"w_{i}"})
        shapes += [{"k": "pivot", "at": end} for end in ENDS[i]]
    return points, shapes
