"""What a measure is in words: the first line of its live class's docstring."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest

from uwsim.assets.bundled import bundled_files
from uwsim.benchmark.measures import MEASURES, Distance, DistanceSpec, Measure, MeasureSpec
from uwsim.benchmark.reader import read_benchmark
from uwsim.results.measures_file import FILE, MeasureNote, load_measures, save_measures
from uwsim.runs.measure_notes import live_class, meaning_of, notes_of, plain_text
from uwsim.world import World


@pytest.mark.parametrize("kind", MEASURES.values(), ids=lambda kind: kind.__name__)
def test_every_measure_names_its_live_class(kind: type[MeasureSpec]) -> None:
    spec = kind.__new__(kind)
    live = live_class(spec)
    assert live is not None
    assert live.__name__ == kind.__name__.removesuffix("Spec")
    meaning = meaning_of(spec)
    assert meaning
    assert not set(meaning) & set("\\`$\n")
    assert not meaning.endswith(".")


def test_a_phrase_has_no_marks_of_mathematics() -> None:
    assert (
        plain_text(r"Length :math:`\lVert p - q \rVert` of ``path``.") == "Length ‖p - q‖ of path."
    )
    assert plain_text(r":math:`\sqrt{d_x^2 + d_y^2}`") == "√(dx² + dy²)"


@dataclass(frozen=True, kw_only=True)
class BareSpec(MeasureSpec):
    """A measure whose bind has no annotation."""

    def bind(self, world: World):  # type: ignore[no-untyped-def]
        """Bind nothing."""
        raise NotImplementedError


def test_without_a_live_class_the_spec_is_asked() -> None:
    assert meaning_of(BareSpec(name="bare")) == "a measure whose bind has no annotation"
    assert live_class(DistanceSpec(name="trip", target="rov")) is Distance
    assert issubclass(Distance, Measure)


def test_notes_are_read_back_and_damaged_files_have_none(tmp_path: Path) -> None:
    spec = read_benchmark(bundled_files("benchmarks")["currents"])
    notes = notes_of(spec.measures)
    assert notes["offset"].value == "mean"
    save_measures(notes, tmp_path)
    assert load_measures(tmp_path) == notes
    for text in ("[1]", "{", '{"a": 1}', '{"a": {"meaning": "x"}}'):
        (tmp_path / FILE).write_text(text)
        assert load_measures(tmp_path) == {}
    (tmp_path / FILE).write_text('{"a": {"meaning": "x", "value": "max"}}')
    assert load_measures(tmp_path) == {"a": MeasureNote(meaning="x", value="max")}
    assert load_measures(tmp_path / "nowhere") == {}
