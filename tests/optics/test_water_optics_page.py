"""The page docs/water-optics.md: its programs run, its tables are those of the package."""

from __future__ import annotations

import contextlib
import io
import re
from pathlib import Path

import pytest

from uwsim.optics import WATERS, FournierForand, HenyeyGreenstein, PhaseFunction

PAGE = (Path(__file__).parents[2] / "docs" / "water-optics.md").read_text()
BLOCK = re.compile(r"^```python\n(.*?)^```", re.MULTILINE | re.DOTALL)
OUTPUT = re.compile(r"^```text\n(.*?)^```", re.MULTILINE | re.DOTALL)
ROW = re.compile(r"^\| `([^`]+)` \| ([^|]+) \| ([^|]+) \| ([^|]+) \|$", re.MULTILINE)


def test_the_programs_of_the_page_run_and_print_what_it_shows() -> None:
    names: dict[str, object] = {}
    output = io.StringIO()
    for program in BLOCK.findall(PAGE):
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            exec(program, names)
    assert output.getvalue() == OUTPUT.findall(PAGE)[0]


def test_the_table_of_waters_is_that_of_the_package() -> None:
    rows = {
        name: (description, absorption, scattering)
        for name, description, absorption, scattering in ROW.findall(PAGE)
    }
    expected = {
        name: (
            water.description,
            ", ".join(f"{value:g}" for value in water.absorption),
            ", ".join(f"{value:g}" for value in water.scattering),
        )
        for name, water in WATERS.items()
    }
    assert rows == expected


@pytest.mark.parametrize("phase", [FournierForand(), HenyeyGreenstein(0.9)], ids=str)
def test_the_numbers_of_phase_functions_are_those_of_the_package(phase: PhaseFunction) -> None:
    share = 100.0 * float(phase.compute_cumulative(0.017453292519943295))
    numbers = f"| {phase.backscatter_ratio:.4f} | {phase.mean_cosine:.3f} | {share:.2g} % |"
    assert numbers in PAGE
