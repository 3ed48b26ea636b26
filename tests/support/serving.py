"""A server to be asked without a network, and one that is a process of its own."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from starlette.testclient import TestClient

from kulman.variants.serving.app import _application
from kulman.variants.serving.desk import Desk
from kulman.variants.serving.safety import Doors


@contextmanager
def asked(doors: Doors, **how: Any) -> Iterator[TestClient]:
    desk = Desk(doors, how.pop("allowed", "forms"), how.pop("language", "en"), seats=1)
    root = f"http://127.0.0.1{doors.root}"
    with TestClient(_application(desk), base_url=root, follow_redirects=False, **how) as client:
        client.app_state = {"desk": desk}
        yield client


@contextmanager
def served(*options: str, **how: Any) -> Iterator[tuple[str, subprocess.Popen[str]]]:
    """Start `kulman serve` and go on with its address."""
    words = [sys.executable, "-m", "kulman", "serve", "--port", "0", "--lang", "uk", *options]
    environment = {**os.environ, "KULMAN_CONFIG": ""}
    with subprocess.Popen(
        words, stdout=subprocess.PIPE, text=True, encoding="utf-8", env=environment, **how
    ) as process:
        assert process.stdout is not None
        try:
            found = re.search(r"http://\S+", process.stdout.readline())
            assert found
            yield found[0], process
        finally:
            process.terminate()
            process.wait(20)
