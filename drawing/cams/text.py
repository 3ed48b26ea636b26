"""What is written of a cam: calculations with their numbers, the table of its motion, and the work step by step.

Scale factors, sizes and rules of design stand beside the drawing. An explanatory note numbers the steps, and concludes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ...plans.cams import course
from ...plans.cams.cam import PLATE, VALUES
from ...plans.cams.construction import ACCELERATION, CHORD_OF, EXACT, FACTORS, PLATE_SIZES, ROCKER_SIZES, SIZES
from ...plans.cams.envelopes import Envelope
from ...plans.cams.solve import SCALES, rules_of, unit_of
from ...scales.scale import Scale
from ..handouts import Shown as Begun
from ..notes.blocks import Story
from ..printed import DEGREES, Input, Shown, calculation, read_off, ruler_decimals, worked
from ..symbols import swept
from ..tables import givens_view, table, text_block, words_of
from ..view import View
from .inversion import undercut_notes
from .scene import MU_DIGITS, CamScene, is_aside

Lines = list[tuple[str, ...]]
# the views in the order of the work, in which a note tells them
WORK: tuple[str, ...] = (
    "givens",
    "choices",
    "diagrams",
    "equations_scales",
    "sizes",
    "rocker_sizes",
    "equations_roller",
)
WORK += ("equations_rocker", "pressure", "profile", "rocker_profile", "plate_sizes", "equations_plate", "plate_profile")
TIMES = {"m": 1e3, "rad": DEGREES}  # by SI unit, of lengths and angles as they are printed
LETTERED = {exact: name for name, exact in EXACT.items()}
FROM = {SIZES: ("mu_s", "mu_ds"), PLATE_SIZES: ("mu_s", "mu_d2s")}  # scale factors of the diagrams
DRAWN = {"mu_s": "s", "mu_ds": "ds", "mu_d2s": "d2s"}  # what they draw
ON_PAPER = ("l_A1", "H_a", "H_v", "S_max", "S_max_chord")
FOUND = ("r_0", "e", "u", "mu_phi")  # printed with as many digits as a calculation needs, though they may be given
DECIMALS = 4
PAPER = 2  # decimals of segments on paper
Said = dict[str, str]
Texts = Mapping[str, str]
SAME = 1e-9  # part of the greatest value of its column within which two limits at a jump are one


def scales_block(scene: CamScene, width: float) -> View:
    """Return the calculation of amplitudes, scale factors and greatest rates, and by how much chords do not close."""
    words, values, motion = scene.words, scene.solved.values, scene.solved.motion
    lines = [_worked(scene, name) for name in ("l_A2", *DRAWN, "mu_v", "mu_a") if name in values]
    lines.append((f"{words['said.cam_by_chords']}:",))
    lines += [_worked(scene, CHORD_OF[name]) for name in DRAWN if name in values]
    gaps = (_closing(scene, name) for name in ("s_close", "v_close") if name in values)
    lines.append((words["said.cam_closing"].format(values=", ".join(gaps)),))
    rates = ("v_max", "mu_v", "ds_max", motion.ds_max), ("a_max", "mu_a", "d2s_max", motion.d2s_max)
    for name, mu, of, rate in rates:
        if name in values:
            lines.append(_worked(scene, name, FACTORS[mu][0], "omega", Input(rate.value, name=of)))
    return text_block("equations_scales", words["heading.scales"], lines, scene.style, width)


def _worked(scene: CamScene, name: str, law: str = "", *operands: str | Input) -> tuple[str, ...]:
    """Return how a quantity is calculated, in letters and in numbers: by its step, or by another law.

    Lengths go into lengths in millimetres, angles in degrees.
    """
    step, unit, inputs = scene.solved.program.by_name[name], unit_of(name), list[Input]()
    for operand in operands or step.operands:
        if isinstance(operand, str):
            called = LETTERED.get(operand, operand)
            times = TIMES.get(unit_of(operand), 1.0) if unit in TIMES else 1.0
            on_paper, exact = called in ON_PAPER, operand in scene.solved.givens and operand not in FOUND
            value = scene.paper(operand) if on_paper else abs(scene.value_of(operand)) * times
            operand = Input(value, exact, name=called, times=1e3 if on_paper else times)
        inputs.append(operand)
    shown = {"m": Shown("mm", 1e3), "rad": Shown("deg", DEGREES)}.get(unit, Shown(unit))
    return worked(scene.words, name, law or step.law, inputs, shown)


def choices_block(scene: CamScene, width: float) -> View:
    """Return the choices that the task makes in words, and what the lines of the diagrams are."""
    words, mm, lines = scene.words, scene.words.unit("mm"), Lines()
    for name, given in scene.givens.items():
        if isinstance(given.value, str):
            about, said = words.choice(name, given.value)
            lines.append((f"{words.texts.get(f'given.cam_{name}', about)}:", said))
    lines.append(tuple(words["said.cam_curves"].split("|")))
    if (lower := scene.solved.motion.lower).lasts:
        lines.append((words["said.cam_lower"].format(angle=scene.angle("phi_lower", lower.length)),))
    if scene.reduction != 1.0:  # with what lengths they are drawn instead of those given
        lengths = ((name, words.short(round(scene.paper(name), 2))) for name in ("l_A1", "H_a", "H_v"))
        drawn = (f"{scene.symbol(name)} = {length} {mm};" for name, length in lengths)
        part = words["said.cam_smaller"].format(part=words.short(scene.reduction))
        lines.append((*words_of(part), *drawn, scene.axis))
    return text_block("choices", words["heading.cam_choices"], lines, scene.style, width)


def _roller_lines(scene: CamScene) -> Lines:
    """Return the sizes of the cam for a roller, with the rules for its radius and the transmission angles."""
    lines = [_worked(scene, "r_0", "hypotenuse", "e", "s_0"), *_tangents(scene, "r_0_tangents", "e_tangents")]
    lines += [(line,) for line in _offsets_line(scene)]
    return [*lines, *_rules(scene)]


def _plate_lines(scene: CamScene) -> Lines:
    """Return the sizes of the cam for a plate."""
    words, lines = scene.words, _tangents(scene, "r_0_flat_tangent")
    if scene.plate.given:
        rho = words.short(scene.value_of("rho_flat") * 1e3)
        more = f"≥ {scene.symbol('rho_flat')} = {rho} {words.unit('mm')}"
        lines.append((*_worked(scene, "rho_flat_min"), more))
    else:
        lines.append(_worked(scene, "r_0_flat"))
    return [*lines, _worked(scene, "R_plate")]


def _rocker_lines(scene: CamScene) -> Lines:
    """Return the sizes of the cam for a rocker, with the rules for its roller and the transmission angles."""
    arc, angle = ((f"{scene.words[f'said.cam_{name}']}:",) for name in ("arc", "first_angle"))
    return [arc, _worked(scene, "h"), angle, _worked(scene, "psi_0"), *_rules(scene)]


def sizes_block(scene: CamScene, follower: str, width: float) -> View:
    """Return how the sizes of the cam for a follower are calculated."""
    lines = {"roller": _roller_lines, "rocker": _rocker_lines, "plate": _plate_lines}[follower](scene)
    return text_block(f"equations_{follower}", scene.words[f"heading.cam_{follower}"], lines, scene.style, width)


def _tangents(scene: CamScene, *names: str) -> Lines:
    """Return the sizes that tangents to the curves of chords give."""
    texts = (f"{text} {scene.words.unit('mm')}" for text in scene.lettered(*names))
    return [(f"{scene.words['said.cam_tangents']}:", "; ".join(texts))]


def _rules(scene: CamScene) -> Lines:
    """Return the rules of good design, each with its numbers and whether it is kept."""
    words, mm, lines = scene.words, scene.words.unit("mm"), Lines()
    for rule in rules_of(scene.solved):
        if rule.of:  # the roller's radius beside the greatest one, a part of a size
            factors = [Input(rule.part, True), Input(rule.size * 1e3)]
            (part, size), limit = calculation(words, lambda a, b: a * b, factors)
            roller = f"{scene.symbol('R_roller')} = {words.short(round(rule.value * 1e3, 6))} {mm}"
            text = f"{roller} ≤ {words.short(rule.part)}·{scene.symbol(rule.of)} = {part}·{size} = {limit} {mm}"
        else:
            text = f"{scene.angle(f'{rule.name}_min', rule.value)} ≥ {scene.angle(rule.name, rule.limit)}"
        lines.append((text, f"({words['said.ok' if rule.ok else 'said.fails']})"))
    return lines


def _offsets_line(scene: CamScene) -> list[str]:
    """Return the offsets permitted at a given r_0, and the one chosen."""
    roller = scene.solved.roller
    if roller is None or roller.offsets is None:
        return []
    (low, high), e, mm = roller.offsets, roller.sizes.e, scene.words.unit("mm")
    least, chosen, most = (f"{text} {mm}" for text in scene.lettered("e_least", "e", "e_most"))
    if e < low:
        return [f"{chosen} < {least}"]
    return [f"{chosen} > {most}" if e > high else f"{least} ≤ {chosen} ≤ {most}"]


def transfer(scene: CamScene, plan: str) -> tuple[str, ...]:
    """Return by how much the ordinates of both diagrams are multiplied, and the angle of the projecting line."""
    words = scene.words
    ratios = [f"{scene.symbol(DRAWN[mu])}: {_ratio(scene, mu, SCALES[plan])}" for mu in FROM[plan]]
    lines = [words["said.cam_equal"], ";  ".join(ratios)]
    if plan == SIZES:  # of the straight line that projects one diagram to the scale of the other
        _, over, under = FACTORS["nu"]
        angle = scene.degrees(swept(1.0 + 0j, complex(scene.mu(under), scene.mu(over))))
        tan, nu = scene.symbol("tan"), scene.symbol("nu")
        lines.append(f"{tan} {nu} = {_ratio(scene, over, under)};  {nu} = {angle}")
    return tuple(lines)


def _ratio(scene: CamScene, over: str, under: str) -> str:
    """Return the ratio of two scale factors in letters and its value."""
    ratio = scene.words.short(round(scene.mu(over) / scene.mu(under), DECIMALS))
    return f"{scene.symbol(over)}/{scene.symbol(under)} = {ratio}"


def data_table(scene: CamScene, stated: bool = False) -> View:
    """Return the numbers that are given, in the task's own units; where `stated`, with what they are called."""
    numbers = {name: given for name, given in scene.givens.items() if not isinstance(given.value, str)}
    called = {name: scene.words[f"called.cam.{name}"] for name in numbers} if stated else None
    return givens_view(numbers, scene.words, scene.style, called=called)


