"""What sensors measure in waves, against linear theory."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation

G = 9.81
HEIGHT, PERIOD, DEPTH = 1.0, 6.0, 40.0  # of the wave, and of the water [m, s, m]
OMEGA = 2.0 * math.pi / PERIOD
NED = "<simParams> <offsetr> <x>M_PI</x> <y>0</y> <z>0</z> </offsetr> </simParams>"
ROBOT = """<robot name="pole"> <link name="base_link"/> <link name="top"/>
  <joint name="j" type="fixed"> <parent link="base_link"/> <child link="top"/> </joint>
</robot>"""
SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <oceanState> <depth>{depth}</depth> <u:density>1025</u:density>
    <u:waves> <u:regularWave> <u:height>{height}</u:height> <u:period>{period}</u:period>
      <u:direction>0.4</u:direction>
    </u:regularWave> </u:waves> {current}
  </oceanState> {frame}
  <vehicle> <name>pole</name> <file>pole.urdf</file>
    <position> <x>0</x> <y>0</y> <z>{z}</z> </position>
    {sensors}
  </vehicle>
</UWSimScene>"""
SENSORS = """
<pressureSensor> <name>depth</name> <relativeTo>base_link</relativeTo> </pressureSensor>
<pressureSensor> <name>gauge</name> <relativeTo>base_link</relativeTo>
  <u:measures>gauge</u:measures> </pressureSensor>
<gpsSensor> <name>gps</name> <relativeTo>base_link</relativeTo> </gpsSensor>
<dvlSensor> <name>dvl</name> <relativeTo>base_link</relativeTo> <u:lookAt>down</u:lookAt>
</dvlSensor>"""


def open_pole(
    folder: Path, z: float, *, frame: str = "", current: str = "", **wave: float
) -> Simulation:
    """Open a scene with a kinematic vehicle whose sensors are at z of L [m]."""
    (folder / "pole.urdf").write_text(ROBOT)
    settings = {"height": HEIGHT, "period": PERIOD, "depth": DEPTH} | wave
    file = folder / "scene.xml"
    file.write_text(SCENE.format(z=z, sensors=SENSORS, frame=frame, current=current, **settings))
    simulation = open_scene(read_scene(file))
    simulation.advance(0.0)
    return simulation


def sample(simulation: Simulation, kind: str, name: str, time: float) -> Any:
    return simulation.world.sensors.sensor(name, (kind,)).sample(time)


def wave_number(period: float = PERIOD, depth: float = DEPTH) -> float:
    """Solve the dispersion relation by bisection."""
    low, high, omega = 1e-6, 100.0, 2.0 * math.pi / period
    for _ in range(200):
        k = 0.5 * (low + high)
        low, high = (k, high) if G * k * math.tanh(k * depth) < omega**2 else (low, k)
    return low


@pytest.mark.parametrize(("frame", "down"), [("", -1.0), (NED, 1.0)], ids=["z up", "z down"])
@pytest.mark.parametrize(("depth", "is_crest"), [
    (0.0, True), (0.0, False), (2.0, True), (2.0, False), (10.0, True), (10.0, False),
])  # fmt: skip
def test_a_depth_below_crest_and_trough_is_that_of_linear_theory(
    tmp_path: Path, depth: float, is_crest: bool, frame: str, down: float
) -> None:
    simulation = open_pole(tmp_path, down * depth, frame=frame)
    k, time = wave_number(), 0.0 if is_crest else 0.5 * PERIOD
    decay = math.cosh(k * (DEPTH - depth)) / math.cosh(k * DEPTH)
    expected = depth + (0.5 if is_crest else -0.5) * HEIGHT * decay
    expected = max(0.0, expected)  # in the air of a trough
    assert sample(simulation, "pressureSensor", "depth", time).pressure == pytest.approx(
        expected, abs=1e-6
    )
    gauge = sample(simulation, "pressureSensor", "gauge", time).pressure
    assert gauge == pytest.approx(1025.0 * G * expected, abs=0.1)


