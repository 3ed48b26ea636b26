"""A cam solved: motion, sizes, construction, values and quantities together."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from ..board import Program
from ..boards.exact import run
from ..quantities import quantities, shown_on
from ..solved import Solved
from .cam import PLANS, PLATE, ROLLER, Cam
from .construction import Layout, construct, with_needs
from .givens import diagram_givens, limit_givens, profile_givens
from .integration import ACCELERATION, DIAGRAMS, TRAVEL, VELOCITY
from .inversion import PLATE_PROFILE, PROFILE
from .motion import FALL, RISE, Array, Motion, motion_of
from .pressure import least_transmission
from .profile import PlateProfile, RollerProfile, StraightPath
from .size_plans import PLATE_SIZES, SIZES, phase_of
from .sizes import BACK, Limits, PlateSizes, RollerSizes, apex, smallest_plate, smallest_roller, wedge

# the scale factor in which each plan shows values; on the diagrams that of the axis of ordinates
SCALES = {
    ACCELERATION: "mu_d2s",
    VELOCITY: "mu_ds",
    TRAVEL: "mu_s",
    SIZES: "mu_s",
    PLATE_SIZES: "mu_d2s",
    PROFILE: "mu_l",
    PLATE_PROFILE: "mu_l",
}
# the plan that shows a quantity as a segment, beside those that are read from one
SHOWN_ON = {
    "A_1": ACCELERATION,
    "A_2": ACCELERATION,
    "ds_max": VELOCITY,
    "s_max": TRAVEL,
    **dict.fromkeys(("r_0", "e", "s_0", "r_0_tangents", "e_tangents"), SIZES),
    **dict.fromkeys(("r_0_flat_min", "r_0_flat_tangent"), PLATE_SIZES),
    **dict.fromkeys(("rho_min", "R_roller"), PROFILE),
    **dict.fromkeys(("r_0_flat", "R_plate"), PLATE_PROFILE),
}
PAPER = 1e-3  # metres of paper in a millimetre: the diagrams are drawn in these
UNITS = {
    "v_max": "m/s",
    "a_max": "m/s^2",
    "mu_v": "(m/s)/mm",
    "mu_a": "(m/s^2)/mm",
    "mu_s": "m/mm",
    "mu_ds": "m/mm",
    "mu_d2s": "m/mm",
    "nu": "rad",
    "nu_a": "rad",
    "gamma_rise_min": "rad",
    "gamma_fall_min": "rad",
}


def unit_of(name: str) -> str:
    """Return the SI unit of a cam's quantity by its name; analogues have that of the travel."""
    return UNITS.get(name.removesuffix("_chord"), "m")


@dataclass(frozen=True, slots=True, kw_only=True)
class RollerCam:
    """The smallest cam for a roller, the cam whose centre is where the limit tangents meet, and the profile."""

    limits: Limits
    sizes: RollerSizes
    by_tangents: RollerSizes
    profile: RollerProfile


@dataclass(frozen=True, slots=True, kw_only=True)
class PlateCam:
    """The smallest cam for a plate, and its profile."""

    sizes: PlateSizes
    profile: PlateProfile


@dataclass(frozen=True, slots=True, kw_only=True)
class SolvedCam(Solved):
    """A cam solved; `angles` are those of the section lines, rad."""

    cam: Cam
    motion: Motion
    angles: Array
    layout: Layout
    roller: RollerCam | None
    plate: PlateCam | None

    def worth(self, mus: Mapping[str, float]) -> dict[str, float]:
        """Return what a millimetre of every plan is worth to the board: the diagrams are drawn in paper itself."""
        return {plan: PAPER if plan in DIAGRAMS else mu for plan, mu in mus.items()}


