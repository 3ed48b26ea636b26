"""The table of writers, and how their files come into being: whole or not at all."""

from __future__ import annotations

import errno
import os
import re
import time
import zipfile
import zlib
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from importlib import import_module
from io import BytesIO
from pathlib import Path
from typing import BinaryIO, TypeAlias

from ..scales.choices import SHEETS
from ..scales.errors import InputError, KeptError
from ..scales.names import of_kind
from ..scales.numbers import SHOWN, quote
from .page import Page

Writer: TypeAlias = Callable[[Sequence[Page], BinaryIO], None]
Files: TypeAlias = Iterable[tuple[Path, bytes]]


def _by_module(kind: str, pages: Sequence[Page], stream: BinaryIO) -> None:
    """Write pages as the module for the kind of file does, which is loaded now; a PNG is a picture of a PDF."""
    module = import_module(".pdf" if kind == "png" else f".{kind}", __package__)
    (module.write_png if kind == "png" else module.write)(pages, stream)


WRITERS: dict[str, Writer] = {f".{kind}": partial(_by_module, kind) for kind in SHEETS}
SUFFIXES = tuple(WRITERS)
SEVERAL = (".pdf",)  # hold several pages; of other kinds they become x-1.svg, x-2.svg, ...
PART = ".part"  # ends the names of files that are not whole yet
PAUSES = (0.05, 0.1, 0.2, 0.4) if os.name == "nt" else ()  # seconds between attempts
_LEFT = re.compile(r"\.(.+)\.\d+\.part")
# how drawings and charts begin, pages of these and of notes; what an office program says when it has saved a file
_SVG = (
    b'<?xml version="1.0" encoding="UTF-8"?>\n<svg base',
    b'<?xml version="1.0" encoding="utf-8" standalone="no"?>\n<!D',
)
_PDF = re.compile(rb"%PDF-1\.\d\n%(?:.{5}ReportLab|\xac\xdc \xab\xba|\x80\x80\x80\x80)")
_SAVED = re.compile(rb"<dcterms:modified[^>]*>(?!2000-01-01T)")
LARGEST = 100_000  # bytes of what an office program says of a file
LONGEST = 120  # bytes of a name within that of a file: systems take 255 for the whole


