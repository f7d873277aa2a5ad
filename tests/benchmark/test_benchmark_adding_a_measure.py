"""The four steps of docs/adding-a-measure.md, taken as the page says."""

from __future__ import annotations

import importlib.util
import re
import sys
from pathlib import Path
from types import ModuleType

import pytest

from uwsim.benchmark.measures import MEASURES
from uwsim.benchmark.reader import read_benchmark

PAGE = Path(__file__).parents[2] / "docs" / "adding-a-measure.md"
MODULE = "uwsim.benchmark.measures.top_speed"


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", PAGE.read_text(), re.DOTALL)


def load(name: str, path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def test_the_page_leads_to_a_measure_that_is_read_and_passes_its_test(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    measure, law = blocks("python")
    (line,) = [text for text in blocks("text") if "TopSpeedSpec" in text]
    (tmp_path / "top_speed.py").write_text(measure)
    (tmp_path / "law.py").write_text(law)
    (tmp_path / "b.xml").write_text(blocks("xml")[0])
    monkeypatch.setitem(sys.modules, MODULE, ModuleType(MODULE))
    monkeypatch.setitem(sys.modules, "law", ModuleType("law"))

    spec_class = load(MODULE, tmp_path / "top_speed.py").TopSpeedSpec
    load("law", tmp_path / "law.py").test_the_fastest_step_counts()

    key = re.findall(r'"(.*?)": TopSpeedSpec', line)[0]
    benchmark = read_benchmark(tmp_path / "b.xml", measures=MEASURES | {key: spec_class})
    assert benchmark.measures == (spec_class(name="fastest", target="girona500"),)


def test_the_page_names_files_that_are_there() -> None:
    root = PAGE.parents[1]
    for path in re.findall(r"`((?:src|tests|scripts)/[\w/.]+)`", PAGE.read_text()):
        if "top_speed" not in path:
            assert (root / path).exists(), path
