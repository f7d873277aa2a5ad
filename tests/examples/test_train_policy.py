"""The training of examples/train_policy.py, in short form."""

from __future__ import annotations

import runpy
from pathlib import Path

import numpy as np
import pytest

import uwsim

SCRIPT = Path(__file__).parents[2] / "examples" / "train_policy.py"


@pytest.mark.slow
def test_twelve_generations_improve_a_policy_that_the_benchmark_then_scores(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    weights, returns = runpy.run_path(str(SCRIPT))["train"](12, 0)
    assert np.mean(returns[-3:]) > np.mean(returns[:3]) + 50.0
    monkeypatch.chdir(tmp_path)
    np.save("policy.npy", weights)
    result = uwsim.bench("station-keeping", algorithm=f"{SCRIPT}:Policy", levels={"current": [0.0]})
    assert result.values("status") == ("ok",)
