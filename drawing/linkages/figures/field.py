"""The velocity field of a link: velocities of points all over it, to scale, in the position that is drawn."""

from __future__ import annotations

import numpy as np

from ....plans.board import POSITION
from ....plans.linkages.field import MARGIN, velocity_field
from ....plans.linkages.mechanism import FRAME
from ....plans.linkages.solved import SolvedLinkage
from ....scales.scale import Scale, steps
from ...shapes import Circle, HeadPlace, Pen, Vector
from ...view import Canvas, View
from ..scene import Scene
from .links import draw_links, letter_links

PITCH = 5.0  # distance of neighbouring points in arrowheads
MOST = 100.0  # such distances along a side, more than a sheet has room for
APART = 0.9  # longest vector in parts of the distance of neighbouring points


def coupler(solved: SolvedLinkage) -> int | None:
    """Return the first link with two joints that is not on the frame: only such a link has a field worth drawing."""
    mechanism = solved.mechanism
    on_frame = {number for pair in mechanism.pairs if FRAME in pair.links for number in pair.links}
    turning = [number for number in _numbers(solved) if number not in on_frame and _turns(solved, number)]
    return turning[0] if turning else None


def _numbers(solved: SolvedLinkage) -> list[int]:
    return [number for group in solved.structure.groups for number in group.links]


def _turns(solved: SolvedLinkage, number: int) -> bool:
    joints = {pair.point for pair in solved.mechanism.pairs if number in pair.links}
    return len(joints) > 1 and bool(solved.values.get(f"omega_{number}"))


def _grid(scene: Scene, link: int) -> tuple[int, int]:
    """Return how many columns and rows stand so far apart that arrows have room between them."""
    pitch = PITCH * scene.style.arrow * scene.scales[POSITION].mu
    points = [scene.solved.point(point) for point in scene.solved.mechanism.link(link).points]
    width, height = (float(np.ptp(part)) for part in (np.real(points), np.imag(points)))
    side = max(width, height)
    wanted = ((part + 2.0 * MARGIN * side) / pitch for part in (width, height))
    columns, rows = (max(2, round(min(count, MOST)) + 1) for count in wanted)
    return columns, rows


def field_view(scene: Scene, link: int) -> View:
    """Draw a link with the velocities of a grid of its points, at a scale factor at which they do not cross."""
    canvas = Canvas(scene.style)
    places, velocities = velocity_field(scene.solved, link, *_grid(scene, link))
    per_mm = 1.0 / scene.scales[POSITION].mu
    nearest = min(abs(places[0, 1] - places[0, 0]), abs(places[1, 0] - places[0, 0])) * per_mm
    largest = float(np.max(np.abs(velocities)))
    scale = Scale("mu_V", steps(largest / (APART * nearest))[0], "m/s")
    for at, velocity in zip(places.ravel().tolist(), velocities.ravel().tolist(), strict=True):
        tail, value = at * per_mm, abs(velocity)
        tip = tail + velocity * (1.0 / scale.mu)
        short = abs(tip - tail) < scene.style.arrow
        canvas.add(Circle(tail, 0.3, Pen.THIN, fill="black"))
        head: HeadPlace = "none" if short else "tip"
        canvas.add(Vector(tail, tip, f"v_{link}", value, scale.unit, scale.mu, Pen.THIN, head=head))
    figures = draw_links(canvas, scene, [link], framed=False)
    letter_links(canvas, scene, [link], figures)
    heading = scene.heading("heading.field", POSITION, link=str(link))
    return canvas.finish("field", (*heading, scene.words.scale(scale)))
