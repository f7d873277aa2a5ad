"""The table a benchmark ends with."""

from __future__ import annotations

import io
import re
from dataclasses import replace

import pytest
from rich.console import Console

from tests.support.synthetic_results import (
    LOSS_REASON,
    lost_result,
    nested_result,
    one_level_result,
    visibility_result,
)
from uwsim.errors import ResultError
from uwsim.results.inputs import Inputs
from uwsim.results.result import Column, Remark, Result
from uwsim.results.result_file import dumps, loads
from uwsim.results.run_info import RunInfo
from uwsim.results.table import (
    exact_decimals,
    lines,
    number_text,
    sensible_decimals,
    table,
    unit_of,
)


def text(result: Result, width: int = 160) -> list[str]:
    console = Console(width=width, file=io.StringIO())
    console.print(table(result, width=width))
    assert isinstance(console.file, io.StringIO)
    return [line.rstrip() for line in console.file.getvalue().splitlines()]


def test_every_level_is_a_line_and_a_gap_has_its_reason() -> None:
    drawn = text(visibility_result())
    assert len(drawn) == 29
    assert drawn[0].split() == ["fog", "corners", "centroid", "total", "ended_at"]
    assert drawn[1].split() == ["[1/m]", "[px]", "[px]", "[px]", "[s]", "status"]
    assert drawn[3].split()[0] == "0.05"
    assert drawn[3].split()[-1] == "ok"
    assert drawn[26].split()[:5] == ["1.20", "-", "-", "-", "50.0"]
    assert drawn[26].endswith(LOSS_REASON)
    assert drawn[27].endswith("as above")


def test_on_a_narrow_terminal_reasons_stand_below_and_nothing_is_cut() -> None:
    drawn = text(visibility_result(), width=60)
    assert len(drawn) == 29 + 2
    assert "…" not in "".join(drawn)
    assert " ".join(drawn[29:]) == f"1.20 to 1.30: {LOSS_REASON}"


def test_repeats_are_gathered_into_mean_and_interval() -> None:
    drawn = lines(visibility_result(seeds=(1, 2, 3, 4)))
    assert len(drawn) == 27
    assert re.fullmatch(r"\d\.\d+ \[\d\.\d+, \d\.\d+\]", str(drawn[0].cells[1]))
    assert drawn[0].status_text == "4 of 4 ok, 40 to 100 %"
    assert drawn[26].status_text == "0 of 4 ok, 0 to 60 %"
    assert drawn[26].reason == "4 lost"


def test_a_benchmark_that_measured_nothing_still_has_its_table() -> None:
    assert {str(line.cells[1]) for line in lines(lost_result())} == {"-"}


def test_one_level_and_nested_levels_have_tables() -> None:
    assert len(lines(one_level_result())) == 1
    assert [[*map(str, line.cells[:2])] for line in lines(nested_result())][27] == ["0.1", "0.00"]


def test_markup_in_a_name_is_shown_not_obeyed() -> None:
    result = Result(
        inputs=Inputs(),
        run=RunInfo(),
        columns=(Column(name="fog", kind="level"), Column(name="[red]m[/red]", kind="measure")),
        rows=((0.0, 1.0),),
    )
    assert "[red]m[/red]" in text(result)[0]


@pytest.mark.parametrize(
    ("values", "decimals"), [([0.0, 0.05, 0.1], 2), ([0.0, 0.025], 3), ([1.0, 2.0], 0), ([], 0)]
)
def test_levels_show_as_many_decimals_as_tell_them_apart(
    values: list[float], decimals: int
) -> None:
    assert exact_decimals(values) == decimals


@pytest.mark.parametrize(
    ("values", "decimals"), [([1.83, 2.5], 2), ([31.0], 1), ([1200.0], 0), ([1e-9], 4), ([0.0], 2)]
)
def test_measures_show_three_digits(values: list[float], decimals: int) -> None:
    assert sensible_decimals(values) == decimals


