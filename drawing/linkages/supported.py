"""Which mechanisms the sheets can show: a crank that turns steadily, straight rods, sliders on guides of the frame."""

from __future__ import annotations

from ...plans.linkages import driver
from ...plans.linkages.mechanism import FRAME, ZERO, Mechanism, Prismatic
from ...plans.linkages.parts import Span
from ...plans.linkages.structure import Group, Structure
from ...scales.errors import InputError


def require_views(mechanism: Mechanism, structure: Structure) -> None:
    """Refuse a mechanism that has numbers but no views yet.

    Raises
    ------
    InputError
        With the key `no-views` and the links that no view can show.
    """
    crank = mechanism.driver
    if crank.acceleration or not driver.span(mechanism).straight:
        raise InputError("no-views", links=str(crank.link))
    for couple in mechanism.couples:
        raise InputError("no-views", links=str(couple.link))
    for group in structure.groups:
        for link in _without_view(mechanism, group):
            raise InputError("no-views", links=link)


def _without_view(mechanism: Mechanism, group: Group) -> list[str]:
    """Return the links of a group that no view can show."""
    if group.kind != "RRP":
        return [", ".join(map(str, group.links))]
    rod, slider = group.links
    guide, B = group.outer[1], group.inner[0].point
    assert isinstance(guide, Prismatic)
    shown = {
        rod: Span(mechanism.link(rod), group.outer[0].point, B).straight,
        slider: (guide.links, guide.point, mechanism.link(slider).points[B]) == ((slider, FRAME), B, (ZERO, ZERO)),
    }
    return [str(link) for link, plain in shown.items() if not plain]