def test_a_sensor_inside_a_crest_measures_the_water_above_it(tmp_path: Path) -> None:
    simulation = open_pole(tmp_path, 0.3)
    depth = sample(simulation, "pressureSensor", "depth", 0.0).pressure
    assert depth == pytest.approx(0.5 * HEIGHT - 0.3, abs=1e-6)
    assert sample(simulation, "pressureSensor", "depth", 0.5 * PERIOD).pressure == 0.0


def test_a_receiver_has_a_fix_while_a_trough_passes(tmp_path: Path) -> None:
    """It is 0.6 m below the still surface; a fix needs less than 0.5 m of water by default."""
    simulation = open_pole(tmp_path, -0.6)
    statuses = {
        name: sample(simulation, "gpsSensor", "gps", time).status.status
        for name, time in (("crest", 0.0), ("trough", 0.5 * PERIOD), ("mean", 0.25 * PERIOD))
    }
    assert statuses["crest"] == statuses["mean"] == -1
    assert statuses["trough"] == 0


@pytest.mark.parametrize("time", [0.0, 1.3, 2.6, 4.1])
def test_a_water_track_is_the_orbital_motion_of_its_layer(tmp_path: Path, time: float) -> None:
    """2 m below the sensor, where its beams are 1.15 m off the axis.

    Four beams at 30 degrees assume that the layer moves as one. To first order in k their mean
    horizontal velocity is u - d grad w, the vertical w + d tan(30)^2 / 2 dw/dz; the layer is at
    d = 2 m.
    """
    simulation = open_pole(tmp_path, -3.0)
    message = sample(simulation, "dvlSensor", "dvl", time)
    k = wave_number()
    theta, up = -OMEGA * time, DEPTH - 5.0
    along = 0.5 * HEIGHT * OMEGA * math.cosh(k * up) / math.sinh(k * DEPTH) * math.cos(theta)
    upward = 0.5 * HEIGHT * OMEGA * math.sinh(k * up) / math.sinh(k * DEPTH) * math.sin(theta)
    along *= 1.0 - 2.0 * k * math.tanh(k * up)
    upward *= 1.0 + k / math.tanh(k * up) / 3.0
    water = np.array([along * math.cos(0.4), along * math.sin(0.4), upward])
    track = [message.we_east, message.we_north, message.we_upwards]
    np.testing.assert_allclose(track, -water, atol=0.01 * 0.5 * HEIGHT * OMEGA)


@pytest.mark.parametrize(("frame", "down"), [("", -1.0), (NED, 1.0)], ids=["z up", "z down"])
def test_a_kinematic_vehicle_drifts_as_stokes_says(tmp_path: Path, frame: str, down: float) -> None:
    height, period, depth, n = 0.2, 4.0, 400.0, 10
    k, omega = wave_number(period, depth), 2.0 * math.pi / period
    orbit = 0.5 * height * math.exp(-2.0 * k)  # at 2 m
    simulation = open_pole(
        tmp_path, down * (2.0 - orbit), frame=frame, height=height, period=period, depth=depth
    )
    body = simulation.world.bodies.find("pole")
    start = body.world_from_body.position
    simulation.advance(n * period)
    drift = (body.world_from_body.position - start) / (n * period)
    drift[1:] *= -down  # in L
    stokes = omega * k * (0.5 * height) ** 2 * math.exp(-4.0 * k)
    direction = [math.cos(0.4), math.sin(0.4)]
    np.testing.assert_allclose(drift[:2], np.multiply(stokes, direction), rtol=0.03)
    assert abs(drift[2]) < 0.03 * stokes


def test_a_kinematic_vehicle_drifts_with_currents_and_waves(tmp_path: Path) -> None:
    constant = "<u:constant><u:velocity><x>0.3</x><y>-0.2</y><z>0</z></u:velocity></u:constant>"
    positions = []
    for current in ("", f"<u:current>{constant}</u:current>"):
        simulation = open_pole(tmp_path, -3.0, current=current)
        simulation.advance(0.002)
        positions.append(simulation.world.bodies.find("pole").world_from_body.position)
    np.testing.assert_allclose(positions[1] - positions[0], [0.0006, -0.0004, 0.0], atol=1e-12)
