"""Small geometry for judging plans: lines through points, closed chains of vectors."""

from collections.abc import Iterator

from kulman.tests.support.readback import Vec, cross, parallel

NEAR = 0.01  # mm and degrees


def on(ends: tuple[complex, ...], point: complex) -> bool:
    a, b = ends
    e = (b - a) / abs(b - a)
    return abs(cross(e, point - a)) < NEAR


def past(ends: tuple[complex, ...], point: complex, by: float) -> bool:
    """Whether the line contains the point and runs past it on at least one side by so much."""
    a, b = ends
    along = ((point - a) / (b - a)).real * abs(b - a)
    return on(ends, point) and -NEAR < along < abs(b - a) + NEAR and max(along, abs(b - a) - along) >= by


def along(ends: tuple[complex, ...], direction: complex) -> bool:
    return parallel(ends[1] - ends[0], direction) or parallel(ends[0] - ends[1], direction)


def crosses(one: tuple[complex, ...], other: tuple[complex, ...]) -> bool:
    """Whether two lines cross."""
    ways = ((one, other), (other, one))
    return all(cross(b - a, p - a) * cross(b - a, q - a) < 0 for (a, b), (p, q) in ways)


def runs_along(line: tuple[complex, ...], a: complex, b: complex, spare: float) -> bool:
    """Whether a line, or the piece of it between circles on it, runs along the middle of the side a-b."""
    e = (b - a) / abs(b - a)
    low, high = sorted(((end - a) / e).real for end in line)
    near = all(abs(((end - a) / e).imag) < NEAR for end in line)
    return near and low <= abs(b - a) / 2 + spare and high >= abs(b - a) / 2 - spare and high - low > spare


def closed_chain(vectors: list[Vec]) -> list[Vec] | None:
    """Order vectors tip to tail round a closed polygon, or tell that there is none."""
    left = [v for v in vectors if abs(v.span) > 0.02]
    ordered = left[:1]
    while len(ordered) < len(left):
        follows = [v for v in left if v not in ordered and same(v.tail, ordered[-1].tip, 0.02)]
        if not follows:
            return None
        ordered.append(follows[0])
    return ordered if same(ordered[-1].tip, ordered[0].tail, 0.02) else None


def unless(good: bool, fault: str) -> Iterator[str]:
    """Yield the fault unless all is well."""
    if not good:
        yield fault


def same(a: complex, b: complex, within: float = NEAR) -> bool:
    return abs(a - b) <= within
