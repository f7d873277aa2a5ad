"""The page docs/python.md: its tables list what exists, and its programs run."""

from __future__ import annotations

import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

import uwsim
from uwsim.base.geometry import Intrinsics

PAGE = (Path(__file__).parent.parent / "docs" / "python.md").read_text()
ROW = re.compile(r"^\| (`[^|]*`) \|", re.MULTILINE)
CODE = re.compile(r"`([^`\n]+)`")
NAME = re.compile(r"(\w+)(?:\((.*)\))?")
STABLE_NAMES = re.compile(r"^\| (\d+\.\d+\.\d+) \| (.*) \|$", re.MULTILINE)
BLOCK = re.compile(r"^```python\n(.*?)^```", re.MULTILINE | re.DOTALL)


def section(title: str) -> str:
    """The text below a heading, up to the next one."""
    return re.split(r"^## ", PAGE.split(title, 1)[1], maxsplit=1, flags=re.MULTILINE)[0]


def listed(text: str) -> list[tuple[str, str | None]]:
    """Each name in the first column of a table, with its arguments."""
    found = []
    for row in ROW.findall(text):
        for code in CODE.findall(row):
            match = NAME.fullmatch(code)
            assert match is not None, code
            found.append((match[1], match[2]))
    return found


def check_arguments(function: object, arguments: str) -> None:
    """Every argument that the page shows is one of the function; all of them are shown."""
    assert callable(function)
    parameters = [
        each for each in inspect.signature(function).parameters.values() if each.name != "self"
    ]
    shown = [word.split("=")[0].strip(" *") for word in arguments.split(",") if word.strip()]
    assert set(shown) <= {each.name for each in parameters}
    required = {each.name for each in parameters if each.default is inspect.Parameter.empty}
    assert required <= set(shown)


HEAD = PAGE.split("## A simulation", maxsplit=1)[0]


@pytest.mark.parametrize(("name", "arguments"), listed(HEAD))
def test_a_name_of_the_page_is_a_name_of_the_module(name: str, arguments: str | None) -> None:
    assert name in uwsim.__all__
    if arguments is not None:
        value = getattr(uwsim, name)
        check_arguments(value.__init__ if isinstance(value, type) else value, arguments)


def test_every_public_name_and_argument_is_on_the_page() -> None:
    names = dict(listed(HEAD))
    assert set(uwsim.__all__) - {"__version__"} == names.keys()
    for name in ("load", "bench", "compare"):
        missing = [
            each
            for each in inspect.signature(getattr(uwsim, name)).parameters
            if each not in (names[name] or "")
        ]
        assert missing == [], name


@pytest.mark.parametrize(("name", "arguments"), listed(section("## A simulation")))
def test_a_member_of_the_page_is_one_of_a_simulation(name: str, arguments: str | None) -> None:
    if name == "world":
        return  # an attribute of the object, which the programs below use
    member = inspect.getattr_static(uwsim.Simulation, name)
    assert isinstance(member, property) == (arguments is None)
    if arguments is not None:
        check_arguments(member, arguments)


@pytest.mark.parametrize("name", [name for name, _ in listed(section("## An image with labels"))])
def test_a_member_of_an_image_is_there(name: str) -> None:
    assert name in uwsim.RenderedImage.__dataclass_fields__ or hasattr(uwsim.RenderedImage, name)


def test_what_the_page_says_of_boxes_and_pinholes_is_there() -> None:
    text = section("## An image with labels")
    assert {*uwsim.PixelBox._fields} <= set(CODE.findall(text))
    for name in ("width", "height", "fx", "fy", "cx", "cy", "skew"):
        assert name in CODE.findall(text)
        assert name in Intrinsics.__dataclass_fields__
    for name in ("pose", "size", "corners"):
        assert f"`{name}`" in text
        assert name in uwsim.OrientedBox.__dataclass_fields__ or hasattr(uwsim.OrientedBox, name)


def test_the_stable_names_of_the_page_are_the_public_names() -> None:
    rows = STABLE_NAMES.findall(section("## Stability"))
    names = [name for _, text in rows for name in CODE.findall(text)]
    assert sorted(names) == sorted(uwsim.__all__)


@pytest.mark.slow
@pytest.mark.parametrize("program", BLOCK.findall(PAGE))
def test_a_program_of_the_page_runs(program: str, tmp_path: Path) -> None:
    path = tmp_path / "program.py"
    path.write_text(program)
    done = subprocess.run([sys.executable, path], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    assert done.stdout.strip() != ""
