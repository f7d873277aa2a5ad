"""The original's result.dat and its logs, to the letter."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import pytest

from uwsim.benchmark.ground_truth import ConstantSpec
from uwsim.benchmark.measures import (
    CollisionSpec,
    DistanceSpec,
    EuclideanNormSpec,
    MeasureSpec,
    ObjectCenteredOnCamSpec,
    PathFollowingSpec,
    PositionErrorSpec,
    Reconstruction3DSpec,
    TimeSpec,
)
from uwsim.results.inputs import Inputs
from uwsim.results.log import Log
from uwsim.results.result import Column, Result
from uwsim.results.run_info import RunInfo
from uwsim.runs.uwsim_files import dat_text, data_text, detail_names, save_dat, save_data

CORNERS = EuclideanNormSpec(
    name="corners", ground_truth=ConstantSpec(values=(1.0, 2.0)), target="t"
)
RESULT = Result(
    inputs=Inputs(),
    run=RunInfo(),
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


REBUILT = Reconstruction3DSpec(
    name="cloud", target="b", topic="t", from_="f", detailed_results_to_globals=True
)
RECONSTRUCTION = Result(
    inputs=Inputs(),
    run=RunInfo(),
    columns=(
        Column(name="light", kind="level"),
        Column(name="taskTime", kind="measure", unit="s"),
        Column(name="cloud", kind="measure", unit="m"),
        Column(name="cloud.mean_error", kind="detail", unit="m"),
        Column(name="cloud.error_variance", kind="detail", unit="m^2"),
        Column(name="cloud.coverage", kind="detail"),
        Column(name="cloud.outlier_share", kind="detail"),
        Column(name="cloud.n_inliers", kind="detail"),
        Column(name="total", kind="score"),
        Column(name="ended_at", kind="time", unit="s"),
    ),
    rows=(
        (0.0, 20.0, 0.02, 0.02, 0.0004, 0.5, 0.25, 3.0, 0.02, 20.0),
        (1.0, 20.0, 0.02, 0.02, None, 0.25, 0.0, 1.0, 0.02, 40.0),
        (2.0, 20.0, None, None, None, 0.0, 1.0, 0.0, None, 60.0),
    ),
)


def test_details_take_the_place_of_their_measure_where_the_file_asks_for_it() -> None:
    assert dat_text(RECONSTRUCTION, measures=(TimeSpec(name="taskTime"), REBUILT)).split("\n") == [
        "Light\ttaskTime\tmean error\terror variance\tcoverage %\toutliers %\tTOTAL\tSimTime\t",
        "0\t20\t0.02\t0.0004\t0.5\t0.25\t0.02\t20\t",
        "1\t20\t0.02\tnan\t0.25\t0\t0.02\t40\t",
        "2\t20\tnan\tnan\t0\t1\tnan\t60\t",
        "",
    ]
    plain = dataclasses.replace(REBUILT, detailed_results_to_globals=False)
    assert dat_text(RECONSTRUCTION, measures=(plain,)).split("\n")[:2] == [
        "Light\ttaskTime\tcloud\tTOTAL\tSimTime\t",
        "0\t20\t0.02\t0.02\t20\t",
    ]


def test_a_reconstruction_without_points_is_no_error_in_the_original() -> None:
    rows = dat_text(RECONSTRUCTION, compatibility=frozenset({"rows"}), measures=(REBUILT,)).split(
        "\n"
    )
    assert rows[1:] == [
        "0\t20\t0.02\t0.0004\t0.5\t0.25\t0.02\t20\t",
        "1\t20\t0.02\tnan\t0.25\t0\t0.02\t40\t",
        "2\t20\t0\t0\t0\t1\t60\t",
        "",
    ]


def test_a_missing_path_cancels_a_missing_estimate_in_the_original() -> None:
    path = PathFollowingSpec(name="path", target="g")
    result = Result(
        inputs=Inputs(),
        run=RunInfo(),
        columns=(
            Column(name="none", kind="level"),
            Column(name="corners", kind="measure", unit="px"),
            Column(name="path", kind="measure", unit="m s"),
            Column(name="total", kind="score"),
            Column(name="ended_at", kind="time", unit="s"),
        ),
        rows=(
            (1.0, None, None, None, 2.0),
            (1.0, None, 3.0, None, 4.0),
            (1.0, 2.0, None, None, 6.0),
            (1.0, 2.0, 3.0, 5.0, 8.0),
        ),
    )
    quirk = frozenset({"rows"})
    assert dat_text(result, compatibility=quirk, measures=(CORNERS, path)).split("\n") == [
        "None\tcorners\tpath\tTOTAL\tSimTime\t",
        "1\t-1\t0\t2\t",
        "1\t2\t3\t5\t8\t",
        "",
    ]
    assert dat_text(result, measures=(CORNERS, path)).split("\n")[1] == "1\tnan\tnan\tnan\t2\t"


def measured(spec: MeasureSpec, value: float | None, *others: float | None) -> Result:
    """A row with a measure and a distance called d, and their sum as the score."""
    return Result(
        inputs=Inputs(),
        run=RunInfo(),
        columns=(
            Column(name="none", kind="level"),
            Column(name=spec.name, kind="measure"),
            Column(name="d", kind="measure", unit="m"),
            Column(name="total", kind="score", expression=f"{spec.name}+d"),
            Column(name="ended_at", kind="time", unit="s"),
        ),
        rows=((1.0, value, 3.0, None if value is None else value + 3.0, 2.0),),
    )


DISTANCE = DistanceSpec(name="d", target="g")


@pytest.mark.parametrize(
    ("spec", "start"),
    [
        (TimeSpec(name="m"), "0"),
        (DistanceSpec(name="m", target="g"), "0"),
        (CollisionSpec(name="m", target="g"), "1"),
        (ObjectCenteredOnCamSpec(name="m", target="b", camera="c"), "0"),
        (PositionErrorSpec(name="m", target="g", position=(0.0, 0.0, 0.0)), "100"),
        (PositionErrorSpec(name="m", target="g", position=(0.0, 0.0, 0.0), topic="t"), "-1"),
        (Reconstruction3DSpec(name="m", target="b", topic="t", from_="f"), "0"),
    ],
)
def test_only_norms_and_paths_are_errors_in_the_original(spec: MeasureSpec, start: str) -> None:
    """What never measured anything has its start value there, and its row is written."""
    quirk = frozenset({"rows"})
    lines = dat_text(measured(spec, None), compatibility=quirk, measures=(spec, DISTANCE))
    assert lines.split("\n")[1:] == [f"1\t{start}\t3\t{float(start) + 3:g}\t2\t", ""]


@pytest.mark.parametrize("spec", [CORNERS, PathFollowingSpec(name="path", target="g")])
def test_a_missing_estimate_and_a_missing_path_are_errors_in_the_original(
    spec: MeasureSpec,
) -> None:
    lines = dat_text(
        measured(spec, None), compatibility=frozenset({"rows"}), measures=(spec, DISTANCE)
    )
    assert lines.split("\n")[1:] == [""]


def test_it_lies_beside_the_result(tmp_path: Path) -> None:
    assert save_dat(RESULT, tmp_path) == tmp_path / "result.dat"
    assert (tmp_path / "result.dat").read_text() == dat_text(RESULT)


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
        (REBUILT, 4, ("mean error", "error variance", "coverage %", "outliers %")),
        (PathFollowingSpec(name="p", target="g"), 5, ("ISE", "distanceToPath", "waypoint")),
    ],
)
def test_details_are_called_as_the_original_calls_them(
    spec: MeasureSpec, n_logged: int, names: tuple[str, ...]
) -> None:
    assert detail_names(spec, n_logged) == names


def test_a_log_lies_beside_the_result_under_the_originals_name(tmp_path: Path) -> None:
    assert save_data(LOG, CORNERS, tmp_path) == tmp_path / "benchmark-corners.data"
    assert (tmp_path / "benchmark-corners.data").read_text() == data_text(LOG, CORNERS)
