"""The stages in which each view of a cam is drawn, in the order in which the recorded construction does it.

A stage is a part of a view, and the steps of the construction after which it is drawn. It is a stage of a cam only if
this construction has such steps: a velocity that jumps is integrated once, not twice, a limit on both sides has two
more tangents. A stage that no step belongs to, because it is no construction, ends its view.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass

from ...plans.cams.rocker_plans import ROCKER_SIZES
from ...plans.cams.size_plans import PLATE_SIZES, SIZES
from ...plans.cams.solve import SolvedCam

SHARPEST = "sharpest"
Firsts = dict[tuple[str, str], int]  # where the first step of each family and verb stands
NUMBER = re.compile(r"\d+")


@dataclass(frozen=True, slots=True)
class Stage:
    """A part of a view, drawn by the steps of a family, `#` for numbers; `verb` tells marks of one name apart."""

    part: str
    family: str = ""
    verb: str = ""


# by view; the first stage of each is drawn before any step, and on a blank
DIAGRAMS = (
    Stage("axes", "diagram_s.#", "pole"),
    Stage("sections", "diagram_s.f#"),
    Stage("law_a", "diagram_a.m#"),
    Stage("law_v", "diagram_v.m#", "place"),
    Stage("rays_a", "diagram_a.p#"),
    Stage("chords_v", "diagram_v.#", "meet"),
    Stage("means_v", "diagram_v.m#", "divide"),
    Stage("rays_v", "diagram_v.p#"),
    Stage("chords_s", "diagram_s.#", "meet"),
    Stage("scales", "mu_s"),
)
OF_ROLLER = (
    Stage("axes", "sizes.#", "pole"),
    Stage("points", "sizes.#_rise"),
    *(Stage(f"tangent_{limit}", f"sizes.T_{limit}") for limit in ("rise", "fall", "rise_back", "fall_back")),
    Stage("permitted", "sizes.A"),
    Stage("centre", "sizes.C"),
    Stage("pressure", "gamma_rise_min"),
)
OF_PLATE = (
    Stage("axes", "plate_sizes.#", "pole"),
    Stage("points", "plate_sizes.#_before"),
    Stage("tangent", "plate_sizes.T"),
    Stage("centre", "r_0_flat"),
    Stage("centre", "rho_flat_min"),  # where r_0_flat is given
)
OF_ROCKER = (
    Stage("pivot", "rocker_sizes.#", "pole"),
    Stage("positions", "rocker_sizes.B#"),
    Stage("analogues", "rocker_sizes.D#"),
    Stage("limits", "_limit#"),
    Stage("centre", "rocker_sizes.C"),
    Stage("pressure", "gamma_rise_min"),
)
ROLLER_PROFILE = (
    Stage("shaft", "profile.O"),
    Stage("circles", "_axis#"),
    Stage("lines", "profile.E#"),
    Stage("pitch", "profile.B#"),
    Stage("normal", "profile.P#"),
    Stage("profile", "profile.K#"),
    Stage(SHARPEST, "rho_min"),
    Stage("follower"),
)
ROCKER_PROFILE = (
    Stage("shaft", "profile.O"),
    Stage("pivots", "profile.A#"),
    Stage("pitch", "profile.B#"),
    Stage("normal", "profile.D#"),
    Stage("profile", "profile.K#"),
    Stage(SHARPEST, "rho_min"),
    Stage("follower"),
)
PLATE_PROFILE = (
    Stage("shaft", "plate_profile.O"),
    Stage("circles", "_axis#"),
    Stage("centres", "plate_profile.B#"),
    Stage("profile", "plate_profile.K#"),
    Stage("follower"),
)
PRESSURE = (Stage("axes", "gamma_rise_min"), Stage("curve"), Stage("limits"))


def tables(solved: SolvedCam) -> dict[str, tuple[Stage, ...]]:
    """Return all stages that the views of a cam may have, by view."""
    found = {"diagrams": DIAGRAMS, SIZES: OF_ROLLER, ROCKER_SIZES: OF_ROCKER, PLATE_SIZES: OF_PLATE}
    found["profile"] = ROCKER_PROFILE if solved.rocker is not None else ROLLER_PROFILE
    return found | {"plate_profile": PLATE_PROFILE, "pressure": PRESSURE}


def stages(solved: SolvedCam) -> dict[str, tuple[str, ...]]:
    """Return the parts of each view that a cam has, in the order in which they are drawn."""
    firsts: Firsts = {}
    for k, step in enumerate(solved.program):
        for verb in ("", step.verb):
            firsts.setdefault((family(step.name), verb), k)
    blunt = () if _is_sharp(solved) else (SHARPEST,)
    drawn = {view: table for view, table in tables(solved).items() if (table[0].family, table[0].verb) in firsts}
    return {view: tuple(_ordered(table, firsts, blunt)) for view, table in drawn.items()}


def family(name: str) -> str:
    """Return the name of a step with `#` for its numbers; a quantity keeps its own.

    >>> family("profile.E12"), family("r_0")
    ('profile.E#', 'r_0')
    """
    return NUMBER.sub("#", name) if "." in name or name[0] == "_" else name


def _ordered(table: tuple[Stage, ...], firsts: Firsts, left_out: tuple[str, ...]) -> Iterator[str]:
    first, *others = table
    yield first.part
    starts = ((stage.part, firsts.get((stage.family, stage.verb))) for stage in others if stage.family)
    begun = {part: start for part, start in starts if start is not None and part not in left_out}
    yield from sorted(begun, key=lambda part: begun[part])
    yield from (stage.part for stage in others if not stage.family)


def _is_sharp(solved: SolvedCam) -> bool:
    """Whether a pitch curve is convex anywhere, so that it has a least radius of curvature."""
    cam = solved.roller or solved.rocker
    return cam is not None and 0.0 < cam.profile.sharpest.value < math.inf
