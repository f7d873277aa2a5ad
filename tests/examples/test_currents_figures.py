"""The figures of the currents experiment are drawn from what was simulated."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[2] / "examples" / "currents_figures.py"
PROGRESS = re.compile(r"\d+ of \d+ levels(, .* left)?$")


@pytest.mark.slow
def test_all_figures_of_the_currents_experiment_come_out_in_quick_mode(tmp_path: Path) -> None:
    command = [sys.executable, "-W", "error", str(SCRIPT), str(tmp_path), "--quick"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=110)
    # a slow machine reports its progress
    said = [line for line in done.stderr.splitlines() if not PROGRESS.search(line)]
    assert (done.returncode, said) == (0, [])
    drawn = sorted(path.name[:9] for path in tmp_path.glob("*.png"))
    assert drawn == [f"figure-{number:02}" for number in (2, 12, 13, 14, 15)]