def motion_table(scene: CamScene) -> View:
    """Return travel, analogues and pressure angle by section lines; at a jump the limits before and after it."""
    solved, words = scene.solved, scene.words
    names, sides = ["s", "ds", "d2s"], [[x * 1e3 for x in solved.motion.at(solved.angles, side)] for side in (-1, 1)]
    if solved.rolling is not None:
        names.append("theta")
        for side, values in zip((-1, 1), sides, strict=True):
            values.append(solved.rolling.profile.pressure(solved.angles, side) * DEGREES)
    columns = [[words.number(float(phi) * DEGREES, 2) for phi in solved.angles]]
    columns += [_column(scene, limits) for limits in zip(*sides, strict=True)]
    units = {"theta": "°"}
    head = [words["table.cam_row"], f"{scene.symbol('phi')}, °"]
    head += [f"{scene.symbol(name)}, {units.get(name, words.unit('mm'))}" for name in names]
    rows = [[str(i), *cells] for i, cells in enumerate(zip(*columns, strict=True))]
    return table("motion", words["heading.cam_table"], [head, *rows], scene.style)


def _column(scene: CamScene, limits: Sequence[Any]) -> list[str]:
    """Return the cells of a column, two numbers where the limits from both sides differ."""
    before, after = (side.tolist() for side in limits)
    least = SAME * max(map(abs, (*before, *after)))
    pairs = ((a,) if abs(b - a) <= least else (a, b) for a, b in zip(before, after, strict=True))
    return [" / ".join(scene.words.number(value, 2) for value in values) for values in pairs]


