"""What docs/measures.md says of measures, their details and compatibility quirks is so."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.support.fakes import FakeBody, FakeWorld
from uwsim.benchmark.measures import (
    MEASURES,
    CollisionSpec,
    MapErrorSpec,
    Measure,
    PathFollowingSpec,
    Reconstruction3DSpec,
)
from uwsim.benchmark.measures.reports.map_error import PlaceSpec
from uwsim.world import Box

PAGE = (Path(__file__).parents[3] / "docs" / "measures.md").read_text()
WORLD = FakeWorld({"v": FakeBody(box=Box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)))})


def section(name: str) -> str:
    return PAGE.split(f"\n## {name}\n")[1].split("\n## ")[0]


@pytest.mark.parametrize("name", MEASURES)
def test_every_measure_has_a_section_and_a_line_at_the_top(name: str) -> None:
    assert f"\n## {name}\n" in PAGE
    anchor = name.lower().replace(":", "")
    assert f"\n| [`{name}`](#{anchor}) |" in PAGE


@pytest.mark.parametrize(
    ("name", "measure"),
    [
        ("collision", CollisionSpec(name="c", target="v").bind(WORLD)),
        (
            "u:mapError",
            MapErrorSpec(
                name="m",
                target="v",
                topic="t",
                tolerance=0.1,
                low=PlaceSpec(x=0.0, y=0.0),
                high=PlaceSpec(x=1.0, y=1.0),
            ).bind(WORLD),
        ),
        ("pathFollowing", PathFollowingSpec(name="p", target="v", end_share=0.9).bind(WORLD)),
        (
            "reconstruction3D",
            Reconstruction3DSpec(
                name="r", target="v", topic="t", from_="v", level_of_detail=0.5
            ).bind(WORLD),
        ),
    ],
)
def test_every_detail_stands_there_with_its_unit(name: str, measure: Measure) -> None:
    told: dict[str, str] = {}
    for names, unit in re.findall(r"^\| (`[^|]*) \|[^|]*\| ([^|]*) \|$", section(name), re.M):
        told.update({detail: unit for detail in re.findall(r"`(\w+)`", names)})
    units = {each: measure.detail_units.get(each, measure.unit) for each in measure.details}
    units.pop("n", None)  # a number of samples, in the line of the statistics
    told.pop("n", None)
    assert told == units
