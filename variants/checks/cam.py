"""Checking a cam: its words, laws of one's own, and whether its numbers have the right names, kinds and bounds."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

from ...plans.cams.cam import (
    AS_RISE,
    CURVES,
    FOLLOWERS,
    LAWS,
    LIMITS,
    NEAR,
    ORDERS,
    PLATE,
    ROCKER,
    ROLLER,
    ROTATIONS,
    SECTIONS,
    VALUES,
    Cam,
    Curve,
)
from ...scales.errors import InputError
from ...scales.numbers import quote
from ...scales.units import unit
from ..task import Bound, Given
from ..toml_places import Path
from .basics import Checker, Field, array_of, one_of, record, rows, word
from .names import Names, Number, check_numbers, literal, word_or_choice

TABLE = "cam"
WORDS = ("law", "law_fall", "fall", "rotation", "limits")  # keys whose value may be the name of a choice
SHORTEST = math.radians(0.01)  # of a phase in which a follower moves
MOST_SECTIONS = 90  # of a phase: finer than a degree nobody divides one
NUMBERS = {
    "h": Number(),
    "psi": Number(Bound.ACUTE),
    "phi_rise": Number(Bound.TURN),
    "phi_upper": Number(Bound.NOT_NEGATIVE, default=0.0),
    "phi_fall": Number(Bound.TURN),
    "omega": Number(),
    "u": Number(Bound.PART, default=0.5),
    "u_fall": Number(Bound.PART, needed=False),
    "l_A1": Number(default=0.1),
    "H_a": Number(default=0.03),
    "H_v": Number(default=0.03),
    "mu_phi": Number(default=math.radians(1e3)),
    "gamma_rise": Number(Bound.ACUTE),
    "gamma_fall": Number(Bound.ACUTE),
    "R_roller": Number(),
    "rho_flat": Number(Bound.NOT_NEGATIVE, default=0.01),
    "margin": Number(Bound.NOT_NEGATIVE, default=0.005),
    "l_rocker": Number(),
    "l_OC": Number(needed=False),  # else the pivot is where the cam is smallest
    "r_0": Number(needed=False),
    "e": Number(Bound.FREE, needed=False),
    "r_0_flat": Number(needed=False),
}
_STRAIGHT, _ROLLING = (ROLLER, PLATE), (ROLLER, ROCKER)
HAD_BY = {  # numbers that not every follower has
    "h": _STRAIGHT,
    "psi": (ROCKER,),
    **dict.fromkeys(("gamma_rise", "gamma_fall", "R_roller"), _ROLLING),
    **dict.fromkeys(("rho_flat", "margin", "r_0_flat"), (PLATE,)),
    **dict.fromkeys(("l_rocker", "l_OC"), (ROCKER,)),
    "e": (ROLLER,),
}


def read_cam(checker: Checker, raw: object, names: Names, givens: Mapping[str, Given]) -> Cam | None:
    """Read `[cam]`, and hold the numbers of the task against those that such a cam needs."""
    before, path = len(checker.faults), (TABLE,)
    curves = _curves(checker, (*path, "curve"), raw["curve"]) if isinstance(raw, dict) and "curve" in raw else ()
    laws = (*LAWS, *(curve.name for curve in curves))
    known = {"law": laws, "law_fall": (AS_RISE, *laws), "fall": ORDERS, "rotation": ROTATIONS, "limits": LIMITS}
    fields = {key: Field(word_or_choice(known[key], givens), required=key == "law") for key in WORDS}
    fields |= {
        "followers": Field(array_of(one_of("follower-unknown", lambda: FOLLOWERS))),
        "sections": Field(_sections, required=False),
        "curve": Field(lambda checker, path, raw: None, required=False),  # read before what names them
    }
    read = record(checker, path, raw, fields)
    followers = tuple(dict.fromkeys(read.get("followers", ())))
    if ROCKER in followers and len(followers) > 1:
        checker.fault((*path, "followers"), InputError("follower-rocker"))
    check_numbers(checker, names, _numbers_for(followers), VALUES, "cam-number-unknown")
    if len(checker.faults) > before:
        return None
    return Cam(**{**read, "followers": followers, "curves": curves})


def _sections(checker: Checker, path: Path, raw: object) -> int | None:
    """Read into how many sections a phase is divided at least."""
    if isinstance(raw, int) and not isinstance(raw, bool) and SECTIONS <= raw <= MOST_SECTIONS:
        return raw
    checker.fault(path, InputError("cam-sections", text=quote(raw), least=SECTIONS, most=MOST_SECTIONS))
    return None


def _curves(checker: Checker, path: Path, raw: object) -> tuple[Curve, ...]:
    """Read the laws of one's own."""
    fields = {
        "name": Field(word),
        "kind": Field(one_of("choice-unknown", lambda: CURVES)),
        "at": Field(array_of(_plain)),
        "values": Field(array_of(_plain)),
    }
    found: dict[str, tuple[Curve, Path]] = {}
    for row_path, row in rows(checker, path, raw):
        read = record(checker, row_path, row, fields)
        if len(read) < len(fields):
            continue
        curve = Curve(**read)
        if curve.name in found or curve.name in (*LAWS, AS_RISE):
            first = found[curve.name][1] if curve.name in found else row_path
            checker.twice((*row_path, "name"), curve.name, (*first, "name"))
            continue
        if len(curve.at) != len(curve.values):
            checker.fault((*row_path, "values"), InputError("type-array", n=len(curve.at)))
            continue
        if (error := _unfit(curve)) is not None:
            checker.fault(row_path, error)
        found[curve.name] = curve, row_path
    return tuple(curve for curve, _ in found.values())


