"""docs/your-own-vehicle.md does what it says: its files are written, its program run."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

from uwsim.dialect import slots
from uwsim.physics.vehicle_file import BodyElement, HydrodynamicsElement, ThrusterElement

PAGE = Path(__file__).parents[2] / "docs" / "your-own-vehicle.md"


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", PAGE.read_text(), re.MULTILINE | re.DOTALL)


def test_a_newcomers_vehicle_swims_as_the_page_shows(tmp_path: Path) -> None:
    robot, water = blocks("xml")
    (tmp_path / "my_rov.urdf").write_text(robot)
    (tmp_path / "my_rov.xml").write_text(water)
    (tmp_path / "swim.py").write_text("".join(blocks("python")))
    done = subprocess.run(
        [sys.executable, "swim.py"],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(PAGE.parents[1] / "src")},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout in blocks("text")


def test_the_page_names_every_element() -> None:
    text = PAGE.read_text()
    for element in (BodyElement, ThrusterElement, HydrodynamicsElement):
        for slot in slots(element):
            assert (
                f"`{slot.shown}`" in text
                or f"<{slot.shown}" in text
                or (f'{slot.shown}="..."' in text)
            ), slot.shown
