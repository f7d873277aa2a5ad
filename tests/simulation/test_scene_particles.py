"""Particles of a running scene: their state, their drift, and sediment below thrusters."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import uwsim
from uwsim.assets.bundled import bundled_files
from uwsim.base.geometry import Intrinsics
from uwsim.cameras.exposure import Displacement
from uwsim.errors import UwsimError
from uwsim.messages import Twist, TwistStamped, Vector3
from uwsim.particles.puffs import MASS
from uwsim.simulation.scenery.scene_particles import ParticlesState
from uwsim.simulation.state.state import State

LENS = Intrinsics.from_fovy(96, 72, 0.9)
START = "<x>4.4</x> <y>6.6</y> <z>12.4</z>"
LOW_START = "<x>4.4</x> <y>9</y> <z>13.2</z>"
CURRENT = """
<u:current> <u:constant>
  <u:velocity> <x>0.2</x> <y>0.1</y> <z>0</z> </u:velocity>
</u:constant> </u:current>
"""


def load(
    folder: Path, particles: str, *, current: str = "", start: str = START
) -> uwsim.Simulation:
    """Load the scene of the wreck with particles; without the wreck, which takes a second."""
    text = bundled_files("scenes")["wreck-physical-scene"].read_text()
    text, n_wrecks = re.subn(r"<object>\s*<name>wreck<.*?</object>", "", text, flags=re.DOTALL)
    assert n_wrecks == 1
    begin, end = text.find("<u:particles>"), text.find("</u:particles>")
    if begin >= 0:
        text = text[:begin] + text[end + len("</u:particles>") :]
    element = f"<u:particles>{particles}</u:particles>" if particles else ""
    text = text.replace("</u:water>", f"{element}</u:water>{current}").replace(START, start)
    path = folder / "scene.xml"
    path.write_text(text)
    return uwsim.load(path, seed=5)


def state_of(simulation: uwsim.Simulation) -> ParticlesState:
    """Return the state of the particles."""
    state = simulation.world.scenery.state.particles
    assert state is not None
    return state


def climb(simulation: uwsim.Simulation, seconds: float) -> None:
    """Climb, so that the jets of the thrusters hit the floor."""
    twist = TwistStamped(twist=Twist(linear=Vector3(0.0, 0.0, -0.35), angular=Vector3(0, 0, 0)))
    for _ in range(round(seconds / 0.1)):
        simulation.publish("/g500/twist", twist)
        simulation.advance(0.1)


def photograph(simulation: uwsim.Simulation) -> bytes:
    """Return the bytes of an image of the camera."""
    camera = simulation.world.sensors.camera("camera")
    image = simulation.world.scenery.render_clean(camera.world_from_camera, LENS)
    assert image.colour is not None
    return image.colour.tobytes()


def test_particles_drift_with_the_current(tmp_path: Path) -> None:
    with load(tmp_path, "<u:marineSnow/>", current=CURRENT) as simulation:
        rotation = simulation.world.model.scene.world_from_localized.rotation
        velocity = rotation @ np.array([0.2, 0.1, 0.0])
        simulation.advance(2.0)
        state = state_of(simulation)
        np.testing.assert_allclose(state.velocity, velocity, atol=1e-12)
        displacement = state.displacement + state.velocity * (simulation.time - state.time)
        np.testing.assert_allclose(displacement, 2.0 * velocity, atol=0.011)  # the first 0.05 s


def test_the_drift_does_not_depend_on_the_length_of_advances(tmp_path: Path) -> None:
    states = []
    for duration in (0.05, 0.5):
        with load(tmp_path, "<u:marineSnow/>", current=CURRENT) as simulation:
            for _ in range(round(1.0 / duration)):
                simulation.advance(duration)
            states.append(state_of(simulation).displacement.tobytes())
    assert states[0] == states[1]


def test_the_same_seed_gives_the_same_bytes(tmp_path: Path) -> None:
    images = []
    for _ in range(2):
        with load(tmp_path, "<u:marineSnow/><u:bubbles/>") as simulation:
            simulation.advance(0.3)
            images.append(photograph(simulation))
            simulation.advance(0.5)
            images.append(photograph(simulation))
    assert images[0] == images[2]
    assert images[1] == images[3]
    assert images[0] != images[1]


def test_particles_streak_from_image_to_image_of_an_exposure(tmp_path: Path) -> None:
    with load(tmp_path, "<u:bubbles> <u:depthScale>100</u:depthScale> </u:bubbles>") as simulation:
        particles = simulation.world.scenery.particles
        assert particles is not None
        camera = simulation.world.sensors.camera("camera")
        displacement = Displacement(
            "g500",
            np.eye(4),
            time=0.004,
            duration=0.002,
            velocity=np.array([1.0, 0.0, 0.0]),
            angular_velocity=np.zeros(3),
        )
        still = particles.find_visible(camera.world_from_camera, LENS)
        visible = particles.find_visible(camera.world_from_camera, LENS, displacement)
        assert still is not None
        assert visible is not None
        rotation = camera.world_from_camera.rotation
        extents = visible.records["extent"].astype(np.float64) @ rotation.T  # in W
        np.testing.assert_allclose(extents[:, 0], -0.002, atol=1e-6)
        assert 0.0 < extents[:, 2].min() < extents[:, 2].max() < 0.002 * 0.3
        assert still.records["extent"].max() < 0.01 * 0.3


def test_a_scene_without_particles_has_no_state_of_them(tmp_path: Path) -> None:
    with load(tmp_path, "") as simulation:
        assert simulation.world.scenery.state.particles is None


def test_thrusters_near_the_floor_stir_up_sediment(tmp_path: Path) -> None:
    with load(tmp_path, "<u:sediment/>", start=LOW_START) as simulation:
        simulation.advance(0.3)
        clear_image = photograph(simulation)
        climb(simulation, 2.0)
        puffs = state_of(simulation).sediment
        assert puffs is not None
        assert 0.003 < puffs.eroded_mass < 0.1
        suspended_mass = puffs.puffs[: puffs.n_puffs, MASS].sum()
        assert suspended_mass + puffs.settled_mass == pytest.approx(puffs.eroded_mass, rel=1e-12)
        assert photograph(simulation) != clear_image


def test_thrusters_high_above_the_floor_stir_up_nothing(tmp_path: Path) -> None:
    high_start = START.replace("12.4", "4")
    with load(tmp_path, "<u:sediment/>", start=high_start) as simulation:
        climb(simulation, 1.0)
        puffs = state_of(simulation).sediment
        assert puffs is not None
        assert puffs.eroded_mass == 0.0


def test_the_state_of_particles_is_restored(tmp_path: Path) -> None:
    kinds = "<u:marineSnow/><u:sediment/>"
    with load(tmp_path, kinds, current=CURRENT, start=LOW_START) as simulation:
        climb(simulation, 1.0)
        data = simulation.state.to_bytes()
        saved_image = photograph(simulation)
        saved_state = State.from_bytes(data)
        climb(simulation, 0.6)
        expected = photograph(simulation)
        simulation.restore(saved_state)
        assert photograph(simulation) == saved_image
        climb(simulation, 0.6)
        assert photograph(simulation) == expected
        simulation.reset()
        puffs = state_of(simulation).sediment
        assert puffs is not None
        assert puffs.eroded_mass == 0.0


def test_a_largest_diameter_below_the_smallest_is_an_error(tmp_path: Path) -> None:
    snow = "<u:marineSnow> <u:maxDiameter>0.0002</u:maxDiameter> </u:marineSnow>"
    expected = r"scene\.xml:\d+: .*<u:maxDiameter> not below <u:minDiameter>"
    with pytest.raises(UwsimError, match=expected):
        load(tmp_path, snow)
