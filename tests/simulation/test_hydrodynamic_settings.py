"""Numbers of hydrodynamics files are set from outside and drawn for each seed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import uwsim
from uwsim.assets.bundled import scene_file
from uwsim.cli import main
from uwsim.errors import UwsimError
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation

SCENE = "currents-scene"
SET = "vehicle[girona500].hydrodynamics."
BASE = f"{SET}body[base_link]."


def numbers(seed: int = 0, **changed: str | float) -> dict[str, tuple[float, ...]]:
    """The numbers of the base, and the first thruster's curve, with settings."""
    settings = {path.replace("__", "."): value for path, value in changed.items()}
    with uwsim.load(SCENE, seed=seed, settings=settings) as simulation:
        return of(simulation)


def of(simulation: Simulation) -> dict[str, tuple[float, ...]]:
    (dynamics,) = simulation.world.model.dynamics.values()
    body = dynamics.body("base_link")
    assert body is not None
    return {
        "mass": (body.mass or 0.0,),
        "volume": (body.volume,),
        "addedMass": tuple(body.added_mass),
        "quadraticDamping": tuple(body.quadratic_damping),
        "forward": tuple(dynamics.thrusters[0].forward),
    }


def with_setting(path: str, value: str | float) -> dict[str, tuple[float, ...]]:
    with uwsim.load(SCENE, settings={path: value}) as simulation:
        return of(simulation)


@pytest.mark.parametrize(("number", "value"), [("mass", 190.0), ("volume", 0.21), ("volume", 0.17)])
def test_a_number_of_a_body_is_set(number: str, value: float) -> None:
    before, after = numbers(), with_setting(BASE + number, value)
    assert after[number] == (value,)
    assert {k: v for k, v in after.items() if k != number} == {
        k: v for k, v in before.items() if k != number
    }


@pytest.mark.parametrize(("index", "factor"), [(1, 2.0), (3, 0.5)])
@pytest.mark.parametrize("number", ["addedMass", "quadraticDamping"])
def test_one_number_of_a_list_is_set(number: str, index: int, factor: float) -> None:
    before = numbers()[number]
    value = before[index - 1] * factor
    after = with_setting(f"{BASE}{number}.{index}", value)[number]
    expected = [*before[: index - 1], value, *before[index:]]
    assert after == pytest.approx(expected)


def test_a_whole_list_is_set() -> None:
    with uwsim.load(SCENE) as simulation:
        (dynamics,) = simulation.world.model.dynamics.values()
        name = dynamics.thrusters[0].name
    assert with_setting(f"{SET}thruster[{name}].forward", "0 33 4")["forward"] == (0.0, 33.0, 4.0)


def test_a_heavier_vehicle_falls(tmp_path: Path) -> None:
    depths = []
    for mass in (180.0, 260.0):
        with uwsim.load(SCENE, settings={BASE + "mass": mass}) as simulation:
            before = simulation.pose("girona500", frame="W").position[2]
            simulation.advance(0.2)
            depths.append(simulation.pose("girona500", frame="W").position[2] - before)
    assert depths[1] < depths[0] - 1e-4


@pytest.mark.parametrize(
    ("path", "value", "said"),
    [
        (BASE + "mas", "190", r"no <mas>\. Did you mean"),
        (SET + "body[base_lnk].mass", "190", r"base_lnk.*base_link"),
        (BASE + "mass", "-1", "mass"),
        (BASE + "addedMass.7", "1", "has 6 numbers; expected one of them"),
        (BASE + "mass", "heavy", "heavy"),
        (SET.rstrip("."), "1", "is not a value; continue with"),
    ],
)
def test_a_setting_that_is_wrong_is_an_error(path: str, value: str, said: str) -> None:
    with pytest.raises(UwsimError, match=said):
        uwsim.load(SCENE, settings={path: value})


def test_a_vehicle_without_dynamics_has_no_such_numbers() -> None:
    with pytest.raises(UwsimError, match=r"has no <u:dynamics>"):
        uwsim.load("visibility-scene", settings={BASE + "mass": 100.0})


def varied(folder: Path, path: str, low: float, high: float) -> Path:
    """The scene with one number more that varies."""
    text = scene_file(SCENE).read_text()
    vary = (
        f"<u:uniform> <u:path>{path}</u:path> <u:low>{low}</u:low> <u:high>{high}</u:high> "
        "</u:uniform>"
    )
    if "</u:vary>" in text:
        text = text.replace("</u:vary>", f"{vary}</u:vary>")
    else:
        end = text.rindex("</UWSimScene>")
        text = f"{text[:end]}<u:vary>{vary}</u:vary>{text[end:]}"
    file = folder / "scene.xml"
    file.write_text(text)
    return file


@pytest.mark.parametrize(
    ("number", "low", "high", "index"),
    [("volume", 0.18, 0.22, 0), ("quadraticDamping.2", 500.0, 900.0, 1)],
)
def test_a_number_varies_from_seed_to_seed_within_its_bounds(
    number: str, low: float, high: float, index: int, tmp_path: Path
) -> None:
    file = varied(tmp_path, BASE + number, low, high)
    drawn = []
    with uwsim.load(file, seed=1) as simulation:
        for seed in (1, 2, 1):
            simulation.reset(seed=seed)
            drawn.append(of(simulation)[number.partition(".")[0]][index])
    assert drawn[0] == drawn[2] != drawn[1]
    assert all(low <= value <= high for value in drawn)
    fixed = {BASE + number: low}
    with uwsim.load(file, seed=1, settings=fixed) as simulation:
        np.testing.assert_allclose(of(simulation)[number.partition(".")[0]][index], low)


@pytest.mark.parametrize(
    ("path", "said"),
    [("body[base_link].mss", "no <mss>"), ("body[base_link].addedMass", "not one number")],
)
def test_check_reports_a_variation_that_leads_nowhere(
    path: str, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = varied(tmp_path, SET + path, 1.0, 2.0)
    assert read_scene(file).vary
    assert main(["check", str(file)]) == 2
    assert said in capsys.readouterr().out
