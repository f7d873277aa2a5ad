"""u:seaStateUpdater: the height of a scene's waves, level by level."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from tests.support.short_trial import DATA, make_plan, rows_of, tank
from uwsim.benchmark.reader import read_benchmark
from uwsim.benchmark.updater_settings import apply_updater_setting
from uwsim.benchmark.updaters import (
    Level,
    SeaStateUpdaterSpec,
    apply_level,
    bind_updaters,
    blend,
    levels,
    ramp_level,
)
from uwsim.bus import Node
from uwsim.checks.check import check_file
from uwsim.errors import BadSetting, UwsimError
from uwsim.runs.prepare import hash_inputs
from uwsim.scene.spec import SceneSpec
from uwsim.waves import JonswapSpec

SPEC = SeaStateUpdaterSpec(initial_value=0.0, final_value=1.0, step=0.25, interval=1.0)
UPDATER = """<u:seaStateUpdater> <initialValue>0.2</initialValue> <finalValue>0.6</finalValue>
<step>0.4</step> <interval>{}</interval> </u:seaStateUpdater>"""


def sea(height: float = 0.5) -> SceneSpec:
    """Return a tank with a wind sea."""
    scene, waves = tank(), JonswapSpec(significant_height=height, peak_period=4.0, n_components=40)
    return replace(scene, ocean_state=replace(scene.ocean_state, waves=(waves,)))


class Idle:
    """Does nothing at all."""

    def start(self, node: Node) -> None:
        pass


def test_its_values_are_heights_in_metres() -> None:
    assert [level.values for level in levels(SPEC)] == [
        (("waveHeight", 0.25 * i),) for i in range(5)
    ]
    assert SPEC.parameter_unit == "m"


def test_the_final_height_is_a_level_whatever_the_sum_rounds_to() -> None:
    thirds = replace(SPEC, final_value=0.6, step=0.2)  # 0.2 + 0.2 + 0.2 > 0.6
    assert thirds.values() == pytest.approx((0.0, 0.2, 0.4, 0.6))
    assert replace(SPEC, final_value=0.59, step=0.2).values() == pytest.approx((0.0, 0.2, 0.4))
    with pytest.raises(BadSetting, match="more than 100000 levels"):
        replace(SPEC, step=1e-6).values()


def test_a_level_scales_the_same_waves() -> None:
    simulation = open_scene(sea())
    waves = simulation.world.water.waves
    assert waves is not None
    updaters = bind_updaters(SPEC, simulation.world.stage_view)
    points = np.random.default_rng(1).uniform(-20.0, 20.0, (30, 2))
    elevations = []
    for height in (0.5, 0.0, 1.0):
        apply_level(updaters, Level((("waveHeight", height),)))
        elevations.append(waves.elevation(points, 3.0))
    assert not elevations[1].any()
    np.testing.assert_allclose(elevations[2], 2.0 * elevations[0], rtol=1e-12)


def test_an_independent_level_grows_from_the_first_height() -> None:
    simulation = open_scene(sea(0.8))
    waves = simulation.world.water.waves
    assert waves is not None
    point, level = np.array([[3.0, 1.0]]), Level((("waveHeight", 0.8),))
    full = waves.elevation(point, 0.0)[0]
    updaters = bind_updaters(SPEC, simulation.world.stage_view)
    for fraction in (0.0, 0.25, 1.0):
        ramp_level(updaters, blend(SPEC, level, fraction))
        assert waves.elevation(point, 0.0)[0] == pytest.approx(fraction * full, abs=1e-15)


@pytest.mark.parametrize("mode", ["sequential", "independent"])
def test_rows_state_the_height(tmp_path: Path, mode: str) -> None:
    plan = make_plan(tmp_path, Idle, UPDATER.format(0.1), scene=sea(), mode=mode)  # type: ignore[arg-type]
    rows = rows_of(plan)
    assert [row.values for row in rows] == [(("waveHeight", 0.2),), (("waveHeight", 0.2 + 0.4),)]
    assert {row.status for row in rows} == {"ok"}


@pytest.mark.parametrize(
    "scene", [tank(), sea(0.0)], ids=["without waves", "with waves of height 0"]
)
def test_a_scene_without_waves_is_an_error_before_the_run(tmp_path: Path, scene: SceneSpec) -> None:
    plan = make_plan(tmp_path, Idle, UPDATER.format(1), scene=scene)
    with pytest.raises(UwsimError) as error:
        hash_inputs(plan)
    assert "no waves whose height could change; expected <u:waves>" in str(error.value)
    assert "benchmark.xml:3:" in str(error.value)  # the line of the updater


def test_check_finds_the_lack_of_waves_in_a_scene_it_is_given(tmp_path: Path) -> None:
    make_plan(tmp_path, Idle, UPDATER.format(1))
    scene = DATA / "scenes" / "visibility-scene.xml"
    diagnostics = check_file(tmp_path / "benchmark.xml", scene=scene)
    found = [diagnostic for diagnostic in diagnostics if diagnostic.severity == "error"]
    assert [(Path(each.file).name, each.line) for each in found] == [("benchmark.xml", 3)]
    assert "no waves whose height could change" in found[0].message


@pytest.mark.parametrize(
    ("element", "value", "message"),
    [
        ("initialValue", "-0.1", "expected a number >= 0 and <= 40"),
        ("finalValue", "41", "expected a number >= 0 and <= 40"),
        ("step", "0", "expected a number > 0"),
        ("finalValue", "0.1", "<finalValue> 0.1 is below <initialValue> 0.2: no level"),
    ],
)
def test_a_height_that_cannot_be_is_an_error(
    tmp_path: Path, element: str, value: str, message: str
) -> None:
    text = re.sub(f"<{element}>[^<]*<", f"<{element}>{value}<", UPDATER.format(1))
    with pytest.raises(UwsimError, match=re.escape(message)):
        make_plan(tmp_path, Idle, text, scene=sea())


def test_its_path_is_written_without_a_prefix(tmp_path: Path) -> None:
    make_plan(tmp_path, Idle, UPDATER.format(1), scene=sea())
    benchmark = read_benchmark(tmp_path / "benchmark.xml")
    changed = apply_updater_setting(benchmark, "seaStateUpdater.settlingTime", "2")
    assert changed.scene_updater.settling_time == 2.0