def wide_and_failing(seeds: tuple[int, ...] = (1,)) -> Result:
    names = [f"measure{i}" for i in range(8)]
    measures = tuple(Column(name=name, kind="measure", unit="px") for name in names)
    runs = (Column(name="repeat", kind="run"),)
    return Result(
        inputs=Inputs(),
        run=RunInfo(),
        columns=(
            *runs,
            Column(name="fog", kind="level", unit="1/m"),
            *measures,
            Column(name="total", kind="score", expression="+".join(names)),
            Column(name="status", kind="status"),
            Column(name="ended_at", kind="time", unit="s"),
        ),
        rows=tuple(
            (float(seed), 0.0, *[100.5 + seed] * 8, 1.0 + seed, "algorithm error", 2.0)
            for seed in seeds
        ),
    )


@pytest.mark.parametrize("width", [30, 60, 80, 100])
def test_algorithm_error_is_printed_whole_at_any_width(width: int) -> None:
    drawn = text(wide_and_failing(), width=width)
    assert drawn[2].endswith("algorithm error")
    assert "not shown, too narrow: measure" in " ".join(drawn)


def test_with_repeats_time_and_status_stay_whole_at_80_columns() -> None:
    drawn = text(wide_and_failing(seeds=(1, 2, 3, 4)), width=80)
    assert drawn[0].split()[-2:] == ["total", "ended_at"]
    assert drawn[1].split()[-3:] == ["[px]", "[s]", "status"]
    assert drawn[2].endswith("0 of 4 ok, 0 to 60 %")


def test_a_program_that_reads_the_table_gets_every_column() -> None:
    drawn = text(wide_and_failing(), width=1000)
    assert len(drawn[0].split()) == 1 + 8 + 1 + 1
    assert drawn[2].endswith("algorithm error")


@pytest.mark.parametrize(
    ("value", "decimals", "said"),
    [
        (1e38, 0, "1e+38"),
        (-2.5e12, 0, "-2.5e+12"),
        (2.5e-9, 4, "2.5e-09"),
        (1234.0, 0, "1234"),
        (1e-9, 2, "0.00"),
        (0.0, 4, "0.0000"),
    ],
)
def test_very_large_and_very_small_numbers_have_an_exponent(
    value: float, decimals: int, said: str
) -> None:
    assert number_text(value, decimals) == said


@pytest.mark.parametrize(
    ("expression", "unit"), [("a+b", "px"), ("a + c", ""), ("a*b", ""), ("a+1", ""), ("a", "px")]
)
def test_a_sum_of_pixels_is_in_pixels(expression: str, unit: str) -> None:
    total = Column(name="total", kind="score", expression=expression)
    columns = (
        Column(name="a", kind="measure", unit="px"),
        Column(name="b", kind="measure", unit="px"),
        Column(name="c", kind="measure", unit="m"),
        total,
    )
    result = Result(inputs=Inputs(), run=RunInfo(), columns=columns, rows=())
    assert unit_of(result, total) == unit


REMARK = "corners: all estimates are exactly the start"


def test_a_remark_stands_beside_the_status_of_a_row_that_has_all_values() -> None:
    result = replace(visibility_result(), remarks=(Remark(row=0, text=REMARK),))
    drawn = text(result)
    assert drawn[2].split()[5] == "ok"
    assert drawn[2].endswith(REMARK)
    assert drawn[3].split()[-1] == "ok"
    assert loads(dumps(result)) == result
    assert "remarks" not in dumps(visibility_result())


def test_over_repeats_it_is_said_of_how_many_a_remark_is() -> None:
    rows = [Remark(row=row, text=REMARK) for row in (0, 27)]
    drawn = lines(replace(visibility_result(seeds=(1, 2, 3, 4)), remarks=tuple(rows)))
    assert [line.reason for line in drawn if line.reason.endswith(REMARK)] == [f"2 of 4: {REMARK}"]


def test_a_remark_about_a_row_that_is_not_there_is_an_error() -> None:
    with pytest.raises(ResultError, match=r"remarks\[0\] is about row 99, which is not there"):
        replace(visibility_result(), remarks=(Remark(row=99, text=REMARK),))
