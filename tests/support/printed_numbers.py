"""Numbers as they are printed on a sheet: tables, equations, and whether they recompute (L9, L12, L13)."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from decimal import Decimal
from itertools import pairwise

from kulman.tests.support.readback import Sheet, Text, View

NUMBER = r"\d+(?:[.,]\d+)?"
POWER = r"\^\{−?\d+(?:/2)?\}"
FUNCTIONS = {"inv": lambda x: math.tan(x) - x, "√": math.sqrt, "tg": math.tan, "arctg": math.atan, "arctan": math.atan}
FUNCTIONS |= {"arccos": math.acos, "arcsin": math.asin, "sin": math.sin, "cos": math.cos, "tan": math.tan}
NAMED = rf"(?:{'|'.join(FUNCTIONS)})"
EXPRESSION = re.compile(rf"(?:[\s\d.,·/+−()%π°]|{POWER}|{NAMED})*")
RESULT = re.compile(rf"(−?{NUMBER}(?:·10\^\{{−?\d+\}})?)(°?)")


def numbers_of(text: str, lang: str) -> list[float]:
    """Return the numbers of a text; a wrong decimal sign is no number."""
    plain = re.sub(r"[_^]\{[^}]*\}", "", text)
    found = re.findall(rf"[−]?{NUMBER}", plain)
    sign = "." if lang == "en" else ","
    wrong = "," if lang == "en" else "."
    assert not any(re.search(rf"\d\{wrong}\d", number) for number in found), text
    return [float(number.replace("−", "-").replace(sign, ".")) for number in found]


def decimal(text: str, lang: str) -> str:
    """Return a number that has a point as a language writes it."""
    return text if lang == "en" else text.replace(".", ",")


def value(text: str) -> float:
    return float(text.replace("·10^{", "e").rstrip("}").replace("−", "-").replace(",", "."))


def half_digit(text: str) -> float:
    """Half a unit of the last printed digit, and a little for ties."""
    mantissa, _, power = text.partition("·10^{")
    number = re.findall(NUMBER, mantissa)[-1].replace(",", ".")
    return 0.5 * 10.0 ** Decimal(number).as_tuple().exponent * (1 + 1e-9) * float(f"1e{int(value(power or '0'))}")


def recomputes(number: float, printed: str) -> bool:
    """Whether a number is the printed one, rounded as usual: a half goes up."""
    over = math.copysign(1.0, number) * (number - value(printed)) / half_digit(printed)
    return -1.0 <= over < 1.0 - 1e-8


def table(view: View) -> list[list[str]]:
    """Return the rows of a table below its head, the cells from left to right."""
    rows: dict[int, list[Text]] = {}
    for cell in sorted(view.of("cell"), key=lambda cell: -cell.baseline):
        level = next((y for y in rows if abs(y - cell.baseline * 1000) < 10), round(cell.baseline * 1000))
        rows.setdefault(level, []).append(cell)
    ordered = [sorted(cells, key=lambda cell: cell.box[0]) for cells in rows.values()]
    return [[cell.string for cell in cells] for cells in ordered[1:]]


def lines_of(view: View) -> list[str]:
    """Return the lines of a block of text, broken ones joined again."""
    lines: list[str] = []
    left = min(t.runs[0].at.real for t in view.of("line"))
    for text in view.of("line"):
        if text.runs[0].at.real > left + 0.5 and lines:
            lines[-1] += " " + text.string
        else:
            lines.append(text.string)
    return lines


def ruled(mm: str, paper: str, long: float = 100.0) -> bool:
    """Whether a segment is printed as a ruler shows it: to 0.01 mm, from 100 mm on to 0.1 mm; in cm to as much."""
    centimetres = paper in ("cm", "см")
    return len(re.split("[.,]", mm)[-1]) == (1 if value(mm) * (10 if centimetres else 1) >= long else 2) + centimetres


def shorter_ones(mm: str) -> set[float]:
    """Return what a segment is with one decimal less, at a tie both."""
    shorter, last = mm[:-1].rstrip(".,"), mm[-1]
    unit = 10.0 ** -len(re.split("[.,]", f"{shorter}.")[1])
    return {value(shorter) + unit * up for up in ((0,) if last < "5" else (1,) if last > "5" else (0, 1))}


def told_shorter(mm: str, mu: str, printed: str) -> bool:
    """Whether a segment with one decimal less gives its value, too."""
    return all(recomputes(one * value(mu), printed) for one in shorter_ones(mm))


def finer(mm: str, mu: str, printed: str, paper: str) -> bool:
    """Whether a segment has one decimal more than a ruler shows, since that leaves its value less than three digits."""
    shorter, near = mm[:-1].rstrip(".,"), shorter_ones(mm)
    half = 0.499 * 10.0 ** -len(re.split("[.,]", f"{printed}.")[1])  # what is printed was one of these
    exact = {value(printed) + half, value(printed) - half}
    return ruled(shorter, paper) and any(f"{one * value(mu):.3g}" != f"{of:.3g}" for one in near for of in exact)


def shows(printed: float, millimetres: float, near: float = 0.005001) -> bool:
    """Whether a printed length is one on paper: within `near`, from 100 mm on within half a tenth."""
    return abs(printed - millimetres) < (near if millimetres < 100.0 else max(near, 0.050001))


def lever_faults(view: View, lang: str) -> Iterator[str]:
    """Rows of the lever's table of which the force times the arm in mm is not the moment to its last digit."""
    for symbol, force, _, arm, moment, sense in table(view):
        numbers_of(" ".join((force, arm, moment)), lang)
        if "–" not in (force, arm) and not recomputes(value(force) * value(arm), moment):
            yield f"{symbol}: {force}·{arm} is not {moment}"
        turns = value(moment) != 0.0 or ("–" not in (force, arm) and value(force) * value(arm) != 0.0)
        if (sense == "–") == turns or (value(moment) == 0.0) == turns:
            yield f"{symbol}: the sense of {moment} is {sense}"


