"""``uwsim compare`` as it is typed."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from tests.support.compared_results import make_result, noisy_result, save_results
from uwsim.analysis.comparison import write
from uwsim.cli import main
from uwsim.results.result_file import save


@pytest.fixture
def two(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    monkeypatch.chdir(tmp_path)
    return save_results(
        tmp_path, noisy_result("esm", 1.0, n=8, salt=1), noisy_result("ic", 1.5, n=8, salt=2)
    )


@pytest.fixture
def without_plots(monkeypatch: pytest.MonkeyPatch) -> None:
    """Draw nothing: what is asked here is what a command does, and drawing is most of its time."""
    monkeypatch.setattr(write, "draw_comparison", lambda comparison, directory: [])


def one_line(capsys: pytest.CaptureFixture[str]) -> str:
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    return error


def test_two_results_are_compared_into_a_directory(
    two: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["compare", *two]) == 0
    printed = capsys.readouterr().out
    assert "esm is better than ic" in printed
    assert "written: comparison/comparison.json" in printed
    assert {path.name for path in Path("comparison").iterdir()} == {
        "comparison.json", "comparison.csv", "comparison.html", "plots",
    }  # fmt: skip


@pytest.mark.usefixtures("without_plots")
def test_an_earlier_comparison_is_replaced_only_with_overwrite(
    two: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["compare", *two, "--out", "out"]) == 0
    first = Path("out/comparison.json").read_bytes()
    capsys.readouterr()
    assert main(["compare", *two, "--out", "out"]) == 2
    assert "not empty. Use --overwrite" in one_line(capsys)
    assert main(["compare", *two, "--out", "out", "--overwrite"]) == 0
    assert Path("out/comparison.json").read_bytes() == first
    Path("out/thesis.txt").write_text("x")
    capsys.readouterr()
    assert main(["compare", *two, "--out", "out", "--overwrite"]) == 2
    assert "holds 'thesis.txt', which does not belong there" in one_line(capsys)


@pytest.mark.usefixtures("without_plots")
def test_another_experiment_is_refused_in_one_line_and_forced_with_a_warning(
    two: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    other = noisy_result("ecc", 1.2, n=8, salt=3)
    save(replace(other, run=replace(other.run, timestep=(0.001, "s"))), Path("ecc.result"))
    assert main(["compare", two[0], "ecc.result"]) == 2
    error = one_line(capsys)
    assert "not of one experiment: timestep: 0.002 s in esm.result, 0.001 s in ecc.result" in error
    assert "--force" in error
    assert not Path("comparison").exists()
    assert main(["compare", two[0], "ecc.result", "--force"]) == 0
    assert "warning: not of one experiment: timestep" in capsys.readouterr().err
    assert json.loads(Path("comparison/comparison.json").read_text())["differing_experiments"]


@pytest.mark.usefixtures("without_plots")
def test_the_baseline_may_be_among_the_results_or_not(
    two: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["compare", *two, "--baseline", two[1], "--out", "a"]) == 0
    assert main(["compare", two[0], "--baseline", "ic.result/result.json", "--out", "b"]) == 0
    one, other = (json.loads(Path(f"{d}/comparison.json").read_text()) for d in "ab")
    assert one["baseline"] == other["baseline"] == "ic"
    assert one["pairs"] == other["pairs"]


@pytest.mark.usefixtures("without_plots")
def test_a_directory_of_several_algorithms_stands_for_all_of_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    for i, name in enumerate(("esm", "ecc", "ic")):
        save(noisy_result(name, 1.0 + i, n=3, salt=i), Path("both.result", name))
    assert main(["compare", "both.result"]) == 0
    pairs = json.loads(Path("comparison/comparison.json").read_text())["pairs"]
    assert [(p["first"], p["second"]) for p in pairs] == [
        ("ecc", "esm"), ("ecc", "ic"), ("esm", "ic"),
    ]  # fmt: skip
    capsys.readouterr()
    assert main(["compare", "both.result/esm"]) == 2
    assert "at least two results" in one_line(capsys)


@pytest.mark.usefixtures("without_plots")
def test_results_of_one_algorithm_are_distinguished_by_their_directories(
    two: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    save(noisy_result("esm", 1.1, n=8, salt=9), Path("fast/esm.result"))
    assert main(["compare", two[0], "fast/esm.result"]) == 0
    assert "esm (fast/esm.result) minus esm (" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["esm.result"], "at least two results"),
        (["nowhere.result"], "no result here"),
        (["esm.result", "esm.result/result.json"], "given twice"),
        (["esm.result", "nowhere.result"], "no result here"),
        (["esm.result", "ic.result", "--measure", "corner"], "Did you mean 'corners'"),
        (["esm.result", "late.result"], "no seed and level in common"),
        (["esm.result", "ic.result", "--out", "late.result/result.json"], "is a file"),
    ],
)
def test_a_wrong_call_is_one_clean_line_and_writes_nothing(
    two: list[str], arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    save(make_result("late", {0.0: [1.0]}, seed=70), Path("late.result"))
    assert main(["compare", *arguments]) == 2
    assert said in one_line(capsys)
    assert not Path("comparison").exists()


@pytest.mark.usefixtures("without_plots")
def test_json_is_what_is_written_and_nothing_else(
    two: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["compare", *two, "--json"]) == 0
    assert capsys.readouterr().out == Path("comparison/comparison.json").read_text()
