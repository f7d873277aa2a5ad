"""Every numbered example runs as it stands and prints what the file beside it says."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"
NUMBERED = sorted(EXAMPLES.glob("[0-9][0-9]_*.py"))


def test_there_are_examples_numbered_from_one() -> None:
    assert [int(path.name[:2]) for path in NUMBERED] == list(range(1, len(NUMBERED) + 1))
    assert NUMBERED


@pytest.mark.slow
@pytest.mark.parametrize("example", NUMBERED, ids=lambda path: path.stem)
def test_an_example_prints_what_the_file_beside_it_says(example: Path, tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, str(example)], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == example.with_suffix(".txt").read_text()


@pytest.mark.parametrize("example", NUMBERED, ids=lambda path: path.stem)
def test_an_example_fits_on_a_page(example: Path) -> None:
    assert len(example.read_text().splitlines()) <= 60


@pytest.mark.parametrize("page", ["README.md", "docs/index.md"])
def test_every_numbered_example_is_linked(page: str) -> None:
    text = (EXAMPLES.parent / page).read_text()
    assert [path.name for path in NUMBERED if f"examples/{path.name})" not in text] == []


@pytest.mark.slow
def test_the_python_of_the_readme_writes_its_image(tmp_path: Path) -> None:
    readme = (EXAMPLES.parent / "README.md").read_text()
    (code,) = re.findall(r"^```python\n(.*?)^```", readme, re.MULTILINE | re.DOTALL)
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path, check=True)
    assert [path.name for path in tmp_path.iterdir()] == ["view.png"]