def read_to(row: Sequence[str], calculated: bool = False) -> float:
    """Return how far a printed value may be from the exact one: by half its last digit, or as its millimetres say.

    Of one that is calculated from others that are printed the last digit but one is right, and its millimetres are
    those of the drawing to their last digit.
    """
    _, mm, mu, printed = row[:4]
    near = half_digit(printed)
    if mm == "–":
        return near * (10.0 if calculated else 1.0)
    if calculated:
        return near + 2.0 * max(half_digit(mm), 0.005) * value(mu) * (
            10.0 if value(mm) >= 100.0 and ruled(mm, "mm", 1e9) else 1.0
        )
    return max(near, half_digit(mm) * value(mu) + near * (value(printed) > 100.0))  # in units


def reactions(rows: Iterable[Sequence[str]]) -> list[tuple[tuple[str, str], tuple[str, str]]]:
    """Return the pairs of an action and its reaction among rows, each by its symbol and its printed value."""
    found = {row[0]: row[3] for row in rows}
    pairs = list[tuple[tuple[str, str], tuple[str, str]]]()
    for symbol in found:
        index = re.fullmatch(r"([A-Z])_\{(\d)(\d)\}|([A-Z])_\{(\d+),(\d+)\}", symbol)
        if index is not None:
            letter, first, second = filter(None, index.groups())
            other = f"{letter}_{{{second}{',' if index[4] else ''}{first}}}"
            if letter != "M" and first < second and other in found:
                pairs.append(((symbol, found[symbol]), (other, found[other])))
    return pairs


def balanced(sheet: Sheet, rows: Iterable[Sequence[str]]) -> list[tuple[tuple[str, str], tuple[str, str]]]:
    """Return the pairs of forces that are alone on a plan, so that one closes it as the opposite of the other."""
    found, plans = {row[0]: row[3] for row in rows}, (view for view in sheet.views if view.name.startswith("forces_"))
    twos = ([re.sub(r"_(\w+)$", r"_{\1}", vector.quantity) for vector in plan.vectors] for plan in plans)
    return [((a, found[a]), (b, found[b])) for a, b in (two for two in twos if len(two) == 2) if {a, b} <= {*found}]


