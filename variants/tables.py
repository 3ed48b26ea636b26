"""Rows as lines of aligned text."""

from __future__ import annotations

from collections.abc import Container, Sequence


def aligned(rows: Sequence[Sequence[str]], left: Container[int] = (0,)) -> str:
    """Return rows as lines, the columns that `left` names to the left, the others to the right.

    A row may have fewer cells than others.
    """
    widths = [max(len(row[i]) for row in rows if i < len(row)) for i in range(max(map(len, rows)))]

    def cell(text: str, i: int) -> str:
        return f"{text:{widths[i]}}" if i in left else f"{text:>{widths[i]}}"

    return "\n".join("  ".join(cell(text, i) for i, text in enumerate(row)).rstrip() for row in rows)
