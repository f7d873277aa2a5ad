"""The original's result.dat and its logs, to the letter."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.benchmark.ground_truth import ConstantSpec
from uwsim.benchmark.logs import Log
from uwsim.benchmark.measures import (
    CollisionSpec,
    DistanceSpec,
    EuclideanNormSpec,
    MeasureSpec,
    ObjectCenteredOnCamSpec,
    PositionErrorSpec,
    TimeSpec,
)
from uwsim.benchmark.original_format import (
    dat_text,
    data_text,
    detail_names,
    save_dat,
    save_data,
)
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


CORNERS = EuclideanNormSpec(
    name="corners", ground_truth=ConstantSpec(values=(1.0, 2.0)), target="t"
)
LOG = Log(
    measure="corners",
    header=("iteration", "fog [1/m]", "time [s]", "total", "1", "2"),
    samples=((0, 0.0, 0.1, 5.0, 3.0, -4.0), (0, 0.05, 2.123456789, None, None, None)),
)


def test_a_log_has_the_outermost_updaters_name_over_the_running_time() -> None:
    assert data_text(LOG, CORNERS).split("\n") == [
        "Iteration\tcorners_total\tcorners[]\tcorners[]\t",
        "0.1\t5\t3\t-4\t",
        "2.12346\tnan\tnan\tnan\t",
        "",
        "",
    ]


def test_repeats_lead_a_log_as_they_lead_the_result() -> None:
    log = Log(
        measure="corners",
        header=("repeat", "seed", "fog [1/m]", "time [s]", "total", "1", "2"),
        samples=((1, 8, 0.3, 0.1, 5.0, 3.0, -4.0),),
    )
    assert data_text(log, CORNERS).split("\n")[:2] == [
        "repeat\tseed\tFog\tcorners_total\tcorners[]\tcorners[]\t",
        "1\t8\t0.1\t5\t3\t-4\t",
    ]


@pytest.mark.parametrize(
    ("spec", "n_logged", "names"),
    [
        (TimeSpec(name="t"), 1, ("t",)),
        (DistanceSpec(name="d", target="g"), 1, ("d",)),
        (CollisionSpec(name="c", target="g"), 4, ("c",)),
        (CORNERS, 3, ("corners_total", "corners[]", "corners[]")),
        (
            ObjectCenteredOnCamSpec(name="o", target="b", camera="c"),
            3,
            ("o_total", "o_x", "o_y"),
        ),
        (
            PositionErrorSpec(name="p", target="g", position=(0.0, 0.0, 0.0)),
            8,
            ("total", "x", "y", "z", "rx", "ry", "rz", "rw"),
        ),
    ],
)
def test_details_are_called_as_the_original_calls_them(
    spec: MeasureSpec, n_logged: int, names: tuple[str, ...]
) -> None:
    assert detail_names(spec, n_logged) == names


def test_a_log_lies_beside_the_result_under_the_originals_name(tmp_path: Path) -> None:
    assert save_data(LOG, CORNERS, tmp_path) == tmp_path / "benchmark-corners.data"
    assert (tmp_path / "benchmark-corners.data").read_text() == data_text(LOG, CORNERS)
