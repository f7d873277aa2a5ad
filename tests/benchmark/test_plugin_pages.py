"""The pages about a user's own measure, trigger and updater, taken as they say."""

from __future__ import annotations

import importlib
import re
import sys
from pathlib import Path

import pytest

from uwsim.cli import main

ROOT = Path(__file__).parents[2]
PAGES = {
    "adding-a-measure.md": "top_speed",
    "adding-a-trigger.md": "faster_than",
    "adding-an-updater.md": "dusk",
}


def blocks(page: str, language: str) -> list[str]:
    text = (ROOT / "docs" / page).read_text()
    return re.findall(rf"```{language}\n(.*?)```", text, re.DOTALL)


@pytest.mark.parametrize("page", PAGES)
def test_the_part_of_a_page_passes_its_test_and_its_benchmark_has_no_errors(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    name = PAGES[page]
    part, law = blocks(page, "python")
    (benchmark,) = blocks(page, "xml")
    (tmp_path / f"{name}.py").write_text(part)
    (tmp_path / f"law_of_{name}.py").write_text(law)
    (tmp_path / "b.xml").write_text(benchmark)
    monkeypatch.chdir(tmp_path)
    assert main(["check", "b.xml", "--plugin", f"{name}.py"]) == 0, capsys.readouterr()
    assert main(["check", "b.xml"]) == 2

    monkeypatch.syspath_prepend(tmp_path)
    laws = importlib.import_module(f"law_of_{name}")
    tests = [value for key, value in vars(laws).items() if key.startswith("test_")]
    assert len(tests) == 1
    tests[0]()
    for module in (name, f"law_of_{name}"):
        del sys.modules[module]


def test_the_pages_name_files_that_are_there() -> None:
    for page in PAGES:
        text = (ROOT / "docs" / page).read_text()
        for path in re.findall(r"`((?:src|tests|scripts)/[\w/.]+)`", text):
            if "top_speed" not in path:
                assert (ROOT / path).exists(), path


def test_the_algorithm_of_its_page_is_a_plugin(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "brightest.py").write_text(blocks("your-own-algorithm.md", "python")[0])
    monkeypatch.chdir(tmp_path)
    assert main(["list", "algorithms", "--plugin", "brightest.py"]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "brightest Moves the quad of autoInit" in shown
