"""The attributes of `Scene` and `Benchmark` that type checkers know are the fields of the specs."""

from __future__ import annotations

import re
from typing import get_type_hints

import pytest

from uwsim.benchmark.spec import BenchmarkSpec
from uwsim.editing import Benchmark, Scene
from uwsim.editing.attributes import OptionalPart, Part, Parts
from uwsim.editing.grammar import default_tables, places_of
from uwsim.scene.spec import SceneSpec
from uwsim.schema import Spec

OUTSIDE_OF_FILES = {"expansion", "is_original"}
"""Fields of a scene that state how its file was read."""


@pytest.mark.parametrize(("document", "spec"), [(Scene, SceneSpec), (Benchmark, BenchmarkSpec)])
def test_the_annotations_of_a_document_are_those_of_its_spec(
    document: type[Scene] | type[Benchmark], spec: type[Spec]
) -> None:
    places = places_of(spec, default_tables())
    expected = {}
    for name, annotation in spec.__annotations__.items():
        kind = re.sub(r"^tuple\[(\w+), \.\.\.\]$| \| None$", r"\1", annotation)
        if name not in places:
            expected[name] = annotation
        elif places[name].is_list:
            expected[name] = f"Parts[{kind}]"
        else:
            expected[name] = f"{'Optional' * places[name].is_optional}Part[{kind}]"
    stated = {name: text for name, text in document.__annotations__.items() if name[0] != "_"}
    assert stated == {n: text for n, text in expected.items() if n not in OUTSIDE_OF_FILES}


def test_the_annotations_name_kinds_of_attributes() -> None:
    hints = get_type_hints(Scene)
    assert hints["vehicles"].__origin__ is Parts
    assert hints["camera"].__origin__ is OptionalPart
    assert hints["ocean_state"].__origin__ is Part