# The work as a note tells it.


def story(scene: CamScene, scales: Mapping[str, Scale], texts: Texts) -> Story:
    """Return what the note of a cam says beside its views, and what their stages are told with: lengths as drawn.

    The sentences of `texts` are by key.
    """
    followers = scene.solved.cam.followers
    named = texts["cam.and"].join(texts[f"cam.for.{follower}"] for follower in followers)
    aim = texts["cam.aims" if len(followers) > 1 else "cam.aim"].format(followers=named)
    head = (data_table(scene, stated=True),)
    said = _said(scene, texts)
    concluded = tuple(_conclusions(scene, texts))
    return Story(conclusions=concluded, texts=texts, said=said, first=WORK, head=head, aims=(aim,))


def begun(scene: CamScene, steps: int) -> dict[str, Begun]:
    """Return what handouts show of the table: section lines, and their angles from the first step on."""
    return {"motion": Begun(columns=2 if steps else 1)}


def _said(scene: CamScene, texts: Texts) -> Said:
    """Return what sentences may name: quantities with letters and units, lengths on paper and as they are read."""
    solved, words = scene.solved, scene.words
    sizes = {name: float(solved.values[name]) for name in (*VALUES, *solved.quantities) if name in solved.values}
    said = {name: scene.stated(name, size) for name, size in sizes.items() if unit_of(name) == "m"}
    said |= {name: scene.angle(name, size) for name, size in sizes.items() if unit_of(name) == "rad"}
    said |= _of_diagrams(scene, texts)
    for plan in {SIZES, PLATE_SIZES, ROCKER_SIZES} & solved.scale_of_plan.keys():
        read = (name for name, shown in solved.shown_on.items() if shown == plan and name in solved.values)
        said |= {f"{name}_read": _read(scene, plan, name) for name in read}
        said[SCALES[plan]] = scene.factor(scene.scale(plan))
    if solved.rolling is not None:
        said["theta"], said["gamma"] = scene.pressed()
        said |= {f"theta_{phase}": f"[θ] = {scene.degrees(abs(limit))}" for phase, limit in course.permitted(solved)}
        said["line"] = str(scene.shown)
    if solved.roller is not None:
        said |= {"e": scene.stated("e", abs(solved.roller.sizes.e)), "offsets": "".join(_offsets_line(scene))}
        said["rise_side"], said["fall_side"] = (texts["cam.right"], texts["cam.left"])[:: -solved.cam.sense]
        said |= {"ratio_s": _ratio(scene, "mu_s", "mu_s_ds"), "ratio_ds": _ratio(scene, "mu_ds", "mu_s_ds")}
        ds = scene.length(abs(course.analogue(solved, scene.shown).real))
        said["OP"] = f"OP_{{{scene.shown}}} = |{scene.symbol('ds')}| = {ds} {words.unit('mm')}"
    if solved.rocker is not None:
        said |= {"l_letter": scene.symbol("l_rocker"), "l_OC_letter": scene.symbol("l_OC")}
        said["l_rocker_paper"] = _on_paper(scene, scene.drawn(sizes["l_rocker"]))
        said["ratio"] = words.short(float(f"{abs(course.turning(solved, scene.shown)):.4g}"))
    if solved.plate is not None:
        said |= {"ratio_s_d2s": _ratio(scene, "mu_s", "mu_s_d2s"), "ratio_d2s": _ratio(scene, "mu_d2s", "mu_s_d2s")}
        parts = " + ".join(scene.length(sizes[name]) for name in ("ds_max", "margin"))
        total = f"{parts} = {scene.length(sizes['R_plate'])} {words.unit('mm')}"
        said["R_plate_sum"] = f"{scene.symbol('R_plate')} = {total}"
    if solved.draws_profiles:  # the plans of the cam begin with their scale and the first circles
        beside = ("l_OC",) if solved.rocker is not None else ("e",) * is_aside(scene)
        radii = ("r_0", *beside) if solved.rolling is not None else ()
        said |= {"scale": words.drawn_at(scene.mu_l), "radii": ", ".join(said[name] for name in radii)}
    return said


