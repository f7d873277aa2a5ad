"""Bodies of several shapes, alone and together, in waves with currents."""

from __future__ import annotations

import itertools
import math
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.water.water_rows import rows_of
from tests.support.opened import open_scene
from uwsim.currents import CURRENTS
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation

DENSITY = 1000.0  # [kg/m3]
WAVE = "<u:regularWave><u:height>{}</u:height><u:period>{}</u:period></u:regularWave>"
SEA = (
    "<u:jonswap><u:significantHeight>0.4</u:significantHeight><u:peakPeriod>4</u:peakPeriod>"
    "<u:spreading>10</u:spreading></u:jonswap>"
)
ROBOT = '<robot name="float"> <link name="base_link"/> </robot>'
SHAPES = {
    "box": (1.2 * 1.0 * 0.6, "1.2 1.0 0.6", 0.3),
    "sphere": (4.0 / 3.0 * math.pi * 0.5**3, "0.5", 0.5),
    "cylinder": (math.pi * 0.25**2 * 1.0, "0.25 1.0", 0.5),
}
"""Shape -> volume [m3], size, and draught of half its volume [m]."""
WATER = """<hydrodynamics name="{name}">
  <source>a float of the tests</source>
  <body link="base_link">
    <mass>{mass}</mass> <inertia>{inertia} {inertia} {inertia} 0 0 0</inertia>
    <addedMass>{added} {added} {added} 5 5 5</addedMass>
    <linearDamping>50 50 300 40 40 40</linearDamping>
    <volume>{volume}</volume>
    <centreOfMass> <x>0</x> <y>0</y> <z>{centre}</z> </centreOfMass>
    <shape>{shape}</shape> <size>{size}</size>
  </body>
</hydrodynamics>"""
SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <oceanState> <depth>60</depth> <u:density>1000</u:density>
    <u:waves>{waves}</u:waves> {current}
  </oceanState> {frame} {vehicles}
</UWSimScene>"""
VEHICLE = """<vehicle> <name>{name}</name> <file>float.urdf</file>
    <position> <x>{x}</x> <y>{y}</y> <z>{z}</z> </position>
    <orientation> <r>{roll}</r> <p>0</p> <y>0</y> </orientation>
    <u:dynamics>{shape}</u:dynamics>
