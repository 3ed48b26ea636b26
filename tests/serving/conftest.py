"""A server that is asked without a network."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from starlette.testclient import TestClient

from kulman.tests.support.serving import asked
from kulman.variants.serving.safety import doors_for


@pytest.fixture(scope="session")
def client() -> Iterator[TestClient]:
    with asked(doors_for("127.0.0.1", (), None)) as found:
        yield found