def _on_paper(scene: CamScene, mm: float) -> str:
    """Return a length on paper with its unit, without zeros at the end."""
    return f"{scene.words.short(round(mm, ruler_decimals(scene.words, mm)))} {scene.words.unit('mm')}"


def _closing(scene: CamScene, name: str) -> str:
    """Return by how much a curve of chords does not close, with its letter."""
    return f"{scene.symbol(name)} = {scene.words.number(scene.paper(name), PAPER)} {scene.words.unit('mm')}"


def _read(scene: CamScene, plan: str, name: str) -> str:
    """Return a size as it is read from a plan: its millimetres times the scale factor."""
    words, mu = scene.words, float(f"{scene.scale(plan).mu:.{MU_DIGITS}g}")
    metres = scene.value_of(name)
    segment, value = read_off(words, metres, mu)
    product = f"{segment}·{words.short(mu)} = {value}"
    return f"{scene.symbol(name)} = {product} {words.unit('m')} = {scene.length(metres)} {words.unit('mm')}"


def _of_diagrams(scene: CamScene, texts: Texts) -> Said:
    """Return the section lines and phases, poles, greatest ordinates and closing errors, mm of paper."""
    solved, division = scene.solved, scene.division
    phases = {f"phi_{p.name}": p.length for p in solved.motion.phases[:3] if p.lasts}
    drawn = {name: angle / scene.across.mu for name, angle in phases.items()}
    drawn |= {
        name: scene.paper(name) for name in (*ON_PAPER, "V_max", "l_A2") if name in ("V_max", "S_max", *solved.values)
    }
    said = {name: f"{scene.symbol(name)} = {_on_paper(scene, mm)}" for name, mm in drawn.items()}
    said |= {name: _closing(scene, name) for name in ("v_close", "s_close") if name in solved.values}
    said |= {"last": str(division.last), "n_rise": str(division.top), "n_fall": str(division.last - division.leave)}
    said["phases"] = ", ".join(said.pop(name) for name in phases)
    said["angles"] = ", ".join(scene.angle(*phase) for phase in phases.items())
    amplitudes = ("l_A1", "l_A2") if solved.layout.given == ACCELERATION else ("l_A1",)
    said["amplitudes"] = ", ".join(said[name] for name in amplitudes if name in said)
    jumps = ", ".join(map(str, division.jumps))
    return said | {"per_mm": scene.axis, "jumps": texts["cam.jumps"].format(lines=jumps) if jumps else ""}