def table_faults(sheet: Sheet, lang: str, values: dict[str, float]) -> Iterator[str]:
    """Rows in which mm times mu is not the value to its last digit, or which `values` (by symbol) contradict."""
    forces = [row for name in sheet.names if name.startswith("results_forces") for row in table(sheet[name])]
    laid = {symbol for symbol, said in told(sheet).items() if "=" in said}  # by numbers, which are no readings
    pairs = [*reactions(forces), *balanced(sheet, forces)]
    reading = {row[0]: read_to(row, row[0] in laid) for row in forces}
    yield from disagreements(sheet)
    for (symbol, printed), (other, its) in pairs:
        if printed != its:
            yield f"{symbol} = {printed}, {other} = {its}"
    carried = dict[str, set[str]]()  # from plan to plan: forces that have one number
    for (one, _), (two, _) in pairs:
        alike = carried.get(one, {one}) | carried.get(two, {two})
        carried |= dict.fromkeys(alike, alike)
    for name in sheet.names:
        if name.startswith("results_lever"):
            yield from lever_faults(sheet[name], lang)
        if not name.startswith("results_") or name.startswith("results_lever"):
            continue
        (head,) = [c.string for c in sheet[name].of("cell") if re.search(r", (mm|мм|cm|см)$", c.string)]
        for row in table(sheet[name]):
            symbol, mm, mu, printed = row[:4]
            if mm != "–":
                if not recomputes(value(mm) * value(mu), printed):
                    yield f"{symbol}: {mm}·{mu} is not {printed}"
                paper = head.split()[-1]  # what is laid off from plan to plan is a number, not a reading
                if not (
                    ruled(mm, paper)
                    or (symbol in (*carried, *laid) and ruled(mm, paper, math.inf))
                    or (symbol in laid and finer(*row[1:4], paper))
                    or (
                        any(ruled(mm[:-1], paper, of) for of in (100.0, math.inf)) and not told_shorter(mm, mu, printed)
                    )
                ):
                    yield f"{symbol}: no ruler reads {mm} mm"
            near = max(
                read_to(row, symbol in laid),
                *(reading[other] for other in carried.get(symbol, {symbol}) & {*reading}),
                0.0,
            )
            if symbol in values and abs(abs(value(printed)) - abs(values[symbol])) > near + 1e-9:
                yield f"{symbol}: {printed} is not {values[symbol]}"
            numbers_of(" ".join(row), lang)


def evaluate(text: str) -> float:
    """Return the value of a printed expression of numbers; angles in degrees are in radians."""
    plain = text.replace("100 %", "100").replace(",", ".").replace("·", "*").replace("−", "-").replace("√ ", "√")
    plain = re.sub(rf"({NAMED})(\^\{{2\}})? ({NUMBER}°?)", r"\1(\3)\2", plain)
    plain = re.sub(r"\^\{([^}]*)\}", r"**(\1)", plain)
    plain = re.sub(r"([\d.]+)°", rf"(\1*{math.pi / 180.0!r})", plain)
    plain = re.sub(r"π", repr(math.pi), re.sub(r"(?<=\d)π", "*π", plain))
    assert EXPRESSION.fullmatch(text), text
    return float(eval(re.sub(r"\s+", " ", plain).replace("√", "sqrt").strip(), {**FUNCTIONS, "sqrt": math.sqrt}))


def calculations(line: str) -> Iterator[tuple[str, str]]:
    """Yield (expression, printed result) for every `= numbers = number unit` of a line, in degrees if the result is."""
    body = re.sub(r"(?<=\d) (?:mm|мм|cm|см)(?=/| =)", "", line.rpartition(": ")[2])
    for expression, result in pairwise(side.strip() for side in body.split("=")):
        found = RESULT.match(result)
        if found and re.search(r"\d", expression) and EXPRESSION.fullmatch(expression):
            yield f"({expression})·180/π" if found[2] else expression, found[1]


def equation_faults(sheet: Sheet) -> tuple[int, list[str]]:
    """Return how many printed calculations there are, and those that do not recompute to their last digit."""
    count, faults = 0, []
    for view in sheet.views:
        if view.of("line"):
            for line in lines_of(view):
                for expression, result in calculations(line):
                    count += 1
                    if not recomputes(evaluate(expression), result):
                        faults.append(f"{view.name}: {expression} = {evaluate(expression)}, printed {result}")
    return count, faults


