"""The programs of docs/scenes-from-python.md run, and its messages are those of the program."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

import uwsim
from uwsim.errors import UwsimError

PAGE = (Path(__file__).parents[2] / "docs" / "scenes-from-python.md").read_text()
PROGRAMS = re.findall(r"^```python\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)
MESSAGES = re.findall(r"^>>> (.*)\n(\w+): (.*)$", PAGE, re.MULTILINE)


@pytest.mark.slow
@pytest.mark.parametrize("program", PROGRAMS)
def test_a_program_of_the_page_runs(program: str, tmp_path: Path) -> None:
    subprocess.run([sys.executable, "-c", program], cwd=tmp_path, check=True)


@pytest.mark.parametrize(("line", "kind", "message"), MESSAGES)
def test_a_message_of_the_page_is_that_of_the_program(line: str, kind: str, message: str) -> None:
    scene = uwsim.read_scene("visibility-scene")
    names = {"scene": scene, "camera": scene["girona500/bowtech1"]}
    with pytest.raises(UwsimError) as caught:
        exec(line, names)
    assert type(caught.value).__name__ == kind
    assert str(caught.value).startswith(message.removesuffix("..."))
