"""The pages made from the specs are fresh, and name all that there is."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from scripts.reference import dialect_reference
from uwsim.benchmark.ground_truth import GROUND_TRUTHS
from uwsim.benchmark.measures import MEASURES
from uwsim.benchmark.triggers import TRIGGERS
from uwsim.benchmark.updaters import UPDATERS
from uwsim.scene.vehicle import VehicleSpec
from uwsim.schema import fields_of

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize(
    "name",
    [
        "dialect.md",
        "benchmark-dialect.md",
        "grammar/uwsim-benchmark.rng",
        "grammar/uwsim-scene.rng",
    ],
)
def test_the_generated_pages_say_what_the_specs_say(name: str) -> None:
    assert (ROOT / "docs" / name).read_text() == dialect_reference.pages()[name], "run scripts/docs"


def test_the_page_names_every_element_of_a_vehicle() -> None:
    page = dialect_reference.page()
    assert [field.label for field in fields_of(VehicleSpec) if f"`{field.label}`" not in page] == []


@pytest.mark.parametrize("family", [MEASURES, TRIGGERS, UPDATERS, GROUND_TRUTHS])
def test_the_benchmarks_page_names_every_part_and_all_that_stands_in_it(
    family: dict[str, type],
) -> None:
    sections = dialect_reference.benchmark_page().split("\n### ")[1:]
    for name, spec in family.items():
        mine = [
            part for part in sections if re.search(rf"[<> \"]{name}[<> \"]", part.split("\n")[0])
        ]
        assert mine, name
        for field in fields_of(spec):
            assert any(f"`{field.label}`" in part for part in mine), (name, field.label)
