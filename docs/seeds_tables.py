"""Fill in what `kulman check TASK printed` says, line by line: `.venv/bin/python docs/seeds_tables.py`."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

DOCUMENT = Path(__file__).resolve().parent / "seeds.md"
TABLE = re.compile(r"(<!-- (\S+): ([\w, ]+) -->\n)(.*?)(<!-- end -->)", re.DOTALL)
ROW = re.compile(r"^\| (\w+) \|.*\| ([^|]*) \|$", re.MULTILINE)


def marked(task: str, preset: str) -> dict[str, dict[str, object]]:
    """Return the lines of a check by their quantities, those answered."""
    command = [sys.executable, "-m", "kulman", "check", task, "printed", "--preset", preset, "--lang", "en", "--json"]
    done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", check=True)
    return {line["quantity"]: line for line in json.loads(done.stdout)["lines"] if line["verdict"] != "missing"}


def table(task: str, presets: list[str], reasons: dict[str, str]) -> str:
    """Return the table of a task: what is printed, what is right, the verdicts, and why."""
    by_preset = {preset: marked(task, preset) for preset in presets}
    rows = ["| quantity | printed | right | " + " | ".join(f"`{preset}`" for preset in presets) + " | why |"]
    rows.append("|---" * (len(presets) + 4) + "|")
    for name, line in by_preset[presets[0]].items():
        verdicts = " | ".join(str(by_preset[preset][name]["verdict"]) for preset in presets)
        rows.append(f"| {name} | {line['answer']} | {line['shown']} | {verdicts} | {reasons.get(name, '')} |")
    return "\n".join(rows) + "\n"


def filled(text: str) -> str:
    """Return the document with its tables as they are today; the reasons stay."""

    def again(found: re.Match[str]) -> str:
        reasons = {name: why.strip() for name, why in ROW.findall(found[4])}
        return f"{found[1]}{table(found[2], found[3].split(', '), reasons)}{found[5]}"

    return TABLE.sub(again, text)


if __name__ == "__main__":
    DOCUMENT.write_text(filled(DOCUMENT.read_text(encoding="utf-8")), encoding="utf-8")
