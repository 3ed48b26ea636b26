"""Tables of a class: marks with what went wrong, the commonest mistakes, and grades for Moodle."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from ...plans.marking.verdicts import Verdict
from ..roster import WHO, Entry
from ..spreadsheets.csv_write import Cell
from .flags import shared
from .result import Result
from .wording import mistake_texts, texts


def flags_of(results: Sequence[Result], language: str) -> list[list[str]]:
    """Return for each student what a teacher should check: too exact segments, and those shared with another one."""
    said = texts(language)
    found = [result.flags(language) for result in results]
    for pair in shared([result.segments for result in results]):
        for one, other in ((pair.first, pair.second), (pair.second, pair.first)):
            name = results[other].who.student or results[other].source
            found[one].append(said["flag.shared"].format(n=len(pair.names), of=pair.of, near=pair.near, student=name))
    return found


def class_rows(results: Sequence[Result], absent: Sequence[Entry], language: str) -> Iterator[tuple[Cell, ...]]:
    """Go through the rows of the table: a header, the students, those who handed in nothing, commonest mistakes."""
    said = texts(language)
    about = tuple(said[f"about.{key}"] for key in (*WHO, "variant", "sheet"))
    verdicts = tuple(said[f"verdict.{verdict}"] for verdict in Verdict)
    keys = ("class.first", "report.candidates", "report.flags", "report.notes", "report.source", "class.report")
    yield (*about, said["class.mark"], *verdicts, *(said[key] for key in keys))
    for result, flags in zip(results, flags_of(results, language), strict=True):
        who = tuple(getattr(result.who, key) for key in WHO)
        counts = tuple(result.counts.get(str(verdict)) for verdict in Verdict)
        told = (result.first, ", ".join(result.mistakes), "; ".join(flags), "; ".join(result.notes))
        place = (result.source, ", ".join(result.reports))
        yield (*who, result.variant, result.sheet, result.mark, *counts, *told, *place)
    for entry in absent:
        who = tuple(getattr(entry.who, key) for key in WHO)
        blank = (None,) * (len(Verdict) + 4)
        yield (*who, entry.variant, None, *blank, said["class.absent"], entry.place)
    yield from _commonest(results, language)


def _commonest(results: Sequence[Result], language: str) -> Iterator[tuple[Cell, ...]]:
    """Go through the mistakes, the commonest first."""
    counted = Counter(name for result in results for name in result.mistakes)
    if counted:
        yield ()
        yield (texts(language)["class.commonest"],)
    for name, count in sorted(counted.items(), key=lambda item: (-item[1], item[0])):
        yield (f"{name}: {mistake_texts(language)[name]}", count)


def moodle_rows(results: Sequence[Result], language: str) -> Iterator[tuple[Cell, ...]]:
    """Go through the rows of a file that Moodle's gradebook imports: whose it is, the grade, the feedback."""
    yield ("ID number", "Full name", "Email address", "Grade", "Feedback comments")
    for result in results:
        if result.mark is not None:
            who = result.who
            yield (who.number or who.book, who.student, who.email, result.mark, _feedback(result, language))


def _feedback(result: Result, language: str) -> str:
    """Return a line for the student, without right numbers."""
    said = texts(language)
    counts = (f"{said[f'verdict.{name}']} {count}" for name, count in result.counts.items() if count)
    first = said["class.feedback_first"].format(symbol=result.first) if result.first else said["report.no_wrong"]
    return f"{', '.join(counts)}. {first}"


def summary(results: Sequence[Result], language: str) -> str:
    """Return a line on the whole class."""
    said = texts(language)
    marks = [result.mark for result in results if result.mark is not None]
    mean = sum(marks) / len(marks) if marks else 0.0
    return said["class.summary"].format(n=len(results), marked=len(marks), mean=_number(f"{mean:.1f}", language))


def class_lines(results: Sequence[Result], absent: Sequence[Entry], language: str) -> Iterator[str]:
    """Go through what is printed of a class: a line per student, those without answers, then the whole."""
    said = texts(language)
    width = max((len(_called(result)) for result in results), default=0)
    for result, flags in zip(results, flags_of(results, language), strict=True):
        mark = "–" if result.mark is None else _number(f"{result.mark:g}", language)
        missing = result.counts.get(str(Verdict.MISSING), 0)
        told = [result.first and said["class.feedback_first"].format(symbol=result.first)]
        told += [f"{said['verdict.missing']} {missing}"] if missing else []
        told += [", ".join(result.mistakes), *flags, *_noted(result, said)]
        yield f"{_called(result):{width}}  {mark:>5}  {'  '.join(filter(None, told))}".rstrip()
    yield from (f"{entry.who.student:{width}}  {'–':>5}  {said['class.absent']}" for entry in absent)
    yield summary(results, language)


def _noted(result: Result, said: Mapping[str, str]) -> Sequence[str]:
    """Return why there is no mark; where there is one, how many notes the report has, and the file they are on."""
    if result.mark is None or not result.notes:
        return result.notes
    return [said["class.notes"].format(n=len(result.notes), file=result.source)]


def _number(text: str, language: str) -> str:
    """Return a number with the decimal sign of the language, as the files have it."""
    return text if language == "en" else text.replace(".", ",")


def _called(result: Result) -> str:
    return result.who.student or result.source
