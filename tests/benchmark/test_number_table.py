"""CSV files that a benchmark names: paths and recorded truths."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.support.fakes import FakeWorld
from uwsim.benchmark.recorded_truth import RecordedTruthSpec
from uwsim.benchmark.reference_path import ReferencePathSpec, path_message
from uwsim.errors import UwsimError

NO_WORLD = FakeWorld({})


def benchmark(folder: Path, text: str) -> str:
    (folder / "t.csv").write_text(text)
    return str(folder / "b.xml")


def test_the_points_of_a_file_are_its_columns_in_any_order(tmp_path: Path) -> None:
    file = benchmark(tmp_path, "z [m],note,x [m],y\n4,,1,2\n\n5,image7.png,1.5,-2e0\n")
    points = ReferencePathSpec(file="t.csv").read(file, NO_WORLD)
    np.testing.assert_array_equal(points, [[1.0, 2.0, 4.0], [1.5, -2.0, 5.0]])
    message = path_message(points)
    assert [pose.pose.position.y for pose in message.poses] == [2.0, -2.0]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("x [m],y [m],z [mm]\n1,2,3\n", r"the column 'z' is in 'mm'; expected \[m\]"),
        ("x[km],y,z\n1,2,3\n", r"the column 'x' is in 'km'; expected \[m\]"),
        ("x,y\n1,2\n", r"no column 'z'; it has x, y"),
        ("x,y,zz\n1,2,3\n", r"Did you mean 'zz'"),
        ("x,y,z\n1,2\n", r"t\.csv:2: has 2 cells; expected 3"),
        ("x,y,z\n1,two,3\n", r"t\.csv:2: 'two' is no finite number"),
        ("x,y,z\n1,inf,3\n", r"t\.csv:2: 'inf' is no finite number \(column y\)"),
        ("x,y,z\n1,2,3\n1,-,a\n1,b,3\n", r"t\.csv:3: '-' is no finite number \(column y\)"),
        ("x,y,z\n1,,3\n", r"expected finite numbers up to 1e\+06 m"),
        ("x,y,z\n1,1e9,3\n", r"expected finite numbers"),
        ("x,y,z\n", r"has no point"),
        ("x,x,z\n1,2,3\n", r"expected a line of different names"),
        ("", r"expected a line of different names"),
    ],
)
def test_a_file_that_is_no_path_says_where(text: str, said: str, tmp_path: Path) -> None:
    file = benchmark(tmp_path, text)
    with pytest.raises(UwsimError, match=said):
        ReferencePathSpec(file="t.csv").read(file, NO_WORLD)


def test_a_file_is_searched_in_the_folder_of_the_benchmark_only(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    file = benchmark(tmp_path, "x,y,z\n1,2,3\n")
    with pytest.raises(UwsimError, match=r"u\.csv.*is not in the folder"):
        ReferencePathSpec(file="u.csv").read(file, NO_WORLD)


@pytest.mark.parametrize(
    ("spec", "said"),
    [
        (ReferencePathSpec(), "needs one of <u:points>, <u:file> and <u:object>"),
        (ReferencePathSpec(points=(1.0, 2.0, 3.0), file="t.csv"), "needs one of"),
        (ReferencePathSpec(points=(1.0, 2.0, 3.0), height=1.0), "is that above an <u:object>"),
        (ReferencePathSpec(points=(1.0, 2.0)), "has 2 numbers; expected x y z"),
        (ReferencePathSpec(points=(1.0, 2.0, 1e7)), "beyond 1e+06 m"),
    ],
)
def test_points_that_are_no_path_are_errors(spec: ReferencePathSpec, said: str) -> None:
    (message,) = spec.errors()
    assert said in message


TRUTH = "u,time [s],v\n10,0.0,0\n20,0.5,4\n,1.0,8\n40,1.5,12\n50,2.0,16\n"


@pytest.mark.parametrize(
    ("time", "expected"),
    [
        (0.0, [10.0, 0.0]),
        (0.5004, [20.0, 4.0]),
        (0.25, [15.0, 2.0]),
        (0.75, []),  # the line after it is not whole
        (1.0, []),
        (1.9, [48.0, 15.2]),
        (-0.1, []),
        (2.1, []),
    ],
)
def test_a_recorded_truth_is_linear_between_whole_lines(
    time: float, expected: list[float], tmp_path: Path
) -> None:
    file = benchmark(tmp_path, TRUTH)
    truth = RecordedTruthSpec(file="t.csv", topic="t").read(file)
    np.testing.assert_allclose(truth.find_values(time), expected)
    chosen = RecordedTruthSpec(file="t.csv", topic="t", columns="v").read(file)
    assert chosen.find_values(1.0).tolist() == [8.0]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("t,u\n0,1\n", "no column 'time'"),
        ("time,u\n0,1\n0,2\n", "does not increase"),
        ("time,u\n,1\n", "does not increase"),
        ("time,u\n", "no line of numbers"),
        ("time [ms],u\n0,1\n", r"'time' is in 'ms'; expected \[s\]"),
        ("time\n0\n", "no line of numbers"),
    ],
)
def test_a_file_that_is_no_truth_says_why(text: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(UwsimError, match=said):
        RecordedTruthSpec(file="t.csv", topic="t").read(benchmark(tmp_path, text))
