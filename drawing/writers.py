"""The table of writers, and how their files come into being: whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO, TypeAlias

from ..scales.errors import InputError
from .page import Page

Writer: TypeAlias = Callable[[Sequence[Page], BinaryIO], None]


def _svg(pages: Sequence[Page], stream: BinaryIO) -> None:
    from .svg import write_svg

    write_svg(pages[0], stream)


def _pdf(pages: Sequence[Page], stream: BinaryIO) -> None:
    from .pdf import write_pdf

    write_pdf(pages, stream)


def _png(pages: Sequence[Page], stream: BinaryIO) -> None:
    from .png import write_png

    write_png(pages, stream)


WRITERS: dict[str, Writer] = {".svg": _svg, ".pdf": _pdf, ".png": _png}
ONE_PAGE = {".svg", ".png"}  # several pages become x-1.svg, x-2.svg, ...


def writer_for(path: Path) -> Writer:
    """Return the writer that the suffix of `path` picks.

    Raises
    ------
    InputError
        Nothing writes such files.
    """
    writer = WRITERS.get(path.suffix.lower())
    if writer is None:
        raise InputError("output-suffix", file=str(path), known=", ".join(WRITERS))
    return writer


def write_pages(pages: Sequence[Page], path: Path, tile: str | None = None) -> list[Path]:
    """Write pages to `path`, or to one numbered file each where the format holds a single page.

    Parameters
    ----------
    pages : sequence of Page
    path : Path
        Its suffix picks the writer.
    tile : str, optional
        Paper ("A4") on which the pages are spread at full size; for a PDF only.

    Returns
    -------
    list of Path
        The files written.

    Raises
    ------
    InputError
        The suffix is unknown, or the file cannot be written.
    """
    writer = writer_for(path)
    if tile is not None:
        writer = _tiled(path, tile)
    parts: list[tuple[Path, Sequence[Page]]] = [(path, pages)]
    if path.suffix.lower() in ONE_PAGE and len(pages) > 1:
        numbered = enumerate(pages, start=1)
        parts = [(path.with_name(f"{path.stem}-{number}{path.suffix}"), [page]) for number, page in numbered]
    for target, some in parts:
        with replacing(target) as stream:
            writer(some, stream)
    return [target for target, _ in parts]


def _tiled(path: Path, paper: str) -> Writer:
    if path.suffix.lower() != ".pdf":
        raise InputError("tile-suffix", file=str(path))

    def write(pages: Sequence[Page], stream: BinaryIO) -> None:
        from .tile import write_tiles

        write_tiles(pages, stream, paper)

    return write


@contextmanager
def replacing(path: Path) -> Iterator[BinaryIO]:
    """Open a file beside `path` that takes its place when all is written, and vanishes when anything fails."""
    beside = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        stream = beside.open("xb")
    except OSError as problem:
        raise InputError("output-refused", file=str(path), reason=problem.strerror or "") from None
    try:
        with stream:
            yield stream
        os.replace(beside, path)
    except OSError as problem:
        raise InputError("output-refused", file=str(path), reason=problem.strerror or "") from None
    finally:
        with suppress(OSError):
            beside.unlink()
