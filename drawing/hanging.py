"""Where the views of a page of rows stand: what is left empty is shared out evenly."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from .rows import Column, Edge, Leaf, Room, Row, Size

SINK = 12.0  # mm that a layer may move away from the one above it


def hang(
    rows: Sequence[Row], room: Room, views: Sequence[Sequence[Size]], gap: float
) -> Iterator[tuple[Leaf, float, float]]:
    """Yield each view with its lower left corner, from the lower left corner of the room."""
    over = room.over + gap if room.over and rows[0].head == Edge() else 0.0
    under = room.under + gap if room.under and rows[-1].tail == Edge() else 0.0
    free = room.height - over - under - gap * (len(rows) - 1)
    space = max(0.0, free - sum(row.height for row in rows)) / (len(rows) + 1)
    # The space itself keeps the rows clear of the corners, so that the first and the last row need less.
    space = max(0.0, free - sum(_height(row, space, gap) for row in rows)) / (len(rows) + 1)
    top = room.height - over
    for row in rows:
        top -= space
        height = _height(row, space, gap)
        yield from _row(row, top, height, space, room, views, gap)
        top -= height + gap


def _inset(edge: Edge, space: float, gap: float) -> float:
    """How far a column keeps away from the row's outer line because of the box over or under it."""
    return max(0.0, edge.box[1] + gap - space) if edge.box[1] else 0.0


def _height(row: Row, space: float, gap: float) -> float:
    columns = row.columns
    tall = [column.height for column in columns]
    tall[0] += _inset(row.head, space, gap)
    tall[-1] += _inset(row.tail, space, gap)
    return max(*tall, row.head.height - space, row.tail.height - space)


def _row(
    row: Row, top: float, height: float, space: float, room: Room, views: Sequence[Sequence[Size]], gap: float
) -> Iterator[tuple[Leaf, float, float]]:
    columns, left = row.columns, row.head.left + row.tail.left
    widths = [column.width for column in columns]
    widths[0], widths[-1] = max(widths[0], row.head.box[0]), max(widths[-1], row.tail.box[0])
    right = room.width - row.head.right - row.tail.right
    share = (right - left - sum(widths) - gap * (len(columns) - 1)) / (len(columns) + 1)
    x = left + share
    for n, (column, width) in enumerate(zip(columns, widths, strict=True)):
        head = _inset(row.head, space, gap) if n == 0 else 0.0
        tail = _inset(row.tail, space, gap) if n == len(columns) - 1 else 0.0
        yield from _column(column, x, top - head, width, height - head - tail, views, gap)
        x += width + gap + share


def _column(
    column: Column, x: float, top: float, width: float, height: float, views: Sequence[Sequence[Size]], gap: float
) -> Iterator[tuple[Leaf, float, float]]:
    sink = min(SINK, max(0.0, height - column.height) / len(column.layers))
    for layer in column.layers:
        sizes = [views[i][k] for i, k in layer]
        share = (width - sum(w for w, _ in sizes) - gap * (len(sizes) - 1)) / (len(sizes) + 1)
        left = x + share
        for leaf, (w, h) in zip(layer, sizes, strict=True):
            yield leaf, left, top - h
            left += w + gap + share
        top -= max(h for _, h in sizes) + gap + sink
