"""Sizes of letters, nodes and symbols on each format, in mm (letters: GOST 2.304; symbols: what reads well)."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Style:
    """What a format wants: cap heights, and sizes of the symbols of links, pairs and arrows."""

    label: float  # letters of nodes and vectors
    heading: float  # names of views
    text: float  # tables and equations
    pair: float  # radius of a revolute pair
    pivot: tuple[float, float, float]  # width, height, base of a fixed pivot
    slider: tuple[float, float]
    hatch: tuple[float, float]  # stroke, pitch
    centre: float  # radius of a centre of mass
    arrow: float  # arrowhead
    force: float  # an arrow that only shows a direction
    node: float  # radius of a node of a plan


STYLES = {
    "A1": Style(5.0, 5.0, 3.5, 2.5, (12.0, 9.0, 16.0), (16.0, 9.0), (3.5, 2.5), 1.25, 4.0, 26.0, 0.8),
    "A2": Style(5.0, 5.0, 3.5, 2.0, (10.0, 8.0, 14.0), (13.0, 8.0), (3.0, 2.2), 1.1, 3.5, 22.0, 0.7),
    "A3": Style(3.5, 3.5, 2.5, 1.75, (9.0, 7.0, 12.0), (11.0, 6.5), (2.5, 1.8), 1.0, 3.0, 19.0, 0.6),
    "A4": Style(3.5, 3.5, 2.5, 1.5, (7.0, 5.5, 9.0), (9.0, 5.0), (2.0, 1.5), 0.9, 2.5, 16.0, 0.5),
}
