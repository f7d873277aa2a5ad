"""Written scenes and benchmarks read back to equal specs, edited ones included."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from uwsim.assets.bundled import bundled_files
from uwsim.editing import Benchmark, Scene, read_benchmark, read_scene
from uwsim.editing.element import Element
from uwsim.editing.tree import walk
from uwsim.errors import UwsimError

TESTS = Path(__file__).parent.parent
SCENES = [*bundled_files("scenes").values(), TESTS / "scene" / "every-element.xml"]
BENCHMARKS = [*bundled_files("benchmarks").values(), TESTS / "benchmark" / "every-element.xml"]
VALUES = (
    st.none()
    | st.booleans()
    | st.integers(-3, 3000)
    | st.floats()
    | st.text(max_size=8)
    | st.tuples(*[st.floats(-10.0, 10.0)] * 3)
    | st.lists(st.floats(-2.0, 2.0), max_size=6)
)


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_a_written_scene_reads_back_equal(path: Path, tmp_path: Path) -> None:
    scene = read_scene(path)
    assert read_scene(scene.write(tmp_path / "copy.xml")).spec == scene.spec


@pytest.mark.parametrize("path", BENCHMARKS, ids=lambda path: path.stem)
def test_a_written_benchmark_reads_back_equal(path: Path, tmp_path: Path) -> None:
    benchmark = read_benchmark(path)
    copy = read_benchmark(benchmark.write(tmp_path / "copy.xml"))
    copy.set(scene=benchmark.spec.scene)
    assert copy.spec == benchmark.spec


def attributes(root: Element[Any]) -> Iterator[tuple[Element[Any], str]]:
    for element in walk(root):
        for name in element._fields:
            yield element, name


def edit_at_random(root: Scene | Benchmark, data: st.DataObject) -> int:
    """Set values anywhere; return the number of those that were accepted."""
    places = list(attributes(root))
    n_accepted, messages = 0, list[str]()
    for _ in range(data.draw(st.integers(1, 12))):
        element, name = data.draw(st.sampled_from(places))
        try:
            setattr(element, name, data.draw(VALUES))
            n_accepted += 1
        except UwsimError as error:
            messages.append(str(error))
    assert not any("\n" in message for message in messages)
    return n_accepted


@settings(max_examples=60, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(data=st.data(), path=st.sampled_from(SCENES))
def test_an_edited_scene_reads_back_equal_or_is_refused_with_its_errors(
    data: st.DataObject, path: Path
) -> None:
    scene = read_scene(path)
    edit_at_random(scene, data)
    with suppress(UwsimError):
        assert scene.checked_spec() == scene.spec


@settings(max_examples=60, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(data=st.data(), path=st.sampled_from(BENCHMARKS))
def test_an_edited_benchmark_reads_back_equal_or_is_refused_with_its_errors(
    data: st.DataObject, path: Path
) -> None:
    benchmark = read_benchmark(path)
    edit_at_random(benchmark, data)
    with suppress(UwsimError):
        assert benchmark.checked_spec() == benchmark.spec


def test_every_value_of_every_element_can_be_set_to_itself() -> None:
    for path in (SCENES[-1], BENCHMARKS[-1]):
        root = (read_scene if path in SCENES else read_benchmark)(path)
        before = root.spec
        for element, name in attributes(root):
            setattr(element, name, getattr(element, name))
        assert root.spec == before


def test_short_elements_are_on_one_line_and_constants_have_names() -> None:
    text = read_scene("visibility-scene").to_xml()
    assert "<offsetr> <x>M_PI</x> <y>0</y> <z>-M_PI_2</z> </offsetr>" in text
    assert all(len(line) <= 100 for line in text.splitlines())
    blocks = list(itertools.pairwise(text.splitlines()))
    assert ("", "  <vehicle>") in blocks
