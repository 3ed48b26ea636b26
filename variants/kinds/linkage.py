"""Tasks about linkages: a table `[mechanism]` with links, pairs, a driver, loads."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, ClassVar

from ...plans.board import POSITION
from ...plans.boards.exact import SMALL
from ...plans.laws import TURN
from ...plans.linkages.chain import PLANS, construct, hinged
from ...plans.linkages.compound import ACCELERATION, VELOCITY, found_here
from ...plans.linkages.loads import in_order
from ...plans.linkages.mechanism import Driver, Mechanism
from ...plans.linkages.solved import SolvedLinkage, disagreement, read_by_ruler, scale_symbols, solve_linkage
from ...plans.linkages.structure import analyse
from ...plans.names import COUPLE, FORCES, Name, role, spelled
from ...plans.quantities import pins_together, point_of
from ...plans.solved import WITHIN, Check
from ...scales.errors import InputError
from ...scales.names import unknown
from ...scales.numbers import quote
from ...scales.scale import Segment, chooser
from ..case import PARTS, WIDTH, Case, Choices, Kind, Numbers, Plans, Scales, Tie
from ..checks.mechanism import branched, place_of, read_mechanism, started
from ..marking.wording import letter, texts
from ..task import Given, Task

if TYPE_CHECKING:
    from ...drawing.compose import Drawn
    from ...drawing.formats import Format, Norm
    from ...drawing.handouts import Shown
    from ...drawing.linkages.scene import Scene
    from ...drawing.notes.blocks import Story
    from ...drawing.view import View
    from ...drawing.words import Words
    from ...plans.hands.shaky import Paper, Tolerance
    from ...plans.linkages.cycle import Cycle
    from ...plans.marking.key import Question
    from ..checks.basics import Checker
    from ..checks.names import Names

LEVER_AGREES = 1e-6  # per cent by which the balancing moment and the lever's may differ
SHORT = 0.01  # part of the longest vector of a plan below which another is hardly seen: a millimetre beside 100
TURNS = range(60, 360, 60)  # degrees, to where else a crank is looked at
COMPOUND_AGREES = 1e-9  # part of the longest vector by which two routes to one vector may differ
OPEN = ("", "position", "velocity", "acceleration", "loads")  # sections before the first group is dealt with
KINEMATIC = {"V": "velocity", "omega": "velocity", "a": "acceleration", "epsilon": "acceleration"}


class Linkages(Kind[Mechanism, SolvedLinkage]):
    """Linkages of any structure that the plans know."""

    table, room, plans, moves = "mechanism", "linkages", PLANS, False
    elsewhere: ClassVar[Mapping[str, str]] = {
        "first_scales": "ladders",
        "conditions_of": "solved",
        "lettered": "reading",
    }
    form_notes: ClassVar[Mapping[str, str]] = {"lever": "arms"}  # how arms on the lever are written

    def read(self, checker: Checker, raw: object, names: Names, givens: Mapping[str, Given]) -> Mechanism | None:
        """Read `[mechanism]`."""
        return read_mechanism(checker, raw, names)

    def fits(self, checker: Checker, subject: Mechanism, head: Mapping[str, Any]) -> None:
        """Check that the mechanism has a structure, constructions for its groups, and plans for the scale factors."""
        try:
            construct(subject, head["plans"])
            # a task that never splits a motion may use the names of what that would measure
            structure, program = construct(subject, {*PLANS} - {"compound"} | {*head["plans"]})
            if "compound" in head["plans"] and not hinged(subject, structure):
                raise InputError("no-coupler")
        except InputError as error:
            before = len(checker.faults)
            if error.key == "start-missing":  # or it is that of another link
                started(checker, subject, analyse(subject))
            if len(checker.faults) == before:
                checker.fault(place_of(subject, error), error)
            return
        branched(checker, subject, structure)
        started(checker, subject, structure)
        symbols = scale_symbols(structure, program)
        lengths = {x for link in subject.links for x, _ in link.points.values()}
        for name, said in head.get("scales", {}).items():
            if name not in symbols:
                checker.fault(("scales", name), unknown("scale-unknown", name, symbols, task=head.get("id", "")))
                continue
            choice = chooser(name, said)
            if isinstance(choice, Segment) and choice.quantity not in {*program.names, *lengths}:
                checker.fault(("scales", name), InputError("scale-segment", text=quote(said)))

    def varies(self, checker: Checker, task: Task) -> None:
        """Check that the places of load diagrams do not decrease, and lie within the stroke or a turn."""
        for i, diagram in enumerate(task.mechanism.diagrams):
            with checker.at(("mechanism", "diagram", i, "at")):
                for variant in task.variants:
                    in_order(diagram, task.values(variant))

    def solve(self, subject: Mechanism, values: Numbers, words: Choices, plans: Plans) -> SolvedLinkage:
        """Solve one position."""
        solved = solve_linkage(subject, values, plans)
        if "compound" in plans and not hinged(solved.mechanism, solved.structure):
            raise InputError("no-coupler")
        return solved

    def scale_symbols(self, solved: SolvedLinkage) -> tuple[str, ...]:
        """Return the symbols of all scale factors that may be chosen."""
        return scale_symbols(solved.structure, solved.program)

    def unfit(self, case: Case) -> Iterator[InputError]:
        """Go through what makes a variant a poor exercise: its crank does not turn round, a plan is a line."""
        yield from super().unfit(case)
        yield from _hindered(case.task.mechanism, case.values)
        short = always = _short_vectors(SolvedLinkage.of(case.solved))
        task, driver = case.task, case.task.mechanism.driver
        others = [(task.values(one), task.words(one)) for one in task.variants]
        if isinstance(driver, Driver):  # variants may all stand in dead positions
            turned = (case.values[driver.angle] + math.radians(turn) for turn in TURNS)
            words = task.words(case.variant, case.settings)
            others = [(case.values | {driver.angle: angle}, words) for angle in turned]
        for values, words in others:
            if not always:
                break
            other = self.solve(task.mechanism, values, words, case.plans)
            if other.trouble is None:  # what is so wherever it stands, as on guides that do not turn, does not count
                always = always & _short_vectors(other)
        for name in sorted(short - always):
            yield InputError("variant-short", quantity=name)

    def ties(self, task: Task) -> dict[str, Tie]:
        """Return of which length of its link each distance to a centre of mass is a part, and of how much of it."""
        found, stated = dict[str, Tie](), [row.values for row in task.variants.values()]
        for link in task.mechanism.links:
            for axis, own in enumerate(link.points[link.centre] if link.centre else ()):
                others = {place[axis] for place in link.points.values()} - {own}
                wholes = [name for name in sorted(others) if all(row.get(name) for row in stated)]
                if wholes and all(own in row for row in stated):
                    whole = max(wholes, key=lambda name: stated[0][name])
                    parts = [float(row[own]) / float(row[whole]) for row in stated]
                    found[own] = Tie(whole, min(parts), max(parts))
        return found

    def remarks(self, task: Task, variant: str, solved: SolvedLinkage) -> Iterator[InputError]:
        """Go through what a teacher should know: where a crank does not turn, where links lie in line."""
        yield from super().remarks(task, variant, solved)
        yield from _hindered(task.mechanism, task.values(variant), lined=True)

    def warnings(self, solved: SolvedLinkage) -> tuple[InputError, ...]:
        """Tell of lines that meet at a small angle."""
        if solved.trouble is not None:
            return ()
        mark, sine = solved.worst_sine()
        if sine >= SMALL:
            return ()
        point = role(point_of(solved.program, mark)).of
        said = {"point": point, "angle": f"{math.degrees(math.asin(sine)):.3g}", "loss": _short(1.0 / sine)}
        if solved.status != "ill-conditioned":
            return (InputError("small-angle", **said),)
        from ...plans.linkages.solved import worst_condition  # needs numpy, and few positions need it

        quantity, condition = worst_condition(solved)
        said |= {"quantity": quantity, "condition": _short(condition)}
        pins = pins_together(solved.program, solved.values, mark)
        if pins is None:
            return (InputError("ill-conditioned", **said),)
        return (InputError("ill-conditioned-pins", first=pins[0], second=pins[1], **said),)

    def checks(self, solved: SolvedLinkage) -> tuple[Check, ...]:
        """Return what a second route says.

        `lever` compares what balances the driver with Zhukovsky's lever, per cent; `compound` the plans of velocities
        and accelerations with the sums of compound motion, in parts of their longest vectors.
        """
        delta = solved.quantities.get("delta_M_bal") or solved.quantities.get("delta_F_bal")
        routes = (
            ("lever", delta.value if delta else None, LEVER_AGREES, "%", delta.name if delta else ""),
            ("compound", disagreement(solved), COMPOUND_AGREES, "", ""),
        )
        return tuple(
            Check.of_value(name, gap, WITHIN, limit, of, quantity=quantity)
            for name, gap, limit, of, quantity in routes
            if gap is not None
        )

    def draw(self, case: Case, words: Words, norm: Norm = "gost", paper: Format | None = None) -> Drawn:
        """Draw the plans of one position, and the cycle where the task wants it."""
        from ...drawing.linkages.sheet import Contents, draw

        how = case.choosers, case.givens, words, norm
        if case.positions is not None:
            whole = _turn(case, (*case.plans, POSITION), case.positions)
            return draw(Contents(placed(case), ("cycle",), *how, whole, courses=True), paper)
        turn = _turn(case, ("position", "velocity", "acceleration")) if "cycle" in case.plans else None
        contents = Contents(placed(case), _drawn_plans(case), *how, turn, _dead(case), variant=case.variant)
        return draw(contents, paper)

    def moving(self, case: Case, words: Words) -> dict[str, Any]:
        """Return the solver, the views and the steps of a page that moves."""
        from ...drawing.linkages.moving import moving_linkage

        bounds = {name: given.bound.value for name, given in case.task.givens.items()}
        return moving_linkage(placed(case), _turn(case), case.givens, words, bounds)

    def construction(self, case: Case, scales: Scales, words: Words, titles: tuple[str, str]) -> bytes:
        """Return the recorded construction with its plans as a file of GeoGebra."""
        from ...drawing.linkages.geogebra import Construction

        return Construction(self.scene(case, scales, words), _turn(case)).packed(titles)

    def story(self, case: Case, scales: Scales, words: Words, texts: Mapping[str, str]) -> Story:
        """Tell what is given and what is to be found, then every plan step by step, its equations before it."""
        from ...drawing.linkages.statement import aims, data_table, kinematic_scheme
        from ...drawing.linkages.steps import story

        scene = self.scene(case, scales, words)
        head = kinematic_scheme(scene), data_table(scene, case.plans)
        return replace(story(scene, texts), head=head, aims=tuple(aims(scene, case.plans)))

    def given_views(self, case: Case) -> tuple[str, ...]:
        """Return the diagrams of loads."""
        return tuple(f"load_{diagram.name}" for diagram in case.task.mechanism.diagrams)

    def begun(self, case: Case, scales: Scales, words: Words, steps: int) -> Mapping[str, Shown]:
        """Return what is drawn of the plans after their first steps, and load diagrams, which are given."""
        from ...drawing.handouts import Shown
        from ...drawing.linkages.steps import begun

        given = {name: Shown(notes=True) for name in self.given_views(case)}
        return given | begun(self.scene(case, scales, words), steps, case.plans)

    def scene(self, case: Case, scales: Scales, words: Words) -> Scene:
        """Return what is drawn with its letters and scale factors, on A4 if no format is said."""
        from ...drawing.formats import STYLES, format_named
        from ...drawing.linkages.scene import Scene

        solved, style = placed(case), STYLES[format_named(case.format or "A4").letters]
        return Scene(solved, self.lettered(words, solved), style, case.givens, scales)

    def magnified(self, case: Case, scales: Scales, words: Words) -> Mapping[str, float]:
        """Return what is read in the insets of force plans."""
        from ...drawing.linkages.figures.plan import magnified

        return magnified(self.scene(case, scales, words))

    def read_by_ruler(self, case: Case, scales: Scales) -> SolvedLinkage:
        """Read every segment to half a millimetre."""
        return read_by_ruler(placed(case), {plan: scale.mu for plan, scale in scales.items()})

    def headings(self, solved: SolvedLinkage, words: Words) -> dict[str, str]:
        """Leave the list of quantities whole."""
        return {}

    def limits(self, drawn: SolvedLinkage, paper: Paper, tolerance: Tolerance) -> dict[str, float]:
        """Let the usual rule hold for all quantities."""
        return {}

    def pictured(self, case: Case, words: Words, part: float = 1.0) -> View:
        """Draw the kinematic scheme."""
        from ...drawing.linkages.statement import SKETCHED, kinematic_scheme

        wide, high = SKETCHED
        return kinematic_scheme(self.scene(case, {}, words), (part * wide, part * high))

    def statements(self, case: Case, words: Words, aims: Sequence[str]) -> Iterator[list[View]]:
        """Go through the scheme, the data with the loads in this position, what is to be found."""
        from ...drawing.linkages.statement import data_table, task_text

        scene = self.scene(case, {}, words)
        told = data_table(scene, case.plans, here=True), task_text(scene, case.plans, case.variant, WIDTH)
        yield from ([self.pictured(case, words, part), *told] for part in PARTS)

    def called(self, subject: Any, words: Words, name: str) -> str:
        """Return what a given is: what the mechanism uses it for."""
        from ...drawing.linkages.asking import given_name

        return given_name(subject, words, name) or super().called(subject, words, name)

    def loaded(self, name: str) -> bool:
        """Whether a quantity hangs on loads and masses: all but motion and distances."""
        return role(name).kind not in {*KINEMATIC, "l"}

    def stated(self, case: Case, words: Words, loaded: bool = True) -> Iterator[tuple[str, str, str]]:
        """Go through the data; with loads how these act in this position."""
        from ...drawing.linkages.asking import FORCES as LOADED
        from ...drawing.linkages.asking import rows_of
        from ...drawing.tables import with_unit

        plans = LOADED if loaded else {"acceleration"}
        rows = rows_of(self.scene(case, {}, words), plans, here=True)
        return ((symbol, called, with_unit(value, of)) for symbol, called, value, of in rows)

    def sought(self, solved: SolvedLinkage, words: Words, name: str) -> str:
        """Return what a quantity of motion, a force, a reaction or what balances the driver is.

        That of a point which no scheme shows, as Assur's special point, is asked for by nobody.
        """
        from ...drawing.linkages.asking import meaning, on_scheme

        hidden = name in found_here(solved.program) or not on_scheme(solved.mechanism, name)
        return "" if hidden else meaning(solved.mechanism, words, name)

    def asks(self, solved: SolvedLinkage, question: Question) -> bool:
        """Ask not for each force of a couple: these are as large as the couple's force; nor for arms that none has.

        On a lever of many forces the arm of a couple is the line between its forces.
        """
        from ...drawing.linkages.calculations.forces import ARMS, POLE

        if question.step.verb == "arm":
            program = solved.program
            taken = {step.name: step.operands[0] for step in program.which(("moment",)) if step.operands[2] == POLE}
            force = taken.get(question.step.operands[0], "")
            return not force or len(taken) <= ARMS or role(force).part != COUPLE
        return not (role(question.name).part == COUPLE and role(question.name).about)

    def section(self, solved: SolvedLinkage, question: Question, current: str) -> str:
        """Return the section of a question: its plan, or the plan of the forces that it goes with."""
        kind, plan = role(question.name).kind, role(question.plan)
        if plan == "lever" or current == "lever":
            return "lever"
        if plan.kind == VELOCITY:  # those of all points are one drawing
            return Name(VELOCITY, VELOCITY)
        if plan.kind == ACCELERATION:
            return plan
        if kind == "l" and plan == POSITION:
            return "position"
        if kind in KINEMATIC and plan in (POSITION, "velocity", "acceleration") and "forces" not in current:
            return KINEMATIC[kind]
        if question.step.verb == "arm":  # with the force plan of the force that it is the arm of
            plan = role(solved.shown_on.get(role(question.step.operands[1]).shown, plan))
        if kind in ("R", "M", "h") and plan.kind == FORCES:
            return spelled("forces", role(solved.scale_of_plan[plan]).about)
        return "loads" if kind not in ("h", "M", "F") or current in OPEN else current

    def plan_heading(self, solved: SolvedLinkage, plan: str, words: Words) -> str:
        """Return the heading of a plan, as the sheet has it; `V_at` alone stands for the points of one drawing."""
        from ...drawing.linkages.scene import plan_heading

        drawn = role(plan)
        if plan == "loads":  # which have none of their own
            return texts(words.language)["form.loads"]
        if drawn == spelled("forces", solved.structure.driver):
            return words["heading.driver"]
        if drawn.kind == VELOCITY:
            return ": ".join(filter(None, (words["heading.compound_velocity"], drawn.of)))
        if drawn.kind == ACCELERATION:
            return words["heading.compound_acceleration"].format(point=drawn.of)
        return plan_heading(words, solved.structure, plan)

    def vector_letters(self, solved: SolvedLinkage, words: Words) -> dict[str, str]:
        """Return the letters of the vector that shows a quantity on its plan, pb, ab, n_BA b, or of its ends, CA."""
        from ...drawing.linkages.reading import read
        from ...drawing.linkages.scene import is_at_point

        reading = read(solved.program)
        plans = (plan for plan in solved.program.plans if not is_at_point(plan))
        lengths = (role(step.name) for step in solved.program.which(("measure", "distance")))
        found = {str(length): f"{length.of}{length.about}" for length in lengths if length.kind == "l"}
        for edge in (edge for plan in plans for edge in reading.on(plan)):
            tail, tip = (letter(words, mark) for mark in (edge.tail, edge.tip))
            found.setdefault(role(edge.name).shown, f"{tail}{tip}")
        return found


KIND = Linkages()


def _hindered(mechanism: Mechanism, values: Mapping[str, float], lined: bool = False) -> Iterator[InputError]:
    """Go through what is in the way of a crank: arcs that it cannot reach; if `lined`, also lines that turn one.

    Nothing is told of a crank that reaches no place at all.
    """
    from ...plans.linkages.limits import reach_of, swept

    drive = swept(mechanism, values)
    found = reach_of(drive, values)
    if not (drive.turns and found.stretches):
        return
    for arc in found.apart:
        back = TURN if arc.high > TURN else 0.0  # an arc about zero begins below it
        yield InputError("variant-apart", low=_degrees(arc.low - back), high=_degrees(arc.high - back))
    for key, places in (("variant-change", found.changes), ("variant-pole", found.poles)) if lined else ():
        if places:
            yield InputError(key, angles=", ".join(f"{_degrees(place)}°" for place in places))


def _drawn_plans(case: Case) -> Plans:
    """Return the plans of what is drawn, in its position."""
    return case.plans if POSITION in case.solved.program.plans else (*case.plans, POSITION)


def _turn(case: Case, plans: Plans = (), positions: int | None = None) -> Cycle:
    """Return the mechanism over its cycle, with the plans of what is drawn where none are said."""
    from ...plans.linkages.cycle import cycle  # drawing a single position does not import it

    count = () if positions is None else (positions,)
    return cycle(case.task.mechanism, case.values, plans or _drawn_plans(case), *count)


def _short(value: float) -> str:
    """Return a number with three digits, a large one with a power of ten."""
    return f"{float(f'{value:.3g}'):g}".replace("e+0", "e").replace("e+", "e")


def _dead(case: Case) -> tuple[SolvedLinkage, ...]:
    """Return the mechanism where its working stroke begins and ends, if the task wants it."""
    if "dead" not in case.plans:
        return ()
    from ...plans.linkages.limits import swept  # drawing a single position does not import them
    from ...plans.linkages.strokes import working_stroke

    drive, ends = swept(case.task.mechanism, case.values), working_stroke(case.task.mechanism, case.values)
    places = ({**case.values, drive.variable: place} for place in ends)
    return tuple(solve_linkage(drive.mechanism, values, (POSITION,)) for values in places)


def _short_vectors(solved: SolvedLinkage) -> set[str]:
    """Return the velocities and accelerations that are next to nothing beside the longest one of their plan.

    Parts of an acceleration, normal or of Coriolis, often are.
    """
    short = set[str]()
    for plan in ("velocity", "acceleration"):
        own = (item for name, item in solved.quantities.items() if solved.shown_on.get(name) == plan)
        sizes = {item.name: item.value or 0.0 for item in own if item.kind == "vector"}
        short |= {name for name, size in sizes.items() if size < SHORT * max(sizes.values()) and not role(name).part}
    return short


def _degrees(angle: float) -> str:
    return f"{round(math.degrees(angle), 9) + 0.0:.4g}"  # nothing but rounding is nothing


def placed(case: Case) -> SolvedLinkage:
    """Return what is drawn, in its position: a structure is drawn with its scheme; refuse what has none."""
    solved = SolvedLinkage.of(case.solved)
    if POSITION in solved.program.plans:
        return solved
    values, words = case.values, case.task.words(case.variant, case.settings)
    found = KIND.solve(case.task.mechanism, values, words, (*case.plans, POSITION))
    error = found.error()
    if error is not None:
        raise error
    return found
