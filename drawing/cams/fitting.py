"""The views of a cam's sheet for a format: in the order of the work, at scale factors for which they have room."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from ...plans.cams.cam import DIAGRAMS, PRESSURE, PROFILE, SIZES
from ...plans.cams.solve import SolvedCam
from ...scales.choose import Choosers, Fixed
from ...scales.scale import Scale
from ..compose import room
from ..formats import Format
from ..givens import Given, givens_view
from ..pens import Norm
from ..style import STYLES
from ..view import View
from ..words import Words
from .letters import lettered
from .scene import CamScene

TEXT_WIDTH = {"A1": 200.0, "A2": 175.0, "A3": 150.0, "A4": 175.0}
REDUCTIONS = (1.0, 0.8, 0.5, 0.4, 0.25, 0.2, 0.1)  # of the diagrams, whose scale factors grow as much
COARSER = (1.0, 2.0, 2.5, 4.0, 5.0, 10.0)  # scale factors of the S-ds/dphi diagram, in those of the travel
NARROW = 0.65  # part of the width of lines that those on the sizes of a cam may have
MU_L = 0.001  # m/mm, M 1:1, where nothing is said


@dataclass(frozen=True, slots=True)
class Contents:
    """What a sheet shows: a cam solved, the plans wanted, choosers of scales, givens, words, norm."""

    solved: SolvedCam
    plans: tuple[str, ...]
    choosers: Choosers
    givens: Mapping[str, Given]
    words: Words
    norm: Norm = "gost"


@dataclass(frozen=True, slots=True)
class Rungs:
    """How small things are drawn: the diagrams, the S-ds/dphi diagram beside them, the profiles."""

    reduction: float
    coarser: float
    mu_l: float


def mu_ladder(contents: Contents) -> tuple[float, ...]:
    """Return the scale factors of the profiles, the one wanted first."""
    chosen = contents.choosers.get("mu_l", Fixed(MU_L))
    sizes = [part.sizes.r_0 for part in (contents.solved.roller, contents.solved.plate) if part is not None]
    across = 2.0 * (max(sizes, default=0.1) + contents.solved.motion.h)
    return chosen.ladder(lambda _: across)


def scene_of(contents: Contents, sheet: Format, rungs: Rungs) -> CamScene:
    """Return the scene of a sheet on a format."""
    style, words = STYLES[sheet.letters], lettered(contents.words)
    return CamScene(contents.solved, words, style, contents.givens, rungs.reduction, rungs.coarser, rungs.mu_l)


def views(contents: Contents, sheet: Format, rungs: Rungs) -> list[View]:
    """Return the views of a sheet in the order of the work."""
    scene = scene_of(contents, sheet, rungs)
    width = min(TEXT_WIDTH[sheet.letters], room(sheet, contents.norm)[0])
    return [view for plan in contents.plans for view in _views(scene, plan, width)]


def _views(scene: CamScene, plan: str, width: float) -> Iterator[View]:
    """Go through the views of a plan; a view is imported when it is drawn."""
    solved = scene.solved
    if plan == DIAGRAMS:
        from .diagrams_view import diagrams_view
        from .tables import motion_table
        from .text import choices_block, scales_block

        numbers = {name: given for name, given in scene.givens.items() if not isinstance(given.value, str)}
        yield givens_view(numbers, scene.words, scene.style)
        if len(numbers) < len(scene.givens):
            yield choices_block(scene, NARROW * width)
        yield diagrams_view(scene)
        yield scales_block(scene, width)
        yield motion_table(scene)
    elif plan == SIZES:
        from .plate_sizes_view import plate_sizes_view
        from .sizes_view import sizes_view
        from .text import plate_block, roller_block

        if solved.roller is not None:
            yield sizes_view(scene)
            yield roller_block(scene, NARROW * width)
        if solved.plate is not None:
            yield plate_sizes_view(scene)
            yield plate_block(scene, width)
    elif plan == PROFILE:
        from .plate_view import plate_view
        from .roller_view import roller_view

        if solved.roller is not None:
            yield roller_view(scene)
        if solved.plate is not None:
            yield plate_view(scene)
    elif plan == PRESSURE and solved.roller is not None:
        from .pressure_view import pressure_view

        yield pressure_view(scene)


def scales(contents: Contents, scene: CamScene) -> dict[str, Scale]:
    """Return the scale factors of the plans as they are drawn."""
    return {plan: scene.scale(plan) for plan in contents.solved.scale_of_plan}
