"""A user's own function as a current, and what is said when it is not one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from uwsim.base.rng import stream
from uwsim.currents import PythonFunction, PythonFunctionSpec, SceneContext
from uwsim.errors import BadSetting

CODE = """
def eddy(point, time, vehicle):
    x, y, z = point
    return -0.1 * y, 0.1 * x, 0.01 * time

def heavy(point, time, vehicle):
    point[:] = 0.0
    return (1.0 if vehicle == "girona500" else 0.0), 0.0, 0.0

def short(point, time, vehicle):
    return 1.0, 2.0

def wild(point, time, vehicle):
    return 0.0, float("nan"), 0.0

def tsunami(point, time, vehicle):
    return 0.0, 0.0, -1e300

class Odd:
    def __iter__(self):
        raise KeyError("odd")

    def __repr__(self):
        raise OSError("odd")

def odd(point, time, vehicle):
    return Odd()

def leaves(point, time, vehicle):
    raise SystemExit(0)

def broken(point, time, vehicle):
    return 1 / 0
"""


@pytest.fixture(autouse=True)
def my_water(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "my_water_of_the_tests.py").write_text(CODE)
    monkeypatch.syspath_prepend(tmp_path)


def bound(function: str) -> PythonFunction:
    spec = PythonFunctionSpec(function=f"my_water_of_the_tests:{function}")
    return spec.bind(SceneContext(stream=lambda name: stream(0, name)))


def test_it_is_asked_for_every_point() -> None:
    v = bound("eddy").velocity(np.array([[1.0, 0.0, 0.0], [0.0, 2.0, 5.0]]), 3.0)
    assert v == pytest.approx(np.array([[0.0, 0.1, 0.03], [-0.2, 0.0, 0.03]]))


def test_it_knows_the_vehicle_and_cannot_move_the_points() -> None:
    points = np.ones((2, 3))
    v = bound("heavy").velocity(points, 0.0, ("girona500", ""))
    assert v[:, 0].tolist() == [1.0, 0.0]
    assert (points == 1.0).all()
    assert bound("heavy").velocity(points, 0.0)[:, 0].tolist() == [0.0, 0.0]


def test_its_acceleration_is_a_difference_also_at_time_0() -> None:
    for time in (0.0, 4.0):
        a = bound("eddy").acceleration(np.zeros((1, 3)), time)
        assert a == pytest.approx(np.array([[0.0, 0.0, 0.01]]))


@pytest.mark.parametrize(
    ("function", "said"),
    [
        ("short", r"returned \(1\.0, 2\.0\) at \[0\.0, 0\.0, 0\.0\], 0 s; expected three numb"),
        ("wild", "expected three numbers from -100 to 100"),
        ("tsunami", "expected three numbers from -100 to 100"),
        ("leaves", "0 s: SystemExit: 0"),
        ("odd", "returned a Odd at"),
        ("broken", r"raised at \[0\.0, 0\.0, 0\.0\], 0 s: ZeroDivisionError: division by zero"),
    ],
)
def test_what_it_does_wrong_is_reported(function: str, said: str) -> None:
    with pytest.raises(BadSetting, match=said):
        bound(function).velocity(np.zeros((1, 3)), 0.0)


def test_a_function_that_is_not_there_is_an_error() -> None:
    with pytest.raises(BadSetting, match=r"has no function 'edy'. Did you mean 'eddy'"):
        bound("edy")


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("no_such_water:eddy", "there is no module 'no_such_water' on Python's path"),
        ("eddy", "expected 'module:function'"),
        (":eddy", "expected 'module:function'"),
    ],
)
def test_a_module_that_is_not_there_is_an_error(name: str, said: str) -> None:
    with pytest.raises(BadSetting, match=said):
        PythonFunctionSpec(function=name).bind(SceneContext(stream=lambda _: stream(0, "")))
    with pytest.raises(BadSetting, match=said):
        PythonFunctionSpec(function=name).look_up()


def test_a_module_is_looked_for_without_running_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "my_waters_of_the_tests"
    folder.mkdir()
    for name in ("__init__.py", "fjord.py"):
        (folder / name).write_text("1 / 0\n")
    monkeypatch.syspath_prepend(tmp_path)
    PythonFunctionSpec(function="my_waters_of_the_tests.fjord:eddy").look_up()
    with pytest.raises(BadSetting, match=r"no module 'my_waters_of_the_tests\.fjrd'"):
        PythonFunctionSpec(function="my_waters_of_the_tests.fjrd:eddy").look_up()
    with pytest.raises(BadSetting, match=r"no module 'math\.nothing'"):
        PythonFunctionSpec(function="math.nothing:eddy").look_up()


@pytest.mark.parametrize(
    ("code", "said"),
    [
        ("def f(:", "its module raised SyntaxError: invalid syntax"),
        ("1 / 0", "its module raised ZeroDivisionError: division by zero"),
        ("raise SystemExit(0)", "its module raised SystemExit: 0"),
    ],
)
def test_a_module_that_breaks_is_an_error(code: str, said: str, tmp_path: Path) -> None:
    (tmp_path / "my_broken_water_of_the_tests.py").write_text(code)
    spec = PythonFunctionSpec(function="my_broken_water_of_the_tests:f")
    with pytest.raises(BadSetting, match=said):
        spec.bind(SceneContext(stream=lambda name: stream(0, name)))


@pytest.mark.parametrize("function", [".x:f", "a..b:f", "a:", "a b:c", "a:b.c", "../x:f"])
def test_what_names_no_function_is_reported_without_running_anything(function: str) -> None:
    with pytest.raises(BadSetting, match="expected 'module:function'"):
        PythonFunctionSpec(function=function).files(
            SceneContext(stream=lambda name: stream(0, name))
        )