def told(sheet: Sheet, note: Iterable[str] = ()) -> dict[str, dict[str, set[str]]]:
    """Return the numbers of quantities of a linkage, also of texts of its note, by symbol and by where they stand.

    That is `=` for results of equations and `·` for what goes into others, `mm` and `row` of tables, `arm` of the
    lever, `letter` for what stands beside a drawing. Arms and segments of plans are called by their views, too; those
    of a note are left out.
    """
    found = dict[str, dict[str, set[str]]]()
    for view in sheet.views:
        for place, spaced, number in _numbers_in(view):
            symbol = spaced.replace(" ", "")
            own = re.fullmatch(r"h.*", symbol) and "lever" in view.name
            if own or re.fullmatch(r"([a-z]′?(_\{\d+\})?){2}", symbol):
                symbol += f" {view.name.replace('equations_', '').replace('results_', '')}"
            found.setdefault(symbol, {}).setdefault(place, set()).add(number.lstrip("−"))
    for clause in (clause for text in note for clause in re.split(r"[,;:.] ", text)):
        for place, spaced, number in _numbers_of(clause):
            symbol = spaced.split(" ")[-1]
            if (
                symbol in found
                and number.strip("−0.,")
                and not re.fullmatch(r"n|[hμ].*|([a-z]′?(_\{\d+\})?){2}", symbol)
            ):
                found[symbol].setdefault(place, set()).add(number.strip("−."))
    return found


def _numbers_of(line: str) -> Iterator[tuple[str, str, str]]:
    """Go through the numbers of an equation: whether they result or go into another one, of which quantity."""
    plain = re.sub(r"\{[^{}]*\}", lambda script: script[0].replace(" ", ""), line)
    head, *sides = [side.strip() for side in plain.rpartition(": ")[2].split(" = ")]
    ends = [found[0] for side in sides if (found := re.match(rf"−?{NUMBER}(?![\d·/]| [−+])", side))]
    if ends:
        yield "=", head, ends[-1]
    for letters, numbers in pairwise([head, *sides]):
        own, its = ([part for part in re.split(r"[·/+()−\s]+", side) if part] for side in (letters, numbers))
        if len(own) == len(its) and all(re.match(r"\d|π", part) for part in its):
            bases = [re.sub(r"\^\{2\}", "", part) for part in (*own, *its)]
            yield from (("·", a, b) for a, b in zip(bases, bases[len(own) :], strict=False) if a[0].isalpha())


def _numbers_in(view: View) -> Iterator[tuple[str, str, str]]:
    """Go through the numbers of a view: where they stand, of which quantity."""
    for line in lines_of(view) if view.of("line") else []:
        yield from _numbers_of(line)
    rows = table(view) if view.name.startswith("results_") else []
    for symbol, first, second, third, *_ in rows:
        if "lever" in view.name:
            yield from (("·", symbol, first), ("arm", second, third))
        else:
            yield from (("mm", symbol, first), ("row", symbol, third))
    for text in (text for text in view.texts if text.role not in ("line", "cell")):
        for part in text.string.split("; "):
            *symbols, number = part.split(" = ")
            if symbols and re.fullmatch(NUMBER, number) and number.strip("0,."):
                yield from (("letter", symbol, number) for symbol in symbols)


def disagreements(sheet: Sheet, note: Iterable[str] = ()) -> Iterator[str]:
    """Quantities of a linkage that equations, tables, letters and the texts of its note tell with different digits.

    Where one way to a number has given that of a table or of a drawing, another may give fewer of its digits.
    """
    for symbol, places in told(sheet, note).items():
        row, results = places.get("row", set()), places.get("=", set())
        numbers = set().union(*(places[place] for place in places if place not in ("row", "mm")))
        known = row | places.get("mm", set()) or {max(numbers, key=len)}
        longer = {one for one in known if not row or one in results}
        for number in numbers - known:
            if number not in results or not any(recomputes(value(one), number) for one in longer):
                yield f"{symbol} = {number}, elsewhere {sorted(known)}"
