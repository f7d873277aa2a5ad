"""The original's result.dat, to the letter."""

from __future__ import annotations

from pathlib import Path

from uwsim.benchmark.original_format import dat_text, save_dat
from uwsim.benchmark.result import Column, Result

RESULT = Result(
    inputs={},
    run={},
    columns=(
        Column(name="iteration", kind="level"),
        Column(name="fog", kind="level", unit="1/m"),
        Column(name="corners", kind="measure", unit="px"),
        Column(name="corners.mean", kind="detail", unit="px"),
        Column(name="total", kind="score"),
        Column(name="status", kind="status"),
        Column(name="ended_at", kind="time", unit="s"),
    ),
    rows=(
        (0, 0.0, 1.23456789, 1.0, 1.23456789, "ok", 2.0),
        (0, 0.15000000000000002, 1e-7, 1.0, 1234567.0, "ok", 4.002),
        (1, 1.3, None, None, None, "lost", 6.0),
        (1, 1.35, 0.5, 0.5, None, "ok", 8.0),
    ),
)


def test_every_field_is_followed_by_a_tab_and_numbers_have_six_digits() -> None:
    assert dat_text(RESULT).split("\n") == [
        "Iteration\tFog\tcorners\tTOTAL\tSimTime\t",
        "0\t0\t1.23457\t1.23457\t2\t",
        "0\t0.15\t1e-07\t1.23457e+06\t4.002\t",
        "1\t1.3\tnan\tnan\t6\t",
        "1\t1.35\t0.5\tnan\t8\t",
        "",
    ]


def test_rows_in_error_are_left_out_only_where_the_original_is_asked_for() -> None:
    lines = dat_text(RESULT, compatibility=frozenset({"rows"})).split("\n")
    assert lines[3:] == ["1\t1.35\t0.5\t8\t", ""]


def test_it_lies_beside_the_result(tmp_path: Path) -> None:
    assert save_dat(RESULT, tmp_path) == tmp_path / "result.dat"
    assert (tmp_path / "result.dat").read_text() == dat_text(RESULT)
