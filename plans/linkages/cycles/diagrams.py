"""Motion of a point or a link over the cycle: travel, velocity and acceleration by plans and by chords."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....scales.errors import InputError
from ....scales.names import unknown
from ...graphs import Curve, Diagrams, differentiate
from ...laws import inclination
from ..chain import moving_bodies
from .cycle import Cycle
from .strokes import Output, unwound

Array = NDArray[Any]


class _Motion:
    """Names of the travel, velocity and acceleration of what `of` means: a point's letter or the number of a link."""

    def __init__(self, cycle: Cycle, of: str) -> None:
        mechanism = cycle.mechanism
        points = dict.fromkeys(point for link in mechanism.links for point in link.points)
        links = {str(link.number): link.number for link in mechanism.links}
        slider = _slider_with(cycle, of)
        self.angle = of in links and slider is None
        if slider is not None:
            self.names = (slider.place, slider.rate, slider.change)
        elif self.angle:
            body = moving_bodies(mechanism, cycle.structure)[links[of]]
            self.names = (body.direction, body.omega, body.epsilon)
        elif of in points:
            self.names = (of, mechanism.mark("velocity", of), mechanism.mark("acceleration", of))
        else:
            raise unknown("motion-unknown", of, (*points, *links))
        self.cycle = cycle
        if not set(filter(None, self.names)) <= set(cycle.program.names):
            raise InputError("motion-plans", name=of)

    def at(self, places: Array) -> tuple[Array, Array, Array]:
        """Return travels, velocities and accelerations for places of the driver; angles without jumps."""
        values = self.cycle.at(places, [name for name in self.names if name])
        s, v, a = (values[name] if name else np.zeros(len(places)) for name in self.names)
        return unwound(inclination(s)) if self.angle else s, v, a


def _slider_with(cycle: Cycle, of: str) -> Output | None:
    """Return the slider on the frame that `of` names, or that carries this point."""
    sliders = (output for output in cycle.outputs if output.slides)
    return next((x for x in sliders if of in (str(x.link), *cycle.mechanism.link(x.link).points)), None)


def diagrams(cycle: Cycle, of: str, sections: int = 12) -> Diagrams:
    """Draw the diagrams of a point or a link over the cycle, by plans and by chords.

    Parameters
    ----------
    of : str
        A point's letter, or the number of a link for its angle. A slider on the frame, or a point of it, has signed
        travels along its guide; of any other point travel, velocity and acceleration are vectors.
    sections : int
        Sections of the cycle.

    Raises
    ------
    InputError
        No such point or link; the cycle was computed without velocities or accelerations.
    """
    motion = _Motion(cycle, of)
    places = cycle.range.low + (cycle.range.high - cycle.range.low) * (np.arange(2 * sections + 1) / (2 * sections))
    closed = cycle.drive.turns
    duration = abs(cycle.range.high - cycle.range.low) / cycle.speed
    s, v, a = motion.at(places)
    times = duration * (np.arange(2 * sections + 1) / (2 * sections))
    v_chords, a_chords = differentiate(s[::2], duration / sections, closed)
    inner = slice(0, -1) if closed else slice(1, -1)
    return Diagrams(
        "rad" if motion.angle else "m",
        times[::2],
        s[::2],
        v[::2],
        a[::2],
        Curve(times[1::2], v[1::2], v_chords),
        Curve(times[::2][inner], a[::2][inner], a_chords),
    )
