"""The table of writers, and how their files come into being: whole or not at all."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import suppress
from io import BytesIO
from pathlib import Path
from typing import BinaryIO, TypeAlias

from ..scales.errors import InputError
from ..scales.numbers import quote
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
SHOWN = 200  # characters of a path in a message


def writer_for(path: Path) -> Writer:
    """Return the writer that the suffix of `path` picks.

    Raises
    ------
    InputError
        Nothing writes such files.
    """
    writer = WRITERS.get(path.suffix.lower())
    if writer is None:
        raise InputError("output-suffix", file=quote(path, SHOWN), known=", ".join(WRITERS))
    return writer


def check_outputs(*paths: Path, known: Collection[str] = WRITERS) -> None:
    """Refuse, before any work, files that cannot be written; `known` are the suffixes that can.

    Raises
    ------
    InputError
        A suffix that nothing writes, a name that no file can have, a folder, a missing folder, a place that is
        protected, or the same file twice.
    """
    seen = set()
    for path in paths:
        shown = quote(path, SHOWN)
        if path.suffix.lower() not in known:
            raise InputError("output-suffix", file=shown, known=", ".join(known))
        if "\0" in str(path):
            raise InputError("output-name", file=shown)
        if path.is_dir():
            raise InputError("output-is-folder", file=shown)
        if not path.parent.is_dir():
            raise InputError("output-folder-missing", file=shown, folder=quote(path.parent, SHOWN))
        if not os.access(path if path.exists() else path.parent, os.W_OK):
            raise InputError("output-refused", file=shown, reason=os.strerror(errno.EACCES))
        place = os.path.normcase(os.path.abspath(path))
        if place in seen:
            raise InputError("output-twice", file=shown)
        seen.add(place)


def write_pages(pages: Sequence[Page], *paths: Path, tile: str | None = None) -> list[Path]:
    """Write pages to each of `paths`, or to one numbered file each where the format holds a single page.

    Parameters
    ----------
    pages : sequence of Page
    *paths : Path
        The suffix of each picks the writer.
    tile : str, optional
        Paper ("A4") on which the pages are spread at full size; for a PDF only.

    Returns
    -------
    list of Path
        The files written.

    Raises
    ------
    InputError
        A file cannot be written: then none is, unless the disk itself fails half-way.
    """
    check_outputs(*paths)
    # every file is made before the first is written: what cannot be drawn costs no older file
    files = [file for path in paths for file in _files(pages, path, tile)]
    check_outputs(*(path for path, _ in files))
    for path, data in files:
        write_whole(path, data)
    return [path for path, _ in files]


def _files(pages: Sequence[Page], path: Path, tile: str | None) -> Iterator[tuple[Path, bytes]]:
    """Make the files that `path` stands for: their names and what they hold."""
    writer = writer_for(path) if tile is None else _tiled(path, tile)
    parts: list[tuple[Path, Sequence[Page]]] = [(path, pages)]
    if path.suffix.lower() in ONE_PAGE and len(pages) > 1:
        numbered = enumerate(pages, start=1)
        parts = [(path.with_name(f"{path.stem}-{number}{path.suffix}"), [page]) for number, page in numbered]
    for target, some in parts:
        stream = BytesIO()
        writer(some, stream)
        yield target, stream.getvalue()


def _tiled(path: Path, paper: str) -> Writer:
    if path.suffix.lower() != ".pdf":
        raise InputError("tile-suffix", file=quote(path, SHOWN))

    def write(pages: Sequence[Page], stream: BinaryIO) -> None:
        from .tile import write_tiles

        write_tiles(pages, stream, paper)

    return write


def write_whole(path: Path, data: bytes) -> None:
    """Write a file beside `path` that takes its place when it is whole, and vanishes when anything fails.

    Raises
    ------
    InputError
        The file cannot be written.
    """
    beside = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with beside.open("xb") as stream:
            stream.write(data)
        os.replace(beside, path)
    except OSError as problem:
        raise InputError("output-refused", file=quote(path, SHOWN), reason=problem.strerror or "") from None
    finally:
        with suppress(OSError):
            beside.unlink()
