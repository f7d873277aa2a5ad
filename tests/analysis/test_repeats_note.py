"""How many repeats a comparison needs, said before it is played."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.compared_results import entries, noisy_result
from tests.support.short_benchmark import write_benchmark
from uwsim.analysis.comparison import compare, shared_column
from uwsim.analysis.repeats_note import repeats_note
from uwsim.cli import main


@pytest.mark.slow
def test_bench_says_at_the_start_how_many_repeats_a_comparison_needs(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    benchmark = str(write_benchmark(tmp_path, "0.1"))
    algorithms = ["--algorithm", "frozen", "--algorithm", "tests.support.failing:RaisedError"]
    call = ["bench", benchmark, *algorithms]
    main([*call, "--level", "fog=0", "--out", str(tmp_path / "out")])
    first = capsys.readouterr().err.splitlines()[0]
    assert first == (
        "note: comparing 2 results needs at least 6 repeats; 1 repeat (--repeat): too few."
    )


@pytest.mark.parametrize(
    ("n_results", "repeats", "said"),
    [
        (3, 6, "7 repeats for the sweep as a whole and 9 for single levels; 6 repeats"),
        (3, 6, "(--repeat): too few."),
        (3, 7, "(--repeat): enough for the sweep alone."),
        (3, 9, "(--repeat): enough for both."),
        (1, 5, "comparing this result with one other needs at least 6 repeats"),
    ],
)  # fmt: skip
def test_the_note_says_what_compare_will_find(n_results: int, repeats: int, said: str) -> None:
    assert said in (repeats_note(n_results, 3, repeats) or "")


@pytest.mark.parametrize("n_results", [2, 3, 4])
def test_the_plan_and_the_comparison_count_the_same(n_results: int) -> None:
    results = [noisy_result(f"a{i}", 1.0, n=4, salt=i) for i in range(n_results)]
    found = entries(*results)
    comparison = compare(found, shared_column(found, None))
    sweep, level = comparison.min_sweep_repeats, comparison.min_level_repeats
    assert f"at least {sweep} repeats for the sweep as a whole and {level} for" in (
        repeats_note(n_results, 3, 1) or ""
    )


def test_one_run_of_one_algorithm_is_not_lectured() -> None:
    assert repeats_note(1, 27, 1) is None
    assert repeats_note(1, 27, 12) is None
