"""Draw the pictures of the README, fill in what commands of documents print: `.venv/bin/python docs/refresh.py`."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
READMES = tuple(ROOT / name for name in ("README.md", "README.uk.md", "README.ru.md"))
NAMES = ("accuracy", "cams", "commands", "cycle", "gears", "hoist")
GUIDES = tuple(sorted((ROOT / "variants" / "guides").glob("*.md")))
DOCUMENTS = (*READMES, *(ROOT / "docs" / f"{name}.md" for name in NAMES), *GUIDES)
PICTURES = ROOT / "docs" / "pictures"
CHARTS = {  # by picture: what is charted
    "accuracy": "madi-four-bar --chart accuracy",
    "stability": "nau-slider-crank -v example --set l_AB=52 --quantities V_B,a_B --chart stability",
    "depth": "scheme-09-shaper --chart depth",
    "cam-sections": "madi-cam --chart sections",
    "cam-accuracy": "madi-cam --chart accuracy",
    "cam-stability": "madi-cam --chart stability",
    "hoist-accuracy": "karpenko-hoist --chart accuracy",
    "hoist-stability": "karpenko-hoist -v V10 --chart stability",
    "hoist-depth": "karpenko-hoist -v V09 --chart depth",
    "hoist-choice": "karpenko-hoist -v V03 --chart choice",
}
SHEETS = {  # by picture: what is drawn
    "nau-slider-crank-3": "nau-slider-crank -v 3 --student 'І. Петренко' --group АТ-301 --designation ТММ.РГР.03.01",
    "madi-cam": "madi-cam --lang ru",
    "madi-gear": "madi-gear --format A1 --lang ru",
}
BLOCK = re.compile(r"```console\n(.*?)```", re.DOTALL)


def commands(block: str) -> list[str]:
    """Return the command lines of a console block."""
    return [line.removeprefix("$ ") for line in block.splitlines() if line.startswith("$ ")]


def language(document: Path) -> str:
    """Return the language of a document: `marking.uk.md` is Ukrainian, what says none is English."""
    return document.stem.partition(".")[2] or "en"


def locale(language: str) -> str:
    """Return what a system in a language says of itself."""
    return {"en": "en_GB.UTF-8", "uk": "uk_UA.UTF-8", "ru": "ru_UA.UTF-8"}[language]


def run(command: str, folder: str, language: str = "en") -> tuple[str, int]:
    """Run one `kulman ...` line in `folder`, in a system in `language`; return what it prints, and its status."""
    words = [sys.executable, "-m", *shlex.split(command)]
    environment = {**os.environ, "LC_ALL": locale(language), "PYTHONIOENCODING": "utf-8", "KULMAN_CONFIG": ""}
    done = subprocess.run(
        words,
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        check=False,
    )
    return done.stdout, done.returncode


def filled(block: str, folder: str, language: str = "en") -> str:
    """Return a console block with what its commands print today."""
    return "".join(f"$ {command}\n{run(command, folder, language)[0]}" for command in commands(block))


def refreshed(text: str, folder: str, language: str = "en") -> str:
    """Return a document with what its commands, one after the other in `folder`, print today."""
    return BLOCK.sub(lambda found: f"```console\n{filled(found[1], folder, language)}```", text)


def main() -> None:
    """Rewrite the blocks of the documents and the pictures."""
    for document in DOCUMENTS:
        with tempfile.TemporaryDirectory() as folder:
            text = refreshed(document.read_text(encoding="utf-8"), folder, language(document))
            document.write_text(text, encoding="utf-8")
    for name, task in SHEETS.items():
        with tempfile.TemporaryDirectory() as folder:
            run(f"kulman sheet {task} -o sheet.pdf", folder)
            picture(Path(folder) / "sheet.pdf", PICTURES / f"{name}.png")
    charts()


def charts() -> None:
    """Draw the charts of docs/accuracy.md, docs/cams.md and docs/hoist.md."""
    from PIL import Image

    for name, task in CHARTS.items():
        with tempfile.TemporaryDirectory() as folder:
            run(f"kulman chart {task} --lang en -o chart.png", folder)
            with Image.open(Path(folder) / "chart.png") as drawn:
                size = 1400, round(1400 * drawn.height / drawn.width)
                grey = drawn.convert("L").resize(size, Image.Resampling.LANCZOS)
                grey.quantize(16).save(PICTURES / f"chart-{name}.png", optimize=True)


def picture(pdf: Path, png: Path) -> None:
    """Render the first page, small enough for a README."""
    import pypdfium2

    png.parent.mkdir(exist_ok=True)
    page = pypdfium2.PdfDocument(pdf)[0]
    page.render(scale=1.0, grayscale=True).to_pil().quantize(16).save(png, optimize=True)


if __name__ == "__main__":
    main()