def solve_cam(cam: Cam, values: Mapping[str, float], plans: Iterable[str] = PLANS) -> SolvedCam:
    """Solve a cam.

    Parameters
    ----------
    cam : Cam
        Followers, laws, senses, all chosen.
    values : mapping of str to float
        Its numbers in SI by name.
    plans : iterable of str
        Plans wanted, of `cam.PLANS`; those they need are built too, no others.

    Raises
    ------
    InputError
        A law that cannot be had with these numbers.
    """
    motion = motion_of(cam, values)
    angles, division = motion.division(cam.sections)
    given = VELOCITY if any(jump.order == 1 for jump in motion.jumps) else ACCELERATION
    wanted = with_needs(plans)
    sized = PLANS[1] in wanted
    roller = _roller(cam, motion, values) if ROLLER in cam.followers and sized else None
    plate = _plate(cam, motion, values) if PLATE in cam.followers and sized and given == ACCELERATION else None
    made = [name for name, found in ((ROLLER, roller), (PLATE, plate)) if found is not None]
    fastest = int(abs(angles - motion.ds_max.phi).argmin())
    layout = Layout(division, tuple(made), given, fastest, _limits(cam), roller.by_tangents.on if roller else ())
    program = construct(layout, wanted)
    givens = {
        **values,
        **diagram_givens(motion, angles, division, given),
        **profile_givens(motion, angles, division, cam.sense),
        **_size_givens(cam, motion, values, roller, plate),
    }
    board = run(program, givens)
    return SolvedCam(
        program=program,
        values=board.values,
        quantities=quantities(program, board.values, _lengths(values), unit_of),
        sines=board.sines,
        status=board.status,
        trouble=board.trouble,
        shown_on=_shown_on(program),
        scale_of_plan={plan: SCALES[plan] for plan in program.plans if plan in SCALES},
        givens=givens,
        cam=cam,
        motion=motion,
        angles=angles,
        layout=layout,
        roller=roller,
        plate=plate,
    )


def _shown_on(program: Program) -> dict[str, str]:
    drawn = {*program.plans}
    return shown_on(program) | {name: plan for name, plan in SHOWN_ON.items() if plan in drawn}


def _limits(cam: Cam) -> tuple[str, ...]:
    sides = (RISE, FALL)
    return (*sides, *(phase + BACK for phase in sides)) if cam.two_sided else sides


def _roller(cam: Cam, motion: Motion, values: Mapping[str, float]) -> RollerCam:
    limits = Limits(values["gamma_rise"], values["gamma_fall"], cam.two_sided)
    planes = wedge(motion, limits, cam.sense)
    sizes = smallest_roller(planes)
    profile = RollerProfile(StraightPath(motion, sizes), values["R_roller"], cam.sense)
    return RollerCam(limits=limits, sizes=sizes, by_tangents=apex(planes), profile=profile)


def _plate(cam: Cam, motion: Motion, values: Mapping[str, float]) -> PlateCam:
    sizes = smallest_plate(motion, values["rho_flat"], values["margin"])
    return PlateCam(sizes=sizes, profile=PlateProfile(motion, sizes.r_0, cam.sense))


def _size_givens(
    cam: Cam, motion: Motion, values: Mapping[str, float], roller: RollerCam | None, plate: PlateCam | None
) -> dict[str, float]:
    """Return the sizes as parts of the stroke, to which they are proportional, and the limits' tangents."""
    found: dict[str, float] = {}
    if roller is not None:
        gammas = {RISE: roller.limits.gamma_rise, FALL: roller.limits.gamma_fall}
        found |= limit_givens({limit: gammas[phase_of(limit)] for limit in _limits(cam)}, cam.sense)
        parts = {"e": roller.sizes.e, "s_0": roller.sizes.s_0, "rho": roller.profile.rho_min}
        found |= {f"_{name}_part": size / motion.h for name, size in parts.items()}
        for phase in (RISE, FALL):
            least = least_transmission(motion, roller.sizes, phase, cam.sense, cam.two_sided)
            found[f"_gamma_{phase}_least"] = least.value
    if plate is not None:
        found["_r_0_flat_part"] = plate.sizes.r_0_min / motion.h
    return found


def _lengths(values: Mapping[str, Any]) -> dict[str, float]:
    """Return the given lengths that are results, too."""
    return {name: values[name] for name in ("H_a", "H_v", "R_roller") if name in values}
