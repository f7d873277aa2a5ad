"""Means, rates and their intervals at every level."""

from __future__ import annotations

import csv
import io

import pytest

from tests.support.synthetic_results import one_level_result, visibility_result
from uwsim.results.inputs import Inputs
from uwsim.results.per_level import (
    intervals_of,
    per_level,
    rows_by_level,
    seeds_of,
    success_rates,
)
from uwsim.results.result import Column, MissingValue, Result
from uwsim.results.run_info import RunInfo
from uwsim.results.summary import summary_text
from uwsim.statistics import mean_interval, rate


def two_seeds() -> Result:
    return Result(
        inputs=Inputs(),
        run=RunInfo(),
        columns=(
            Column(name="seed", kind="run"),
            Column(name="fog", kind="level", unit="1/m"),
            Column(name="corners", kind="measure", unit="px"),
            Column(name="status", kind="status"),
        ),
        rows=(
            (1, 0.0, 2.0, "ok"),
            (1, 0.5, 8.0, "ok"),
            (2, 0.0, 4.0, "ok"),
            (2, 0.5, None, "lost"),
        ),
        missing_values=(MissingValue(row=3, column="corners", reason="lost at 3 s"),),
    )


def test_repeats_are_gathered_by_level_and_what_is_missing_is_counted() -> None:
    result = two_seeds()
    clear, foggy = intervals_of(result, "corners")
    assert rows_by_level(result) == {(0.0,): [0, 2], (0.5,): [1, 3]}
    assert (clear.interval.n, clear.interval.mean, clear.n_missing) == (2, 3.0, 0)
    assert (foggy.interval.n, foggy.interval.mean, foggy.n_missing) == (1, 8.0, 1)
    assert foggy.reason == "lost at 3 s"


def test_success_is_what_ended_ok_with_exact_limits_and_its_seeds() -> None:
    clear, foggy = success_rates(two_seeds())
    assert (clear.success, foggy.success) == (rate(2, 2), rate(1, 2))
    assert clear.seeds == foggy.seeds == (1, 2)


def test_a_row_without_seed_or_status_has_those_of_the_run_or_none() -> None:
    assert set(seeds_of(visibility_result(seeds=(7,)))) == {7}
    bare = Result(
        inputs=Inputs(), run=RunInfo(), columns=(Column(name="none", kind="level"),), rows=((1.0,),)
    )
    assert success_rates(bare)[0].success is None
    assert seeds_of(bare) == (None,)


def test_the_summary_has_a_line_for_every_column_at_every_level() -> None:
    result = visibility_result(seeds=(1, 2, 3, 4))
    lines = list(csv.DictReader(io.StringIO(summary_text(result))))
    assert len(lines) == 27 * 3
    first = lines[1]
    values = [
        v for v, row in zip(result.numbers("corners"), result.rows, strict=True) if not row[2]
    ]
    expected = mean_interval([v for v in values if v is not None])
    assert (first["fog [1/m]"], first["column"], first["unit"]) == ("0.0", "corners", "px")
    assert [float(first[name]) for name in ("n", "mean", "std", "low", "high")] == [
        expected.n, expected.mean, expected.std, expected.low, expected.high,
    ]  # fmt: skip
    assert (first["n_ok"], first["n_repeats"], first["seeds"]) == ("4", "4", "1 2 3 4")
    last = lines[-1]
    assert (last["n"], last["mean"], last["n_missing"], last["n_ok"]) == ("0", "", "4", "0")
    assert float(last["rate_high"]) == rate(0, 4).high


def test_the_summary_of_one_repeat_has_no_limits_but_those_of_the_rate() -> None:
    line = next(csv.DictReader(io.StringIO(summary_text(one_level_result()))))
    assert (line["n"], line["std"], line["low"], line["rate_high"]) == ("1", "", "", "1.0")


def test_the_old_name_of_the_intervals_works_and_warns() -> None:
    with pytest.warns(DeprecationWarning, match="use 'intervals_of'"):
        found = per_level(two_seeds(), "corners")
    assert found == intervals_of(two_seeds(), "corners")
