"""Tasks about disk cams: a table `[cam]` with followers, laws of motion, senses."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, ClassVar, cast

from ...plans.cams import cam as cams
from ...plans.solved import AT_LEAST, AT_MOST, Check
from ...scales.errors import InputError
from ...scales.names import unknown
from ...scales.numbers import quote
from ...scales.scale import Display
from ...scales.units import unit
from ..case import Case, Choices, Kind, Numbers, Plans, Scales
from ..checks.basics import Checker, Field, Path, array_of, one_of, record, rows, trying, word
from ..checks.names import Names, Setting, check_numbers, literal, word_or_choice
from ..task import Given

if TYPE_CHECKING:
    from ...drawing.cams.scene import CamScene
    from ...drawing.view import View
    from ...drawing.words import Words
    from ...plans.cams.solve import SolvedCam
    from ...plans.marking.key import Question

SYMBOLS = ("mu_l", "mu_s_ds", "mu_s_d2s")  # the others follow from the drawn amplitude and the pole distances
PER_MM, MILLI = 1e-3, 1e3
AXES = ("diagram_a", "diagram_v", "diagram_s")  # the plans of the diagrams on one axis of angles
# of numbers that hardly any cam has: by SI unit the end of the key of the message, and the unit in it
UNUSUAL = {
    "": ("part", ""),
    "m": ("length", "mm"),
    "rad": ("angle", "deg"),
    "rad/mm": ("axis", "deg"),
    "rad/s": ("speed", "rad/s"),
    "m/s^2": ("acceleration-most", "m/s^2"),
}
LARGE = {"length": "length-most"}  # of a number that may also be nothing
REDUCED_TO = 6  # decimals of the part of their lengths at which diagrams are drawn
RULES = ("roller_of_radius", "roller_of_curvature", "gamma_rise", "gamma_fall")  # checks that are told when they fail
SHORTEST = math.radians(0.01)  # of a phase in which a follower moves
MOST_SECTIONS = 90  # of a phase: finer than a degree nobody divides one


class _Cams(Kind[cams.Cam, "SolvedCam"]):
    """Disk cams with translating roller and flat-faced followers, or with a rocker."""

    table, plans = "cam", cams.PLANS
    room, symbols, made, givens = "cams", SYMBOLS, cams.Cam, cams.GIVENS
    unasked = ("s_max", "s_close", "v_close")  # the stroke, which is given, and what should be nothing
    display = Display(size="mm", angle="deg")
    segments, limits_add_up = False, True
    form_notes: ClassVar[Mapping[str, str]] = {"": "cam"}  # sizes may be drawn or calculated; the sign of e

    def read(self, checker: Checker, raw: object, names: Names, givens: Mapping[str, Given]) -> cams.Cam | None:
        """Read `[cam]`, and hold the numbers of the task against those that such a cam needs."""
        before, path = len(checker.faults), (self.table,)
        curves = _curves(checker, (*path, "curve"), raw["curve"]) if isinstance(raw, dict) and "curve" in raw else ()
        own = tuple(curve.name for curve in curves)
        words = {key: given.choices for key, given in cams.GIVENS.items() if given.choices}
        words |= {key: (*words[key], *own) for key in ("law", "law_fall")}
        fields = {key: Field(word_or_choice(known, givens), required=key == "law") for key, known in words.items()}
        fields |= {
            "followers": Field(array_of(one_of("follower-unknown", lambda: cams.FOLLOWERS))),
            "sections": Field(_sections, required=False),
            "curve": Field(lambda checker, path, raw: None, required=False),  # read before what names them
        }
        read = record(checker, path, raw, fields)
        followers = tuple(dict.fromkeys(read.get("followers", ())))
        if cams.ROCKER in followers and len(followers) > 1:
            checker.fault((*path, "followers"), InputError("follower-rocker"))
        all_givens, unused = dict(cams.GIVENS), dict[str, InputError]()
        for name, given in cams.GIVENS.items():
            if not followers:  # nothing is known of what is needed
                all_givens[name] = replace(given, needed=False)
            elif given.forms and {*given.forms}.isdisjoint(followers):
                unused[name] = InputError("cam-number-unused", text=name, followers=", ".join(followers))
        check_numbers(checker, names, all_givens, "cam-number-unknown", unused)
        if len(checker.faults) > before:
            return None
        return cams.Cam(**{**read, "followers": followers, "curves": curves})

    def fits(self, checker: Checker, subject: cams.Cam, head: Mapping[str, Any]) -> None:
        """Check that the scale factors are those that may be chosen."""
        known = ", ".join(SYMBOLS)
        for name, text in head.get("scales", {}).items():
            if name in SYMBOLS and "=" in text:
                checker.fault(("scales", name), InputError("scale-no-segments", text=quote(text), known=known))
            elif name not in SYMBOLS and name in self._in("plans", "solve", "UNITS"):  # found with the diagrams
                checker.fault(("scales", name), InputError("scale-follows", symbol=name, known=known))
            elif name not in SYMBOLS:
                checker.fault(("scales", name), unknown("scale-unknown", name, SYMBOLS, task=head.get("id", "")))

    def impossible(self, values: Numbers) -> Iterator[tuple[str, InputError]]:
        """Go through what no cam can have among the numbers of a variant: those that a choice sets are bounded, too."""
        for name, given in cams.GIVENS.items():
            if name in values and not given.bound.admits(values[name]):
                shown = unit(given.unit or "1").from_si(values[name])
                yield "", InputError(given.bound.value, text=f"{name} = {shown:.7g}")
        for name in ("phi_rise", "phi_fall"):
            if 0.0 < values[name] < SHORTEST:
                angles = {"angle": f"{math.degrees(values[name]):.4g}", "least": f"{math.degrees(SHORTEST):g}"}
                yield "", InputError("cam-phase-short", name=name, **angles)
        turned = sum(values[name] for name in ("phi_rise", "phi_upper", "phi_fall"))
        if turned > 2.0 * math.pi + cams.NEAR:
            yield "", InputError("cam-phases", angle=f"{math.degrees(turned):.7g}")
        if "r_0" in values and abs(values.get("e", 0.0)) >= values["r_0"]:
            e, r_0 = (_millimetres(values[name], 7) for name in ("e", "r_0"))
            yield "", InputError("cam-eccentric", e=e, r_0=r_0)
        if "r_0" in values and values.get("R_roller", 0.0) >= values["r_0"]:
            roller, r_0 = (_millimetres(values[name], 7) for name in ("R_roller", "r_0"))
            yield "", InputError("cam-roller", roller=roller, r_0=r_0)

    def solve(self, subject: cams.Cam, values: Numbers, words: Choices, plans: Plans) -> SolvedCam:
        """Solve a cam; numbers that belong to none are refused."""
        solved = super().solve(subject, {**values, "mu_phi": values["mu_phi"] * PER_MM}, words, plans)
        if "R_roller" in values and "r_0" in solved.values:
            for _, error in self.impossible({**values, "r_0": solved.values["r_0"]}):
                raise error
        return solved

    def warnings(self, solved: SolvedCam) -> tuple[InputError, ...]:
        """Tell what is unusual, which rules are broken, and where a profile does not give the motion, or cannot."""
        found: list[InputError] = []
        if cams.PLATE in solved.cam.followers and solved.motion.velocity_jumps:
            found.append(InputError("cam-no-plate"))
        found += _unusual(solved)
        for check in self.checks(solved):
            if check.name in RULES and not check.ok:
                said = _degrees if check.unit == "rad" else _millimetres
                found.append(InputError(f"cam-rule-{check.name}", value=said(check.value), limit=said(check.limit)))
        found += _outside(solved)
        for _, follower, profile in solved.profiles if solved.draws_profiles else ():
            for undercut in profile.undercuts:
                said_ends = {"start": _degrees(undercut.start), "end": _degrees(undercut.end)}
                lost = math.degrees(undercut.lost) if follower == cams.ROCKER else undercut.lost * MILLI
                found.append(InputError(f"cam-undercut-{follower}", lost=f"{lost:.3g}", **said_ends))
        return tuple(found)

    def checks(self, solved: SolvedCam) -> tuple[Check, ...]:
        """Return what the rules of good design say, each with the value that it compares with its limit, SI.

        `roller_of_radius` and `roller_of_curvature` hold the roller against 0.4 r_0 and 0.7 rho_min, `gamma_rise` and
        `gamma_fall` the least transmission angles against the permitted ones; `undercut_...` tells how much travel a
        profile loses, `convex` how sharp the profile under a plate is.
        """
        found: list[Check] = [*self._in("plans", "solve", "rules_of")(solved)]
        for _, follower, profile in solved.profiles if solved.draws_profiles else ():
            lost = max((undercut.lost for undercut in profile.undercuts), default=0.0)
            ok, of_travel = not profile.undercuts, "rad" if follower == cams.ROCKER else "m"
            name = f"undercut_{follower}"
            found.append(Check(name=name, ok=ok, value=lost, unit=of_travel, limit=0.0, relation=AT_MOST))
        if solved.plate is not None and solved.draws_profiles:
            found.append(Check.of_value("convex", float(solved.plate.profile.rho_min), AT_LEAST, 0.0, "m"))
        return tuple(found)

    def as_drawn(self, solved: SolvedCam) -> tuple[SolvedCam, Mapping[str, str]]:
        """Return the cam with chords and tangents in the place of closed forms."""
        from ...plans.cams.solve import as_drawn, stands_for

        return as_drawn(solved), stands_for(solved)

    def listed(self, solved: SolvedCam, plans: tuple[str, ...]) -> tuple[str, ...]:
        """Return what belongs to the plans, section by section, the chosen scale factors among it."""
        chosen = (symbol for symbol in SYMBOLS if symbol in solved.scale_of_plan.values())
        return cast("tuple[str, ...]", self._in("plans", "solve", "listed")((*chosen, *solved.quantities), plans))

    def _headed(self, solved: SolvedCam, section: str) -> str:
        named = {"profile": "profiles"} | ({"roller": "rocker"} if solved.rocker is not None else {})
        return named.get(section, section)

    def section(self, solved: SolvedCam, question: Question, current: str) -> str:
        """Return the section of a question: the three diagrams are one drawing."""
        return cams.DIAGRAMS_PART if question.plan in AXES else question.plan

    def plan_heading(self, solved: SolvedCam, plan: str, words: Words) -> str:
        """Return the heading of a plan, as the sheet has it."""
        if plan == cams.PROFILE_PART and solved.rocker is not None:
            return words["heading.cam_rocker_profile"]
        return super().plan_heading(solved, cams.DIAGRAMS_PART if plan in AXES else plan, words)

    def drawn_lengths(self, solved: SolvedCam) -> dict[str, str]:
        """Return with what lengths its diagrams are drawn."""
        from ...plans.cams.solve import REDUCED

        said = {name: _millimetres(solved.givens[name]) for name in REDUCED if name != "mu_phi"}
        return said | {"angle": _degrees(solved.givens["mu_phi"])}

    def scene(self, case: Case, scales: Scales, words: Words) -> CamScene:
        """Return the cam with its letters, with the lengths that it has on the sheet."""
        from ...drawing.cams.scene import CamScene
        from ...drawing.formats import STYLES
        from ...plans.cams.construction import TRAVEL
        from ...plans.cams.solve import SolvedCam, reduced

        solved = SolvedCam.of(case.solved)
        part = round(float(solved.values["mu_s"]) / scales[TRAVEL].mu, REDUCED_TO)
        mus = {scale.symbol: scale.mu for scale in scales.values() if scale.symbol in SYMBOLS}
        return CamScene(reduced(solved, part), self.lettered(words, solved), STYLES["A4"], case.givens, mus, part)

    def sought(self, solved: SolvedCam, words: Words, name: str) -> str:
        """Return what a quantity is; a larger cam than the smallest has many offsets, and none is asked for."""
        return "" if name == "e" and "r_0" in solved.givens else super().sought(solved, words, name)

    def pictured(self, case: Case, words: Words, part: float = 1.0) -> View:
        """Draw the law of motion."""
        from ...drawing.cams.diagrams_view import law_view

        scales = self.first_scales(cast("SolvedCam", case.solved), case.choosers, case.plans)[1]
        return law_view(self.scene(case, scales, words), part)


KIND = _Cams()


def _outside(solved: SolvedCam) -> Iterator[InputError]:
    """Tell which r_0 the limits permit, where one is given together with e or l_OC that they do not."""
    from ...plans.cams.sizes import ROUNDING, six_digits

    cam = solved.rolling
    if cam is None or cam.permitted is None:
        return
    (least, most), r_0 = cam.permitted, cam.sizes.r_0
    if least * (1.0 - ROUNDING) <= r_0 <= most * (1.0 + ROUNDING):
        return
    if solved.rocker is None:
        yield InputError("cam-r-0-at-e", e=_millimetres(solved.givens["e"]), least=six_digits(least))
    else:
        ends = {"least": six_digits(least), "most": six_digits(most, greatest=True)}
        yield InputError("cam-r-0-at-l-OC", l_OC=_millimetres(solved.givens["l_OC"]), **ends)


def _unusual(solved: SolvedCam) -> Iterator[InputError]:
    """Go through the numbers that hardly any cam has, each in the unit in which people read it."""
    from ...plans.cams.solve import unit_of, unusual

    for name, *numbers in unusual(solved):
        key, shown = UNUSUAL[unit_of(name)]
        size = unit(shown) if shown else None
        value, least, most = (f"{x if size is None else size.from_si(x):.4g}" for x in numbers)
        end = LARGE.get(key, key) if numbers[1] == 0.0 else key
        yield InputError(f"cam-unusual-{end}", name=name, value=value, least=least, most=most)


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.4g}"


def _millimetres(length: float, digits: int = 4) -> str:
    return f"{length * MILLI:.{digits}g}"


@trying
def _sections(raw: object) -> int:
    """Read into how many sections a phase is divided at least."""
    if isinstance(raw, int) and not isinstance(raw, bool) and cams.SECTIONS <= raw <= MOST_SECTIONS:
        return raw
    raise InputError("cam-sections", text=quote(raw), least=cams.SECTIONS, most=MOST_SECTIONS)


def _curves(checker: Checker, path: Path, raw: object) -> tuple[cams.Curve, ...]:
    """Read the laws of one's own."""
    fields = {
        "name": Field(word),
        "kind": Field(one_of("choice-unknown", lambda: cams.CURVES)),
        "at": Field(array_of(_plain)),
        "values": Field(array_of(_plain)),
    }
    found: dict[str, tuple[cams.Curve, Path]] = {}
    for row_path, row in rows(checker, path, raw):
        read = record(checker, row_path, row, fields)
        if len(read) < len(fields):
            continue
        curve = cams.Curve(**read)
        if curve.name in found or curve.name in (*cams.LAWS, cams.AS_RISE):
            first = found[curve.name][1] if curve.name in found else row_path
            checker.twice((*row_path, "name"), curve.name, (*first, "name"))
            continue
        if len(curve.at) != len(curve.values):
            checker.fault((*row_path, "values"), InputError("type-array", n=len(curve.at)))
            continue
        from ...plans.cams.laws_of_motion import law_of_curve  # needs numpy, and few tasks have laws of their own

        with checker.at(row_path):
            law_of_curve(curve)
        found[curve.name] = curve, row_path
    return tuple(curve for curve, _ in found.values())


def _plain(checker: Checker, path: Path, raw: object) -> float | None:
    """Read a plain number."""
    setting: Setting | None = literal(checker, path, raw)
    return None if setting is None else setting.value
