"""The pages about extending uwsim itself: their blocks are applied to a copy and run there."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
BLOCK = re.compile(r"(?P<before>[^\n]*)\n\n```(?P<language>\w+)\n(?P<text>.*?)```", re.DOTALL)
NEW = re.compile(r"^`([\w/.]+)`:$")
BELOW = re.compile(r"^(?:Below the last \w+ of|In) `(src/[\w/.]+)`[:,]")


def copy_of_the_package(folder: Path) -> None:
    """Links to everything: a file that is changed becomes one of its own."""
    ignored = shutil.ignore_patterns("*.pyc")  # what numba has compiled is taken along
    shutil.copytree(ROOT / "src", folder / "src", ignore=ignored, copy_function=os.symlink)


def put(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.unlink(missing_ok=True)
    path.write_text(text)


def patched(text: str, diff: str) -> str:
    """Apply hunks, which ``@@`` separates; what they do not begin with ``+`` is there once."""
    for hunk in diff.split("@@\n"):
        lines = hunk.splitlines()
        old = "".join(f"{line[1:]}\n" for line in lines if line[0] in " -")
        new = "".join(f"{line[1:]}\n" for line in lines if line[0] in " +")
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


def write_message_classes(folder: Path) -> str:
    """Run ``scripts/messages`` on the copy; returns what it prints, with paths of the copy."""
    package = folder / "src/uwsim/messages"
    for module in package.glob("*.py"):
        put(module, module.read_text())  # no link to ours any more
    command = [sys.executable, "-m", "scripts.reference.message_classes", str(package)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=200)
    assert done.returncode == 0, done.stderr
    return done.stdout.replace(f"{folder}/", "")


def apply(page: str, folder: Path) -> tuple[list[Path], str]:
    """Do what a page says; returns the file of each place, and the output it promises."""
    touched: list[Path] = []
    expected = ""
    for found in BLOCK.finditer((ROOT / "docs" / page).read_text()):
        before, language, block = found["before"], found["language"], found["text"]
        new, below = NEW.match(before), BELOW.match(before)
        if block.startswith("$ scripts/messages\n"):
            printed = write_message_classes(folder)
            assert block == f"$ scripts/messages\n{printed}"
            touched += map(Path, printed.split())
        if new is not None:
            put(folder / new[1], block)
        if language == "diff" and below is not None:
            path = folder / below[1]
            put(path, patched(path.read_text(), block))
        elif below is not None:
            path = folder / below[1]
            put(path, f"{path.read_text()}\n\n{block}")
        elif new is None and language == "python":
            put(folder / "use.py", block)
        elif language == "text":
            expected = block  # the last is what the program prints
        if place := new or below:
            n_places = 1 + block.count("@@\n") if language == "diff" else 1
            touched += n_places * [Path(place[1])]
    return [path for path in touched if path.suffix != ".xml"], expected


@pytest.mark.slow
@pytest.mark.parametrize(
    ("page", "n_files", "n_places"),
    [
        ("adding-a-sensor.md", 4, 5),
        ("adding-a-device.md", 2, 3),
        ("adding-a-force.md", 2, 3),
        ("adding-a-water-law.md", 3, 7),
        ("adding-a-check.md", 2, 2),
    ],
)
def test_a_page_says_all_that_must_be_done(
    page: str, n_files: int, n_places: int, tmp_path: Path
) -> None:
    copy_of_the_package(tmp_path)
    touched, expected = apply(page, tmp_path)
    assert (len(set(touched)), len(touched)) == (n_files, n_places)
    if page == "adding-a-sensor.md":
        assert f"{n_files} files, {n_places} places" in (ROOT / "docs" / page).read_text()
    environment = {**os.environ, "PYTHONPATH": str(tmp_path / "src")}
    for command, output in ((["-m", "uwsim", "check", "scene.xml"], ""), (["use.py"], expected)):
        done = subprocess.run(
            [sys.executable, *command],
            cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=200,
        )  # fmt: skip
        assert done.returncode == 0, done.stdout + done.stderr
        assert output in done.stdout
