"""Numbers as people write them: decimal comma or point, a typographic minus, thousands apart by spaces."""

from __future__ import annotations

import math
import re

from .errors import InputError, Written

# Ordinary, no-break, figure, thin and narrow no-break space: all of them come out of word processors.
SPACES = " \u00a0\u2007\u2009\u202f"
_GROUPED = rf"[0-9]{{1,3}}(?:[{SPACES}][0-9]{{3}})+(?![0-9])"
_NUMBER = re.compile(
    rf"[+\-\u2212\u2013]?(?:(?:{_GROUPED}|[0-9]+)(?:[.,][0-9]*)?|[.,][0-9]+)(?:[eE][+\-\u2212]?[0-9]+)?"
)
_SIGNS, _RAISED = "0123456789+-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻"
_TIMES_TEN = re.compile(  # 7,31·10², 7,31*10^2, 7,31 х 10**2: the power of ten that stands behind a number
    rf"(?<=[0-9.,])[{SPACES}]*[*·⋅×∙•xх][{SPACES}]*10"
    rf"(?:(?:\^|\*\*)(?P<open>\()?(?P<flat>[+\-\u2212\u2013]?[0-9]{{1,3}})(?(open)\))|(?P<raised>[{_RAISED}]{{1,4}}))(?![0-9])"
)
_UNDER = re.compile(r"\s*/\s*([1-9][0-9]*)(?![0-9.,])")  # what makes a fraction of a whole number
SHOWN = 200  # characters of a path, a reason or a list in a message
TIE = 1e-14  # part of a number by which arithmetic may leave it below a half
_PLAIN = str.maketrans({"\u2212": "-", "\u2013": "-", ",": ".", **dict.fromkeys(SPACES)})


def rounded(value: float, decimals: int) -> float:
    """Return a number with so many decimals, rounded as usual: a half goes up in size.

    >>> rounded(0.2875, 3), rounded(-2.5, 0), rounded(115.0 * 0.0025, 3)
    (0.288, -3.0, 0.288)
    """
    return float(round(float(value) * (1.0 + TIE), decimals))


def quote(text: object, longest: int = 40) -> Written:
    """Return `text` fit for one line of a message: at most `longest` characters, none of them a control character."""
    line = "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in str(text)[: longest + 1])
    return Written(line if len(line) <= longest else line[: longest - 1] + "…")


def _e(found: re.Match[str]) -> str:
    """Return a power of ten as a calculator writes it."""
    return f"e{(found['flat'] or found['raised'].translate(str.maketrans(_RAISED, _SIGNS))).translate(_PLAIN)}"


def with_power(text: str) -> str:
    """Return a text with the power of ten of its number behind an `e`.

    >>> with_power("7,31·10² Н"), with_power("1,2 * 10^(-3) м"), with_power("7,31·102")
    ('7,31e2 Н', '1,2e-3 м', '7,31·102')
    """
    return _TIMES_TEN.sub(_e, text, count=1) if "10" in text else text


def split_number(text: str) -> tuple[float, str]:
    """Return the number that `text` begins with, and the rest of it without the spaces around.

    A comma is always a decimal comma (`1,500` is one and a half), spaces part only whole groups of three digits; two
    whole numbers with a slash between are a fraction; a power of ten may stand behind it (`7,31·10²`).

    Raises
    ------
    InputError
        When there is no number, or none that a float can hold (`nan`, `inf`, `1e400`).

    >>> split_number("55,5мм")
    (55.5, 'мм')
    >>> split_number("−1 500 Н")
    (-1500.0, 'Н')
    >>> split_number("1/4")
    (0.25, '')
    >>> split_number("7,31·10² Н")
    (731.0, 'Н')
    """
    stripped = text.strip()
    if not stripped:
        raise InputError("number-empty")
    written = with_power(stripped)
    found = _NUMBER.match(written)
    if found is None:
        raise InputError("number-bad", text=quote(stripped))
    rest = written[found.end() :].strip()
    under = _UNDER.match(rest) if found.group().isdigit() else None
    if under is not None:
        rest = rest[under.end() :].strip()
    # A second number ("55 5", "1,500.5") would otherwise be taken for a unit.
    if (rest[:1].isdigit() and not rest.startswith("1/")) or rest[:1] in {".", ","}:
        raise InputError("number-bad", text=quote(stripped))
    plain = found.group().translate(_PLAIN)
    value = float(plain) if under is None else float(plain) / float(under[1])
    vanished = value == 0.0 and any(digit in "123456789" for digit in re.split("[eE]", plain)[0])
    if vanished or not math.isfinite(value):
        raise InputError("number-infinite", text=quote(stripped))
    return value, rest