</vehicle>"""
NED = "<simParams> <offsetr> <x>M_PI</x> <y>0</y> <z>0</z> </offsetr> </simParams>"


def open_floats(
    folder: Path,
    waves: str,
    *shapes: str,
    xs: tuple[float, ...] = (0.0, 7.0, 19.0),
    z: float = 0.0,
    current: str = "",
    is_ned: bool = False,
) -> Simulation:
    """Open a scene with half submerged floats, named by their shapes, at x and y = x / 2 in W."""
    (folder / "float.urdf").write_text(ROBOT)
    for shape, (volume, size, _) in SHAPES.items():
        mass = 0.5 * DENSITY * volume
        (folder / f"{shape}.xml").write_text(
            WATER.format(
                name=shape, mass=mass, inertia=0.15 * mass, added=0.3 * mass, volume=volume,
                centre=-0.15, shape=shape, size=size,
            )
        )  # fmt: skip
    down = -1.0 if is_ned else 1.0
    vehicles = [
        VEHICLE.format(name=shape, shape=shape, x=x, y=down * 0.5 * x, z=down * z,
                       roll="M_PI" if is_ned else "0")
        for shape, x in zip(shapes, xs, strict=False)
    ]  # fmt: skip
    file = folder / "scene.xml"
    file.write_text(
        SCENE.format(waves=waves, current=f"<u:current>{current}</u:current>" if current else "",
                     frame=NED if is_ned else "", vehicles="\n".join(vehicles))
    )  # fmt: skip
    simulation = open_scene(read_scene(file), data_path=[folder])
    simulation.advance(0.0)
    return simulation


def position_of(simulation: Simulation, name: str) -> np.ndarray:
    return simulation.world.bodies.find(name).world_from_body.position


@pytest.mark.parametrize("shape", SHAPES)
def test_a_float_rides_long_waves(tmp_path: Path, shape: str) -> None:
    simulation = open_floats(tmp_path, WAVE.format(0.3, 10.0), shape)
    simulation.advance(30.0)
    waves = simulation.world.water.waves
    assert waves is not None
    for _ in range(10):
        simulation.advance(1.0)
        position = position_of(simulation, shape)
        elevation = waves.elevation(position[None], simulation.time)[0]
        assert position[2] == pytest.approx(elevation, abs=0.006)  # 4 % of the amplitude


def test_a_box_follows_the_slope_of_long_waves(tmp_path: Path) -> None:
    """Its metacentric height of 0.4 m turns it with the surface: the slope is k a at most."""
    simulation = open_floats(tmp_path, WAVE.format(0.6, 8.0), "box")
    simulation.advance(40.0)
    waves = simulation.world.water.waves
    assert waves is not None
    largest = 0.0
    for _ in range(16):
        simulation.advance(0.5)
        pose = simulation.world.bodies.find("box").world_from_body
        slope = waves.motion(pose.position[None], simulation.time).slope[0, 0]
        tilt = -pose.rotation[2, 0] / pose.rotation[2, 2]  # pitch, bow down for a falling slope
        assert -tilt == pytest.approx(slope, abs=0.006)
        largest = max(largest, abs(slope))
    assert largest > 0.015


def test_a_scene_with_z_down_has_the_same_motion(tmp_path: Path) -> None:
    """The wave travels along the x axis, which both frames share."""
    heights = []
    for is_ned in (False, True):
        folder = tmp_path / str(is_ned)
        folder.mkdir()
        simulation = open_floats(folder, WAVE.format(0.5, 4.0), "box", "sphere", is_ned=is_ned)
        simulation.advance(5.0)
        heights.append([position_of(simulation, name) for name in ("box", "sphere")])
    np.testing.assert_allclose(heights[0], heights[1], atol=1e-9)


def test_several_floats_move_as_each_does_alone(tmp_path: Path) -> None:
    xs = dict(zip(SHAPES, (0.0, 7.0, 19.0), strict=True))
    together = open_floats(tmp_path, SEA, *SHAPES)
    together.advance(4.0)
    for shape, x in xs.items():
        alone = open_floats(tmp_path, SEA, shape, xs=(x,))
        alone.advance(4.0)
        np.testing.assert_allclose(
            position_of(together, shape), position_of(alone, shape), atol=1e-12
        )


VELOCITY = "<u:velocity> <x>0.3</x> <y>0.1</y> <z>0</z> </u:velocity>"
CURRENT_TEXTS = {
    "constant": f"<u:constant> {VELOCITY} </u:constant>",
    "field": "<u:field> <u:file>flow.csv</u:file> </u:field>",
    "gaussMarkov": "<u:gaussMarkov> <u:deviation> <x>0.1</x> <y>0.1</y> <z>0</z> </u:deviation>"
    " <u:mu>0.1</u:mu> </u:gaussMarkov>",
    "layers": f"<u:layers> <u:layer> <u:depth>0</u:depth> {VELOCITY} </u:layer> <u:layer>"
    " <u:depth>5</u:depth> <u:velocity> <x>0</x> <y>0</y> <z>0</z> </u:velocity> </u:layer>"
    " </u:layers>",
    "logProfile": f"<u:logProfile> {VELOCITY} <u:depth>20</u:depth> </u:logProfile>",
    "powerProfile": f"<u:powerProfile> {VELOCITY} <u:depth>20</u:depth> </u:powerProfile>",
    "pythonFunction": "<u:pythonFunction> <u:function>wave_eddy:eddy</u:function>"
    " </u:pythonFunction>",
    "tidal": "<u:tidal> <u:constituent> <u:name>M2</u:name> <u:semiMajor>0.4</u:semiMajor>"
    " </u:constituent> </u:tidal>",
    "uwsimSinusoid": "<u:uwsimSinusoid> <u:speed>0.2</u:speed> <u:theta>M_PI_2</u:theta>"
    " <u:phi>0</u:phi> </u:uwsimSinusoid>",
}


@pytest.fixture
def current_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "flow.csv").write_text("z,u,v\n-20,0.5,0\n0,0.1,0.2\n20,0.1,0.2\n")
    (tmp_path / "wave_eddy.py").write_text(
        "def eddy(point, time, vehicle):\n    return -0.1 * point[1], 0.1 * point[0], 0.0\n"
    )
    monkeypatch.syspath_prepend(str(tmp_path))
    return tmp_path


def test_every_current_is_combined_with_waves_here() -> None:
    assert set(CURRENT_TEXTS) == set(CURRENTS)


@pytest.mark.parametrize("name", CURRENT_TEXTS)
def test_a_current_of_any_kind_and_waves_add_up(current_folder: Path, name: str) -> None:
    """The velocities add up; the acceleration is that of the water which passes the point."""
    simulation = open_floats(current_folder, SEA, "sphere", current=CURRENT_TEXTS[name])
    water, step = simulation.world.water, simulation.world.model.timestep
    assert water.waves is not None
    points, vehicles = np.array([[1.0, 2.0, -1.5], [8.0, -3.0, -4.0]]), ("sphere", "sphere")
    function = water.motion_during(lambda: points, range(1, 2), step, vehicles)
    assert function is not None
    time = 0.5 * step
    found = rows_of(function, points, (time,))[0]
    velocity, acceleration, rotation = water.motion_at(points, time, vehicles)  # of the current
    motion = water.waves.motion(points, time)
    np.testing.assert_allclose(found[:, :3], velocity + motion.velocity, atol=1e-12)
    convection = np.einsum("nij,nj->ni", motion.gradient, velocity + motion.velocity)
    expected = acceleration + motion.acceleration + convection
    np.testing.assert_allclose(found[:, 3:6], expected, atol=1e-12)
    turning = np.zeros_like(velocity) if rotation is None else rotation
    np.testing.assert_allclose(found[:, 6:9], turning, atol=1e-12)


@pytest.mark.parametrize("name", CURRENT_TEXTS)
def test_a_float_goes_on_with_a_current_and_waves_from_the_middle_of_a_wave(
    current_folder: Path, name: str
) -> None:
    """A saved state restores both; the same seed gives the same bytes."""
    ends = []
    for _ in range(2):
        simulation = open_floats(current_folder, SEA, "box", current=CURRENT_TEXTS[name])
        simulation.world.water.set_wave_height(0.6)
        simulation.advance(0.5)
        saved = simulation.save()
        simulation.advance(0.3)
        ends.append(position_of(simulation, "box").tobytes())
        simulation.world.water.set_wave_height(0.1)
        simulation.advance(0.2)
        simulation.restore(saved)
        simulation.advance(0.3)
        ends.append(position_of(simulation, "box").tobytes())
    assert len(set(ends)) == 1


def test_seeds_give_different_seas(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    file = tmp_path / "a"
    open_floats(file, SEA, "sphere").close()
    elevations = []
    for seed in (1, 2):
        waves = open_scene(read_scene(file / "scene.xml"), seed=seed).world.water.waves
        assert waves is not None
        elevations.append(waves.elevation(np.zeros((1, 2)), 0.0)[0])
    assert all(a != b for a, b in itertools.combinations(elevations, 2))
