"""The table a benchmark ends with."""

from __future__ import annotations

import io

import pytest
from rich.console import Console
from synthetic_results import WHY, nested, nothing_measured, one_level, visibility

from uwsim.benchmark.result import Column, Result
from uwsim.benchmark.table import exact_decimals, lines, sensible_decimals, table


def text(result: Result, width: int = 160) -> list[str]:
    console = Console(width=width, file=io.StringIO())
    console.print(table(result, width=width))
    assert isinstance(console.file, io.StringIO)
    return [line.rstrip() for line in console.file.getvalue().splitlines()]


def test_every_level_is_a_line_and_a_gap_has_its_reason() -> None:
    drawn = text(visibility())
    assert len(drawn) == 29
    assert drawn[0].split() == ["fog", "corners", "centroid", "total", "time"]
    assert drawn[1].split() == ["[1/m]", "[px]", "[px]", "[s]", "status"]
    assert drawn[3].split()[0] == "0.05"
    assert drawn[3].split()[-1] == "ok"
    assert drawn[26].split()[:5] == ["1.20", "-", "-", "-", "50.0"]
    assert drawn[26].endswith(WHY)
    assert drawn[27].endswith("as above")


def test_on_a_narrow_terminal_reasons_stand_below_and_nothing_is_cut() -> None:
    drawn = text(visibility(), width=60)
    assert len(drawn) == 29 + 2
    assert "…" not in "".join(drawn)
    assert " ".join(drawn[29:]) == f"1.20 to 1.30: {WHY}"


def test_repeats_are_gathered_into_mean_and_interval() -> None:
    drawn = lines(visibility(seeds=(1, 2, 3, 4)))
    assert len(drawn) == 27
    assert "±" in drawn[0].cells[1]
    assert drawn[0].status == "4 of 4 ok"
    assert drawn[26].status == "0 of 4 ok"
    assert drawn[26].why == "4 lost"


def test_a_benchmark_that_measured_nothing_still_has_its_table() -> None:
    assert {line.cells[1] for line in lines(nothing_measured())} == {"-"}


def test_one_level_and_nested_levels_have_tables() -> None:
    assert len(lines(one_level())) == 1
    assert [line.cells[:2] for line in lines(nested())][27] == ("0.1", "0.00")


def test_markup_in_a_name_is_shown_not_obeyed() -> None:
    result = Result(
        inputs={},
        run={},
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
