"""In which part of a cam's note a quantity stands, and which parts belong to the plans that are wanted."""

from __future__ import annotations

from collections.abc import Iterable

from .cam import DIAGRAMS_PART, PRESSURE_PART, PROFILE_PART, SIZES_PART

DIAGRAMS, CHORDS, ROLLER, PLATE, PROFILE = SECTIONS = ("diagrams", "chords", "roller", "plate", "profile")
PRESSURES = ("gamma_rise_min", "gamma_fall_min")  # also what the plan of pressure angles shows
NAMES = {
    CHORDS: ("s_close", "v_close"),
    ROLLER: (
        "mu_s_ds",
        "r_0",
        "e",
        "s_0",
        "e_least",
        "e_most",
        "r_0_tangents",
        "e_tangents",
        "l_rocker",
        "l_OC",
        "psi_0",
        *PRESSURES,
    ),
    PLATE: ("mu_s_d2s", "r_0_flat_tangent", "r_0_flat_min", "r_0_flat", "rho_flat_min", "R_plate"),
    PROFILE: ("mu_l", "R_roller", "rho_min"),
}
OF_PLAN = {DIAGRAMS_PART: (DIAGRAMS, CHORDS), SIZES_PART: (ROLLER, PLATE), PROFILE_PART: (PROFILE,), PRESSURE_PART: ()}
BY_CHORDS = ("mu_s", "mu_ds", "mu_d2s", "mu_v", "mu_a", "S_max", "V_max", "ds_max", "nu", "nu_a")
EXACT_OF = {f"{name}_chord": name for name in BY_CHORDS}  # what is found from curves of chords, and what it stands for
_SECTION = {name: section for section, names in NAMES.items() for name in names}


def section_of(name: str) -> str:
    """Return the section of a quantity or a scale factor: what belongs to nothing else belongs to the diagrams."""
    return _SECTION.get(name, CHORDS if name in EXACT_OF else DIAGRAMS)


def listed(names: Iterable[str], plans: Iterable[str]) -> tuple[str, ...]:
    """Return those of the names that belong to the plans wanted, not only to what these need, section by section."""
    wanted = [*plans]
    sections = {section for plan in wanted for section in OF_PLAN[plan]}
    kept = [name for name in names if section_of(name) in sections or (PRESSURE_PART in wanted and name in PRESSURES)]
    return tuple(sorted(kept, key=lambda name: SECTIONS.index(section_of(name))))
