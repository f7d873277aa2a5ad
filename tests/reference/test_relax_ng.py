"""The grammars accept what the readers accept, in any order, and refuse what they refuse."""

from __future__ import annotations

import os
import random
from pathlib import Path

import pytest
from lxml import etree

from scripts.reference.relax_ng import benchmark_grammar, scene_grammar
from uwsim.benchmark.reader import check_benchmark

ROOT = Path(__file__).parents[2]
DATA = ROOT / "src" / "uwsim" / "data"
SCENES = [
    ROOT / "tests" / "scene" / "every-element.xml",
    # the grammar is that of scenes without xacro, or after its expansion
    *(
        path
        for path in sorted((DATA / "scenes").glob("*.xml"))
        if "<xacro:" not in path.read_text()
    ),
]
EVERY_ELEMENT = ROOT / "tests" / "benchmark" / "every-element.xml"
BENCHMARKS = [EVERY_ELEMENT, *sorted((DATA / "benchmarks").glob("*.xml"))]
ORIGINALS = os.environ.get("UWSIM_ORIGINALS")


@pytest.fixture(scope="module")
def scenes() -> etree.RelaxNG:
    return etree.RelaxNG(etree.fromstring(scene_grammar()))


@pytest.fixture(scope="module")
def benchmarks() -> etree.RelaxNG:
    return etree.RelaxNG(etree.fromstring(benchmark_grammar()))


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_our_scenes_are_valid(path: Path, scenes: etree.RelaxNG) -> None:
    assert scenes.validate(etree.parse(path)), scenes.error_log


@pytest.mark.parametrize(
    "inside",
    [
        "<vehicel/>",
        "<vehicle><name>a</name></vehicle>",
        "<oceanState><windx>nan</windx></oceanState>",
        "<oceanState><windx>1</windx><windx>1</windx></oceanState>",
        "<simParams><offsetp><x>1</x><y>1</y></offsetp></simParams>",
        "<object buryed='1'><name>a</name><file>b</file></object>",
        "<object><name/><file>b</file></object>",
    ],
)
def test_scenes_that_the_reader_refuses_are_not(inside: str, scenes: etree.RelaxNG) -> None:
    assert not scenes.validate(etree.fromstring(f"<UWSimScene>{inside}</UWSimScene>"))


@pytest.mark.parametrize("path", BENCHMARKS, ids=lambda path: path.stem)
def test_our_benchmarks_are_valid(path: Path, benchmarks: etree.RelaxNG) -> None:
    assert benchmarks.validate(etree.parse(path)), benchmarks.error_log


def test_the_file_of_every_element_is_in_the_originals_order_and_valid_in_any(
    benchmarks: etree.RelaxNG,
) -> None:
    assert [
        str(diagnostic) for diagnostic in check_benchmark(EVERY_ELEMENT, is_strict=True)[0]
    ] == []
    for seed in range(20):
        assert benchmarks.validate(shuffled(EVERY_ELEMENT, seed)), (seed, benchmarks.error_log)


@pytest.mark.skipif(ORIGINALS is None, reason="UWSIM_ORIGINALS is not set")
def test_the_originals_are_valid_in_any_order(benchmarks: etree.RelaxNG) -> None:
    paths = [p for p in Path(ORIGINALS or "").rglob("*.xml") if b"<benchmark" in p.read_bytes()]
    assert paths
    for path in sorted(paths):
        for seed in range(5):
            assert benchmarks.validate(shuffled(path, seed)), (path, seed, benchmarks.error_log)


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("<measures>", "<measures> <distence/>"),
        ("<measures>", "<measures> <energy> <name>e</name> <target>girona500</target> </energy>"),
        ("<measures>", "<measures> <u:enrgy/>"),
        ("<camera>bowtech1</camera>\n      <log>", "<log>"),
        ("<name>trip</name>", "<name> </name>"),
        ("<name>trip</name>", "<name>trip</name> <name>again</name>"),
        ("<type>onMove</type>", "<type>onMoove</type>"),
        ("<type>onMove</type> <target>girona500</target>", "<type>onMove</type>"),
        ("<type>onMove</type> ", ""),
        ('type="constant"', 'type="fixed"'),
        ('type="constant"', 'type="relativeLocation"'),
        ('<groundTruth type="cornersFromCamera">', "<groundTruth>"),
        ("<value>1</value>", "<value>one</value>"),
        ("<z>1.515</z>", "<z>nan</z>"),
        ("<z>1.515</z>", ""),
        ('unit="Wh"', 'unit="kWh"'),
        (" 2000 ", ""),
        ("<quantity>itae</quantity>", "<quantity>itea</quantity>"),
        ('u:truth="face"', 'u:truth="side"'),
        ('u:truth="face"', 'truth="face"'),
        ('u:patience="20"', 'u:patience="long"'),
        ('publishResult="true"', 'publishResult="yes"'),
        ("corners + (centroid &lt; 2 ? 1 : 2)", " "),
        ("<iterations>2</iterations>", "<iterations>twice</iterations>"),
        ("<none/>", ""),
        ("<none/>", "<none/> <none/>"),
        ("<none/>", "<nothing/>"),
        ("<phi>0</phi>", "<psi>0</psi>"),
        ("<joint>0.5</joint>", "<angle>0.5</angle>"),
    ],
)
def test_benchmarks_that_the_reader_refuses_are_not(
    right: str, wrong: str, benchmarks: etree.RelaxNG, tmp_path: Path
) -> None:
    text = EVERY_ELEMENT.read_text()
    assert right in text
    file = tmp_path / "wrong.xml"
    file.write_text(text.replace(right, wrong, 1))
    assert any(diagnostic.severity == "error" for diagnostic in check_benchmark(file)[0])
    assert not benchmarks.validate(etree.parse(file))


def shuffled(path: Path, seed: int) -> etree._ElementTree:
    """A file with the children of every element in another order."""
    tree, order = etree.parse(path), random.Random(seed)
    for node in tree.iter("*"):
        children = list(node)
        order.shuffle(children)
        node[:] = children
    return tree
