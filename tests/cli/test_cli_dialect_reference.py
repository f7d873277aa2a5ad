"""The pages made from the specs are fresh, and the grammar accepts what the reader accepts."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from lxml import etree

from uwsim.benchmark.ground_truth import GROUND_TRUTHS
from uwsim.benchmark.measures import MEASURES
from uwsim.benchmark.triggers import TRIGGERS
from uwsim.benchmark.updaters import UPDATERS
from uwsim.cli import dialect_reference
from uwsim.dialect import slots
from uwsim.scene.spec import VehicleSpec

ROOT = Path(__file__).parents[2]
SCENES = [
    ROOT / "tests" / "scene" / "every-element.xml",
    *sorted((ROOT / "src" / "uwsim" / "data" / "scenes").glob("*.xml")),
]


@pytest.mark.parametrize("name", ["dialect.md", "benchmark-dialect.md", "grammar/uwsim-scene.rng"])
def test_the_generated_pages_say_what_the_specs_say(name: str) -> None:
    assert (ROOT / "docs" / name).read_text() == dialect_reference.pages()[name], "run scripts/docs"


def test_the_page_names_every_element_of_a_vehicle() -> None:
    page = dialect_reference.page()
    assert [slot.shown for slot in slots(VehicleSpec) if f"`{slot.shown}`" not in page] == []


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
        for slot in slots(spec):
            assert any(f"`{slot.shown}`" in part for part in mine), (name, slot.shown)


@pytest.fixture(scope="module")
def grammar() -> etree.RelaxNG:
    return etree.RelaxNG(etree.fromstring(dialect_reference.grammar()))


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_the_grammar_accepts_our_scenes(path: Path, grammar: etree.RelaxNG) -> None:
    assert grammar.validate(etree.parse(path)), grammar.error_log


@pytest.mark.parametrize(
    "inside",
    [
        "<vehicel/>",
        "<vehicle><name>a</name></vehicle>",
        "<oceanState><windx>nan</windx></oceanState>",
        "<oceanState><windx>1</windx><windx>1</windx></oceanState>",
        "<simParams><offsetp><x>1</x><y>1</y></offsetp></simParams>",
        "<object buryed='1'><name>a</name><file>b</file></object>",
    ],
)
def test_the_grammar_refuses_what_the_reader_refuses(inside: str, grammar: etree.RelaxNG) -> None:
    assert not grammar.validate(etree.fromstring(f"<UWSimScene>{inside}</UWSimScene>"))
