"""A suite of short tasks, and two entries, which tests copy before they change them."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.support.small_suite import run_suite, write_suite
from uwsim.suites.suite import Suite, read_suite


@pytest.fixture(scope="session")
def small_suite(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_suite(tmp_path_factory.mktemp("suite"))


@pytest.fixture(scope="session")
def suite(small_suite: Path) -> Suite:
    return read_suite(small_suite)


@pytest.fixture(scope="session")
def stored_entries(small_suite: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with entries of the algorithms position-p and nothing, seeds 0 to 2."""
    folder = tmp_path_factory.mktemp("entries")
    for name in ("position-p", "nothing"):
        run_suite(small_suite, folder / name, "--algorithm", name, "--seeds", "3")
    return folder


@pytest.fixture
def entries(stored_entries: Path, tmp_path: Path) -> Path:
    """A copy of the entries, which a test may change."""
    return Path(shutil.copytree(stored_entries, tmp_path / "entries"))
