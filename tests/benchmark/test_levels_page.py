"""What docs/levels.md says of triggers, updaters and compatibility quirks is so."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from uwsim.base.optics import DENSITY, LENGTHS
from uwsim.benchmark.reader import check_benchmark
from uwsim.benchmark.triggers import TRIGGERS
from uwsim.benchmark.updaters import UPDATERS

PAGE = (Path(__file__).parents[2] / "docs" / "levels.md").read_text()
EXAMPLES = re.findall(r"```xml\n(.*?)```", PAGE, re.S)


@pytest.mark.parametrize("name", [*TRIGGERS, *UPDATERS, DENSITY, *LENGTHS])
def test_every_part_has_a_line(name: str) -> None:
    assert f"\n| `{name}` |" in PAGE


def test_every_column_stands_beside_its_updater() -> None:
    for element, spec in UPDATERS.items():
        line = next(line for line in PAGE.split("\n") if line.startswith(f"| `{element}` |"))
        own_columns = ("bagFogUpdater", "u:settingUpdater")
        assert f"`{spec.name}`" in line or element in own_columns, element


@pytest.mark.parametrize("example", EXAMPLES)
def test_the_examples_are_sound(example: str, tmp_path: Path) -> None:
    file = tmp_path / "b.xml"
    file.write_text(
        f"""<benchmark xmlns:u="urn:uwsim:1"> <measures> <time> <name>t</name> </time> </measures>
        <startOn> <type>onInit</type> </startOn> <stopOn> <type>never</type> </stopOn>
        <function>t</function> <sceneUpdater> {example} </sceneUpdater> </benchmark>"""
    )
    assert check_benchmark(file)[0] == []