def _conclusions(scene: CamScene, texts: Texts) -> Iterator[str]:
    """Go through the sentences for the end of the note."""
    solved, words, values = scene.solved, scene.words, scene.solved.values
    said = {
        name: f"{scene.symbol(name)} = {scene.value(float(values[name]))} {words.unit(unit_of(name))}"
        for name in ("v_max", "a_max")
        if name in values
    }
    moved = texts["cam.roller_centre" if solved.layout.rocks else "cam.follower"]
    yield texts[f"cam.conclusion.{'motions' if 'a_max' in said else 'motion'}"].format(of=moved, **said)
    exact, drawn = scene.paper("S_max"), scene.paper("S_max_chord")  # of the stroke
    part = words.number(100.0 * abs(drawn - exact) / exact, 2)
    yield texts["cam.conclusion.chords"].format(part=part, s_close=_closing(scene, "s_close"))
    if solved.rolling is not None:
        yield from _roller(scene, texts)
    if solved.plate is not None:
        rho = float(solved.plate.profile.rho_min)
        stated = {name: scene.stated(name, float(values[name])) for name in ("r_0_flat", "R_plate")}
        yield texts["cam.conclusion.plate"].format(**stated)
        if 0.0 <= rho < math.inf:
            yield texts["cam.conclusion.convex"].format(rho=f"{scene.length(rho)} {words.unit('mm')}")
        yield from _undercuts(scene, solved.plate.profile)
    elif PLATE in solved.cam.followers and solved.motion.velocity_jumps:
        yield texts["cam.conclusion.no_plate"]


def _roller(scene: CamScene, texts: Texts) -> Iterator[str]:
    """Tell the sizes of a cam for a roller, the rules, and where the profile is undercut."""
    solved, words, follower = scene.solved, scene.words, "roller" if scene.solved.rocker is None else "rocker"
    names = ("r_0", "R_roller", "e" if solved.rocker is None else "l_OC")
    said = {name: scene.stated(name, abs(float(solved.values[name]))) for name in names}
    yield texts[f"cam.conclusion.{follower}"].format(**said)
    for rule in rules_of(solved):
        if rule.of:
            part = f"{words.short(rule.part)}·{scene.symbol(rule.of)}"
            limit = f"{scene.length(rule.limit)} {words.unit('mm')}"
            said = {"part": part, "limit": limit, rule.of: scene.stated(rule.of, rule.size)}
        else:
            said = {"value": scene.angle(f"{rule.name}_min", rule.value), "limit": scene.angle(rule.name, rule.limit)}
        yield texts[f"cam.conclusion.{rule.name}_{'kept' if rule.ok else 'broken'}"].format(**said)
    yield from _undercuts(scene, scene.rolling.profile)


def _undercuts(scene: CamScene, profile: Envelope) -> Iterator[str]:
    """Join what the sheet says of an undercut profile to a sentence."""
    if notes := undercut_notes(scene, profile):
        warning, *places = notes
        yield f"{warning} {'; '.join(places)}."
