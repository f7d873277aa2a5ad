"""The notebook examples/notebooks/train_a_policy.py, executed in short form."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from PIL import Image

from uwsim.results.result import Result

NOTEBOOKS = Path(__file__).parents[2] / "examples" / "notebooks"
CONSTANTS = "STEPS, SEEDS, N_IMAGES = 500_000, range(6), 50"
SHORT = "STEPS, SEEDS, N_IMAGES = 8_192, range(1), 2"


def run_notebook(
    name: str, replacements: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> tuple[dict[str, Any], list[Any]]:
    """Execute a notebook in its folder; return its variables, and what it displays."""
    displayed: list[Any] = []
    ipython, display = ModuleType("IPython"), ModuleType("IPython.display")
    ipython.get_ipython = lambda: None  # type: ignore[attr-defined]  # matplotlib asks for it
    ipython.version_info = (9, 0)  # type: ignore[attr-defined]
    display.display = displayed.append  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "IPython", ipython)
    monkeypatch.setitem(sys.modules, "IPython.display", display)
    monkeypatch.setattr(sys, "path", list(sys.path))
    monkeypatch.chdir(NOTEBOOKS)
    text = (NOTEBOOKS / name).read_text()
    for old, new in replacements.items():
        assert text.count(old) == 1
        text = text.replace(old, new)
    variables: dict[str, Any] = {"__name__": "__main__"}
    exec(compile(text, name, "exec"), variables)
    return variables, displayed


@pytest.mark.slow
def test_the_tutorial_trains_scores_and_shows_a_policy(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    replacements = {CONSTANTS: SHORT, "Path(tempfile.mkdtemp())": f"Path({str(tmp_path)!r})"}
    variables, displayed = run_notebook("train_a_policy.py", replacements, monkeypatch)
    printed = capsys.readouterr().out
    result: Result = variables["result"]  # of position-p, the last one
    by_hand = np.sqrt(np.mean(np.square(variables["distances_by_hand"])))
    assert re.findall(r"^(hand|trained|p) +\d\.\d{3} m$", printed, re.MULTILINE) == [
        "hand",
        "trained",
        "p",
    ]
    assert by_hand < 0.4  # [m]; a policy that does nothing drifts away by metres
    assert ": one repeat\n" in printed  # of one seed, by compare
    assert result.values("status") == ("ok",)
    assert "success: True" in printed.splitlines()[-4]  # the environment of one's own
    assert [type(each).__name__ for each in displayed if not isinstance(each, Image.Image)] == [
        "Figure",
        "Figure",
    ]
    images = [each for each in displayed if isinstance(each, Image.Image)]
    assert [np.asarray(image).std() > 20.0 for image in images] == [True, True]
    assert variables["record"]["instances"][0]["name"] == "blackbox"
