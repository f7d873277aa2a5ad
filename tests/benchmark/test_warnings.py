"""What `uwsim check` says of benchmarks that can be played, and not as they were meant."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from uwsim.cli import main

BASE = (Path(__file__).parent / "files" / "vision-auto.xml").read_text()
ARM = """<sceneUpdater><armMoveUpdater>
<armPosition>FIRST</armPosition>
<armPosition>SECOND</armPosition>
<step>1</step> <interval>1</interval> <target>girona500</target>
</armMoveUpdater></sceneUpdater>"""


def joints(*values: float) -> str:
    return "".join(f"<joint>{value:g}</joint>" for value in values)


def warnings(text: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> list[tuple[int, str]]:
    """Line and words of each warning of a file without errors."""
    file = folder / "b.xml"
    file.write_text(text)
    assert main(["check", str(file), "--scene", "visibility-scene"]) == 0
    said = capsys.readouterr().out
    found = re.findall(r"b\.xml:(\d+): warning: (.*)", said)
    return [(int(line), words) for line, words in found]


def line_of(text: str, word: str) -> int:
    return text.count("\n", 0, text.index(word)) + 1


def test_arm_positions_that_the_arm_cannot_take_are_reported(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arm = ARM.replace("FIRST", joints(*[0] * 9)).replace("SECOND", joints(99, *[0] * 8))
    text = re.sub("<sceneUpdater>.*</sceneUpdater>", arm, BASE, flags=re.DOTALL)
    first = line_of(text, "<armPosition>")
    found = [(line, words) for line, words in warnings(text, tmp_path, capsys) if "joint" in words]
    assert [line for line, _ in found if line == first] != []
    assert all("<armPosition> has 9 values for 5 joints" in w for line, w in found if line == first)
    assert any(line == first + 1 and "at 99 is limited to" in w for line, w in found)


@pytest.mark.parametrize(
    ("start", "words"),
    [
        ("<type>never</type>", "no level will ever begin"),
        ("<type>service</type><target>autoInit</target>", "which the algorithm serves"),
    ],
)
def test_a_start_that_never_comes_is_reported(
    start: str, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    tail = BASE.rindex("<startOn>")
    end = BASE.index("</startOn>", tail)
    text = f"{BASE[:tail]}<startOn>{start}{BASE[end:]}"
    line = line_of(BASE[tail:], "<startOn>") + BASE.count("\n", 0, tail)
    assert [said for at, said in warnings(text, tmp_path, capsys) if at == line and words in said]


def test_a_benchmark_that_measures_nothing_is_reported(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = re.sub("<measures>.*</measures>", "<measures/>", BASE, flags=re.DOTALL)
    text = re.sub("<function .*</function>", "<function>1</function>", text, flags=re.DOTALL)
    said = [words for _, words in warnings(text, tmp_path, capsys)]
    assert "<measures> is empty: nothing is measured" in said
