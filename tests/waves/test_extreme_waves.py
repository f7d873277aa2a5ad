"""Seas at the limits of what a file may ask for: finite numbers, or a clear error."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from tests.waves.test_bodies_in_waves import SEA, WAVE, open_floats, position_of
from uwsim.errors import SceneError, UwsimError
from uwsim.scene.reader import read_scene

JONSWAP = (
    "<u:jonswap><u:significantHeight>{}</u:significantHeight><u:peakPeriod>{}</u:peakPeriod>"
    "<u:components>{}</u:components></u:jonswap>"
)
SEAS = {
    "height 0": WAVE.format(0, 5) + JONSWAP.format(0, 5, 200),
    "the longest period": WAVE.format(1, 60) + JONSWAP.format(1, 60, 200),
    "the shortest period": WAVE.format(0.01, 0.2) + JONSWAP.format(0.01, 0.2, 200),
    "the highest waves": JONSWAP.format(40, 15, 200),
    "one component": JONSWAP.format(1, 5, 1),
    "4000 components": JONSWAP.format(1, 5, 4000),
    "a storm": "<u:piersonMoskowitz><u:windSpeed>40</u:windSpeed></u:piersonMoskowitz>",
    "a breath": "<u:piersonMoskowitz><u:windSpeed>0.5</u:windSpeed></u:piersonMoskowitz>",
    "uwsim's": "<u:uwsimOcean/>",
}


@pytest.mark.parametrize("waves", SEAS.values(), ids=SEAS)
def test_a_float_has_a_pose_in_every_sea(tmp_path: Path, waves: str) -> None:
    simulation = open_floats(tmp_path, waves, "box")
    simulation.advance(0.5)
    assert np.isfinite(position_of(simulation, "box")).all()
    water = simulation.world.water.waves
    assert water is not None
    motion = water.motion(np.array([[0.0, 0.0, -1.0], [1e5, -1e5, -59.9]]), 1e5)
    for name in ("elevation", "slope", "velocity", "acceleration", "gradient", "dynamic_pressure"):
        assert np.isfinite(getattr(motion, name)).all(), name


@pytest.mark.parametrize("z", [-75.0, 4.0], ids=["below the sea floor", "thrown out of the water"])
def test_a_body_far_from_the_water_between_floor_and_surface_has_a_pose(
    tmp_path: Path, z: float
) -> None:
    simulation = open_floats(tmp_path, SEA, "sphere", z=z)
    heights = []
    for _ in range(40):
        simulation.advance(0.25)
        heights.append(position_of(simulation, "sphere")[2])
    assert np.isfinite(heights).all()
    assert heights[-1] > z if z < 0.0 else abs(heights[-1]) < 1.0  # it rises, or fell and floats


def test_the_water_beyond_the_sea_floor_moves_as_at_the_floor(tmp_path: Path) -> None:
    waves = open_floats(tmp_path, SEA, "sphere").world.water.waves
    assert waves is not None
    motion = waves.motion(np.array([[1.0, 2.0, -60.0], [1.0, 2.0, -600.0]]), 3.0)
    assert motion.velocity[0].tobytes() == motion.velocity[1].tobytes()
    assert abs(motion.velocity[0, 2]) < 1e-12


@pytest.mark.parametrize("depth", ["0", "-5", "1e9"])
def test_waves_need_water_of_a_depth(tmp_path: Path, depth: str) -> None:
    open_floats(tmp_path, SEA, "sphere").close()
    file = tmp_path / "scene.xml"
    file.write_text(file.read_text().replace("<depth>60</depth>", f"<depth>{depth}</depth>"))
    with pytest.raises(SceneError, match=r":2: <depth> is .*; <u:waves> expects a depth > 0"):
        read_scene(file)
    file.write_text(file.read_text().replace(f"<u:waves>{SEA}</u:waves>", ""))
    read_scene(file)  # without waves the depth has no effect


@pytest.mark.parametrize(
    ("waves", "message"),
    [
        (WAVE.format(-1, 5), "<u:height> is '-1'; expected a number >= 0 and <= 40"),
        (WAVE.format(1, 0), "<u:period> is '0'; expected a number >= 0.2 and <= 60"),
        (JONSWAP.format(1, 5, 4001), "<u:components> is '4001'; expected a whole number"),
        (JONSWAP.format("nan", 5, 9), "<u:significantHeight> is 'nan'; expected a number"),
        ("<u:jonswop/>", "Did you mean u:jonswap"),
    ],
)  # fmt: skip
def test_a_wave_that_cannot_be_is_an_error_of_the_file(
    tmp_path: Path, waves: str, message: str
) -> None:
    with pytest.raises(SceneError) as error:
        open_floats(tmp_path, waves, "sphere")
    assert message in str(error.value)


def test_settings_of_uwsim_s_ocean_have_limits(tmp_path: Path) -> None:
    """UWSim's own parameters make the sea of `<u:uwsimOcean>`; they have limits there."""
    open_floats(tmp_path, "<u:uwsimOcean/>", "sphere").close()
    file = tmp_path / "scene.xml"
    text = file.read_text()
    for scale in ("-1", "1e5"):
        file.write_text(text.replace("<depth>", f"<waveScale>{scale}</waveScale> <depth>"))
        with pytest.raises(SceneError, match=r":2: <waveScale> is .*; <u:uwsimOcean> expects"):
            read_scene(file)


def test_wave_systems_have_a_number_of_components_together(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="24000 components; expected at most 20000 in all"):
        open_floats(tmp_path, 6 * JONSWAP.format(1, 5, 4000), "sphere")


def test_a_depth_that_a_command_sets_is_checked_when_the_scene_opens(tmp_path: Path) -> None:
    open_floats(tmp_path, SEA, "sphere").close()
    scene = read_scene(tmp_path / "scene.xml")
    changed = replace(scene, ocean_state=replace(scene.ocean_state, depth=0.0))
    with pytest.raises(UwsimError, match="<depth> is 0; <u:waves> expects a depth > 0"):
        open_scene(changed)