def check_outputs(*paths: Path, known: Collection[str] = WRITERS) -> None:
    """Refuse, before any work, with an InputError what cannot be written; `known` are the suffixes that can.

    That is another suffix, a name that no file can have, a folder or none, a protected place, the same file twice; a
    file that another program has made or changed, with a KeptError.
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
        if is_of_others(path):
            raise KeptError("output-of-others", file=shown)


def is_of_others(path: Path) -> bool:
    """Tell whether there is a file with something in it that is not as this program has written it.

    Of kinds that look alike whoever has written them, PNG, CSV, JSON, HTML and other text, none is.
    """
    if not path.is_file() or not path.stat().st_size:
        return False
    data = path.read_bytes()
    match path.suffix.lower():
        case ".svg":
            return not data[:400].replace(b"\r\n", b"\n").startswith(_SVG)
        case ".pdf":
            return not _PDF.match(data) or data.count(b"%%EOF") != 1
        case ".dxf":
            return re.search(rb"\$LASTSAVEDBY\s+1\s+ezdxf\s", data) is None
        case ".xlsx" | ".docx" | ".ggb":
            try:
                with zipfile.ZipFile(BytesIO(data)) as parts:
                    if path.suffix.lower() == ".ggb":
                        return parts.namelist() != ["geogebra.xml"]
                    with parts.open("docProps/core.xml") as part:
                        return _SAVED.search(part.read(LARGEST)) is not None
            except (zipfile.BadZipFile, KeyError, OSError, NotImplementedError, RuntimeError, zlib.error, EOFError):
                return True
    return False


def save_all(
    paths: Iterable[str | os.PathLike[str]], known: Collection[str], make: Callable[[Path], Files]
) -> list[Path]:
    """Save something to each of `paths`, whose suffixes are `known`; return the files written.

    `make` returns the files that a path stands for, one or several: their names and what they hold. Where one path is
    of a wrong kind, or one file cannot be written, none is, and an InputError says so.
    """
    wanted = []
    for path in paths:
        of_kind("paths", path, (str, os.PathLike), "str | PathLike")
        wanted.append(Path(path))
    check_outputs(*wanted, known=known)
    # every file is made before the first is written: what cannot be drawn costs no older file
    files = [file for path in wanted for file in make(path)]
    check_outputs(*(path for path, _ in files), known=known)
    _write(files)
    return [path for path, _ in files]


def page_files(pages: Sequence[Page], path: Path, tile: str | None = None) -> Iterator[tuple[Path, bytes]]:
    """Make the files of pages that `path` stands for: their names and what they hold."""
    writer = WRITERS[path.suffix.lower()]
    if tile is not None:
        if path.suffix.lower() != ".pdf":
            raise InputError("tile-suffix", file=quote(path, SHOWN))
        from .pdf import write_tiles

        writer = partial(write_tiles, paper=tile)
    parts: list[tuple[Path, Sequence[Page]]] = [(path, pages)]
    if path.suffix.lower() not in SEVERAL and len(pages) > 1:
        numbered = enumerate(pages, start=1)
        parts = [(path.with_name(f"{path.stem}-{number}{path.suffix}"), [page]) for number, page in numbered]
    for target, some in parts:
        stream = BytesIO()
        writer(some, stream)
        yield target, stream.getvalue()


def slug(name: str) -> str:
    """Return a name fit for a file on any system, in its own letters.

    >>> slug("О'Коннор, І. / 3"), slug("..")
    ('О-Коннор-І-3', 'x')
    """
    plain = re.sub(r"[^\w]+", "-", name).strip("-_").encode("utf-8", "ignore")[:LONGEST]
    return plain.decode("utf-8", "ignore").strip("-_") or "x"


def folder_for(folder: str | os.PathLike[str]) -> Path:
    """Return a folder for files, made where it is missing; an InputError says why it cannot be made."""
    of_kind("folder", folder, (str, os.PathLike), "str | PathLike")
    path = Path(folder)
    try:
        path.mkdir(parents=True, exist_ok=True)
    except FileExistsError:
        raise InputError("output-not-folder", file=quote(path, SHOWN)) from None
    except (OSError, ValueError) as problem:
        reason = getattr(problem, "strerror", "") or ""
        raise InputError("output-refused", file=quote(path, SHOWN), reason=reason) from None
    return path


def write_whole(path: Path, data: bytes) -> None:
    """Write a file that takes its place when it is whole, or raise an InputError and leave the place as it is."""
    _write([(path, data)])


def _write(files: Files) -> None:
    """Write each file beside its place; they take their places when all are whole, and vanish when anything fails."""
    waiting: list[tuple[Path, Path]] = []
    try:
        for path, data in files:
            beside = path.with_name(f".{path.name}.{os.getpid()}{PART}")
            waiting.append((beside, path))
            with refused(path):
                beside.unlink(missing_ok=True)  # of a killed run that had the same number
                with beside.open("xb") as stream:
                    stream.write(data)
        for beside, path in waiting:
            with refused(path):
                _replace(beside, path)
    finally:
        for beside, _ in waiting:
            with suppress(OSError):
                beside.unlink()


def _replace(beside: Path, path: Path) -> None:
    """Put a whole file in its place; on Windows a scanner of viruses may keep the new one for a moment."""
    for pause in PAUSES:
        try:
            return os.replace(beside, path)
        except PermissionError:
            time.sleep(pause)
    return os.replace(beside, path)


def sweep_parts(folder: Path, own: Callable[[str], bool]) -> None:
    """Remove what killed runs have left half-written of the files whose names are their `own`."""
    with suppress(OSError):
        for path in folder.glob(f".*{PART}"):
            name = _LEFT.fullmatch(path.name)
            if name is not None and own(name[1]):
                with suppress(OSError):
                    path.unlink()


@contextmanager
def refused(path: Path) -> Iterator[None]:
    """Raise what the system says of a file that it refuses to write as an InputError that names the file."""
    try:
        yield
    except OSError as problem:
        raise InputError("output-refused", file=quote(path, SHOWN), reason=problem.strerror or "") from None
