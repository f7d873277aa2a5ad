"""What `benchmarks/` measures can still be made; how fast it is, is measured there."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path

import numpy as np
import pytest

BENCHMARKS = Path(__file__).parents[1] / "benchmarks"


@pytest.fixture
def benchmarks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "path", [str(BENCHMARKS), *sys.path])


@pytest.mark.parametrize(
    "name", sorted(file.stem for file in BENCHMARKS.glob("*.py") if file.stem != "measure")
)
def test_a_benchmark_can_be_imported_and_has_something_to_run(benchmarks: None, name: str) -> None:
    assert callable(importlib.import_module(name).main)


def test_the_tank_of_the_physics_has_contacts_and_moves_on(benchmarks: None) -> None:
    _, water, data = importlib.import_module("physics").in_the_tank()
    assert data.ncon >= 4
    before = data.qpos.copy()
    water.step(data, 10)
    assert np.isfinite(data.qpos).all()
    assert (data.qpos != before).any()