def _plain(checker: Checker, path: Path, raw: object) -> float | None:
    """Read a plain number."""
    setting = literal(checker, path, raw)
    return None if setting is None else setting.value


def _unfit(curve: Curve) -> InputError | None:
    """Return why a law of one's own moves no follower from its lowest place to its highest one."""
    from ...plans.cams.laws_of_motion import law_of_curve  # needs numpy, and few tasks have laws of their own

    try:
        law_of_curve(curve)
    except InputError as error:
        return error
    return None


def _numbers_for(followers: tuple[str, ...]) -> dict[str, Number]:
    """Return the numbers of a cam; those that none of the followers has are of no use, where there are followers."""
    found = dict(NUMBERS)
    for name, number in NUMBERS.items():
        if {*HAD_BY.get(name, FOLLOWERS)}.isdisjoint(followers):
            error = InputError("cam-number-unused", text=name, followers=", ".join(followers)) if followers else None
            found[name] = replace(number, needed=False, unused=error)
    return found


def impossible(values: Mapping[str, float]) -> Iterator[InputError]:
    """Go through what no cam can have among the numbers of a variant: those that a choice sets are bounded, too."""
    for name, number in NUMBERS.items():
        if name in values and not number.bound.admits(values[name]):
            yield InputError(number.bound.value, text=f"{name} = {unit(VALUES[name] or '1').from_si(values[name]):.7g}")
    for name in ("phi_rise", "phi_fall"):
        if 0.0 < values[name] < SHORTEST:
            angles = {"angle": f"{math.degrees(values[name]):.4g}", "least": f"{math.degrees(SHORTEST):g}"}
            yield InputError("cam-phase-short", name=name, **angles)
    turned = sum(values[name] for name in ("phi_rise", "phi_upper", "phi_fall"))
    if turned > 2.0 * math.pi + NEAR:
        yield InputError("cam-phases", angle=f"{math.degrees(turned):.7g}")
    if "r_0" in values and abs(values.get("e", 0.0)) >= values["r_0"]:
        yield InputError("cam-eccentric", e=_mm(values["e"]), r_0=_mm(values["r_0"]))
    if "r_0" in values and values.get("R_roller", 0.0) >= values["r_0"]:
        yield InputError("cam-roller", roller=_mm(values["R_roller"]), r_0=_mm(values["r_0"]))


def _mm(length: float) -> str:
    return f"{length * 1e3:.7g}"
