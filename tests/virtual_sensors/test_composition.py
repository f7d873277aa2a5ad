"""Real images with virtual objects: where these are, what hides them, and what the water does."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from tests.virtual_sensors.worlds import (
    BALL,
    HEIGHT,
    POST,
    WALL,
    WIDTH,
    camera_scene,
    moving_log,
    with_fog,
)
from uwsim.errors import BadSetting, UnknownName
from uwsim.messages import Image, depth_image, image, pixels_of
from uwsim.optics import find_water
from uwsim.optics.transmission import compute_full_field
from uwsim.particles import ParticlesSpec
from uwsim.particles.marine_snow import MarineSnowSpec
from uwsim.scene.physical_water import PhysicalWaterSpec
from uwsim.scene.spec import SceneSpec
from uwsim.simulation import Simulation
from uwsim.virtual_sensors import (
    ComposedCamera,
    FollowSettings,
    ImageComposition,
    Layers,
    compose_image,
    follow_log,
    make_followed_scene,
    make_track,
)
from uwsim.virtual_sensors.composed_camera import hide_particles
from uwsim.virtual_sensors.composition import AddedFog, AddedPhysicalWater, compute_shadow


def colours(simulation: Simulation) -> np.ndarray:
    colour = simulation.image("eye").colour
    assert colour is not None
    return np.asarray(colour[..., :3])


def compose(scene: SceneSpec, recorded: np.ndarray, **settings: object) -> np.ndarray:
    composition = ImageComposition(camera="eye", topic="/cam", **settings)  # type: ignore[arg-type]
    with open_scene(scene) as simulation:
        simulation.advance(0.0)
        return ComposedCamera(simulation, composition, "rov").compose(recorded)


@pytest.fixture
def recorded(tmp_path: Path) -> np.ndarray:
    """A real image: the wall in clear water."""
    with open_scene(camera_scene(tmp_path, WALL)) as simulation:
        return colours(simulation)


def test_a_virtual_ball_is_at_the_pixel_of_the_pinhole_while_the_vehicle_moves(
    tmp_path: Path,
) -> None:
    times = np.array([0.0, 0.4, 1.0])
    positions = np.array([[0.0, 0.0, -2.0], [0.5, 0.2, -2.1], [0.2, 0.5, -1.9]])
    yaws = np.array([0.0, 0.1, -0.15])
    scene = make_followed_scene(camera_scene(tmp_path, BALL), "rov")
    log = moving_log(times, positions, yaws)
    focal_length = HEIGHT / 2.0 / math.tan(math.radians(30.0))
    with open_scene(scene) as simulation:
        follow_log(simulation, "rov", make_track(log, FollowSettings()))
        for time in (0.0, 0.2, 0.4, 0.7, 1.0):
            simulation.advance(time - simulation.time)
            ids = simulation.image("eye").ids
            assert ids is not None
            number = next(p.id for p in simulation.world.scenery.parts if p.name == "ball")
            rows, columns = np.nonzero(ids == number)
            # interpolated by hand: the camera is 0.1 m before the base, x is right, z is down
            position = [np.interp(time, times, positions[:, i]) for i in range(3)]
            yaw = float(np.interp(time, times, yaws))
            dx, dy, dz = np.array(BALL.position) - position
            ahead = math.cos(yaw) * dx + math.sin(yaw) * dy - 0.1
            left = -math.sin(yaw) * dx + math.cos(yaw) * dy
            u = (WIDTH - 1) / 2 - focal_length * left / ahead
            v = (HEIGHT - 1) / 2 - focal_length * dz / ahead
            assert columns.mean() == pytest.approx(u, abs=1.0)
            assert rows.mean() == pytest.approx(v, abs=1.0)


@pytest.mark.parametrize("fog", [0.05, 0.2, 0.5])
def test_fog_over_a_clear_image_is_the_scene_rendered_in_that_fog(
    tmp_path: Path, fog: float
) -> None:
    scene = camera_scene(tmp_path, WALL, POST)
    with open_scene(scene) as simulation:
        clear = colours(simulation)
    with open_scene(with_fog(scene, fog)) as simulation:
        expected = colours(simulation)
    composed = compose(scene, clear, real_objects=("wall", "post"), fog=fog)
    # the clear image is rounded to whole levels before the fog
    assert np.abs(composed.astype(int) - expected).max() <= 1


def test_fog_adds_to_that_of_the_recording_by_its_squares(tmp_path: Path) -> None:
    scene = camera_scene(tmp_path, WALL, fog=0.15)
    with open_scene(scene) as simulation:
        first = colours(simulation)
    with open_scene(with_fog(scene, 0.25)) as simulation:
        expected = colours(simulation)
    composed = compose(scene, first, real_objects=("wall",), fog=0.2)
    assert np.abs(composed.astype(int) - expected).max() <= 1


def test_an_image_with_a_virtual_ball_is_that_of_the_scene_with_the_ball(
    tmp_path: Path, recorded: np.ndarray
) -> None:
    scene = camera_scene(tmp_path, WALL, BALL)
    with open_scene(scene) as simulation:
        expected = colours(simulation)
        ball = next(p.id for p in simulation.world.scenery.parts if p.name == "ball")
        ids = simulation.image("eye").ids
    composed = compose(scene, recorded, real_objects=("wall",))
    assert ids is not None
    is_ball = ids == ball
    assert 50 < is_ball.sum() < 0.3 * is_ball.size
    assert np.array_equal(composed[is_ball], expected[is_ball])
    assert np.array_equal(composed[~is_ball], recorded[~is_ball])


def test_a_real_post_before_a_virtual_ball_hides_it(tmp_path: Path) -> None:
    scene = camera_scene(tmp_path, WALL, POST, BALL)
    with open_scene(replace(scene, objects=(WALL, POST))) as simulation:
        real = colours(simulation)
    with open_scene(scene) as simulation:
        ids = simulation.image("eye").ids
        post = next(p.id for p in simulation.world.scenery.parts if p.name == "post")
    composed = compose(scene, real, real_objects=("wall", "post"))
    assert ids is not None
    assert np.array_equal(composed[ids == post], real[ids == post])
    assert np.any(composed != real)


def test_a_depth_image_hides_virtual_objects_where_it_is_nearer(
    tmp_path: Path, recorded: np.ndarray
) -> None:
    scene = camera_scene(tmp_path, BALL)
    depth = np.full((HEIGHT, WIDTH), 5.5)
    depth[:, : WIDTH // 2 - 12] = 1.0  # something near on the left, where half of the ball is
    depth[:10] = math.nan  # not measured
    composition = ImageComposition(camera="eye", topic="/cam", depth_topic="/depth")
    with open_scene(scene) as simulation:
        simulation.advance(0.0)
        images: list[Image] = []
        camera = ComposedCamera(simulation, composition, "rov")
        simulation.bus.subscribe(camera.topic, Image, images.append)
        simulation.publish("/depth", depth_image(depth, time=0.0))
        simulation.advance()
        simulation.publish("/cam", image(recorded, time=0.0))
        simulation.advance()
        ids = simulation.image("eye").ids
        ball = next(p.id for p in simulation.world.scenery.parts if p.name == "ball")
    assert camera.topic == "/virtual/composed/cam"
    is_changed = (pixels_of(images[0]) != recorded).any(axis=2)
    is_ball = ids == ball
    assert is_ball[:, : WIDTH // 2 - 12].any()
    assert not is_changed[:, : WIDTH // 2 - 12].any()
    assert np.array_equal(is_changed[:, WIDTH // 2 - 12 :], is_ball[:, WIDTH // 2 - 12 :])


def test_an_assumed_range_gives_fog_where_nothing_is_known(
    tmp_path: Path, recorded: np.ndarray
) -> None:
    scene = camera_scene(tmp_path)
    composed = compose(scene, recorded, fog=0.2, unknown_range=4.0)
    share = math.exp(-((0.2 * 4.0) ** 2))
    expected = share * recorded + (1.0 - share) * 255.0 * np.array([0.1, 0.35, 0.5])
    assert np.abs(composed - expected).max() <= 0.5001
    thick = compose(scene, recorded, fog=0.2)
    assert np.ptp(thick.reshape(-1, 3), axis=0).max() == 0, "infinitely far is fog alone"


def test_virtual_objects_have_the_noise_of_the_camera_and_real_pixels_do_not(
    tmp_path: Path, recorded: np.ndarray
) -> None:
    scene = camera_scene(tmp_path, WALL, BALL, std=0.02)
    composed = compose(scene, recorded, real_objects=("wall",))
    smooth = compose(camera_scene(tmp_path, WALL, BALL), recorded, real_objects=("wall",))
    difference = (composed.astype(float) - smooth)[(smooth != recorded).any(axis=2)]
    assert np.std(difference) == pytest.approx(0.02 * 255.0, rel=0.1)
    is_real = (smooth == recorded).all(axis=2) & (composed == recorded).all(axis=2)
    assert is_real.mean() > 0.7


def test_a_grey_image_stays_grey(tmp_path: Path, recorded: np.ndarray) -> None:
    grey = recorded[..., 1]
    composed = compose(camera_scene(tmp_path, WALL, BALL), grey, real_objects=("wall",))
    assert composed.shape == grey.shape
    assert np.any(composed != grey)


def test_physical_water_is_that_of_the_optics_formulas() -> None:
    rng = np.random.default_rng(0)
    pixels = rng.integers(0, 256, (4, 5, 3), dtype=np.uint8)
    background = np.full((4, 5, 3), (20, 90, 120), np.uint8)
    ranges = np.linspace(0.5, 6.0, 20, dtype=np.float32).reshape(4, 5)
    ranges[3, 4] = np.inf
    medium = find_water("jerlov-3C")
    layers = Layers(
        virtual_colour=pixels, virtual_range=np.full((4, 5), np.inf, np.float32), real_range=ranges
    )
    water = AddedPhysicalWater(medium=medium, background=background)
    composed = compose_image(pixels, layers, water)

    def decode(levels: np.ndarray) -> np.ndarray:
        stored = levels / 255.0
        return np.where(stored <= 0.04045, stored / 12.92, ((stored + 0.055) / 1.055) ** 2.4)

    arrival = compute_full_field(medium, np.minimum(ranges, 1e9))
    arrival[3, 4] = 0.0
    light = decode(pixels) * arrival + decode(background) * (1.0 - arrival)
    assert decode(composed) == pytest.approx(
        light, abs=0.5 * (decode(np.array(255.0)) - decode(np.array(254.0)))
    )
    assert composed[3, 4].tolist() == [20, 90, 120]


def test_a_shadow_is_the_ratio_of_both_images_on_the_same_surface_only() -> None:
    lit, unlit = np.full((1, 3, 3), 99, np.uint8), np.full((1, 3, 3), 49, np.uint8)
    ranges = np.array([[2.0, 2.0, np.inf]], np.float32)
    other_ranges = np.array([[2.0, 1.0, np.inf]], np.float32)
    shadow = compute_shadow(lit, unlit, ranges, other_ranges)
    assert shadow[0, :, 0].tolist() == [0.5, 1.0, 1.0]


def test_an_image_of_another_size_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BadSetting, match="has 8x6 pixels; the camera of the scene has 160x120"):
        compose(camera_scene(tmp_path, BALL), np.zeros((6, 8, 3), np.uint8))


def test_settings_that_do_not_fit_the_scene_are_refused(tmp_path: Path) -> None:
    scene, pixels = camera_scene(tmp_path, BALL), np.zeros((HEIGHT, WIDTH, 3), np.uint8)
    with pytest.raises(UnknownName, match=r"'wal'.*ball"):
        compose(scene, pixels, real_objects=("wal",))
    with pytest.raises(BadSetting, match="no physical water to add"):
        compose(scene, pixels, adds_water=True)
    ocean = replace(scene.ocean_state, water=PhysicalWaterSpec(law="physical", type="pool"))
    with pytest.raises(BadSetting, match="has physical water"):
        compose(replace(scene, ocean_state=ocean), pixels, fog=0.1)


def test_hostile_images_are_left_out_and_counted(tmp_path: Path) -> None:
    composition = ImageComposition(camera="eye", topic="/cam")
    with open_scene(camera_scene(tmp_path, BALL)) as simulation:
        simulation.advance(0.0)
        camera = ComposedCamera(simulation, composition, "rov")
        lying = image(np.zeros((HEIGHT, WIDTH, 3), np.uint8), time=0.0)
        for changes in ({"height": 2**31}, {"encoding": "yuv422"}, {"step": 1}, {"width": 0}):
            simulation.publish("/cam", replace(lying, **changes))
        simulation.advance()
        assert (camera.n_images, camera.n_refused) == (0, 4)


def test_fog_of_zero_density_changes_nothing() -> None:
    pixels = np.arange(60, dtype=np.uint8).reshape(4, 5, 3)
    far = np.full((4, 5), np.inf, np.float32)
    layers = Layers(virtual_colour=pixels, virtual_range=far, real_range=far)
    fog = AddedFog(density=0.0, colour=(1.0, 1.0, 1.0))
    assert np.array_equal(compose_image(pixels, layers, fog), pixels)


def test_particles_change_a_real_image_as_they_change_the_rendered_one(tmp_path: Path) -> None:
    scene = camera_scene(tmp_path, WALL)
    snow = ParticlesSpec(marine_snow=MarineSnowSpec(concentration=20000.0))
    water = PhysicalWaterSpec(law="physical", type="jerlov-IB", particles=snow)
    snowy_scene = replace(scene, ocean_state=replace(scene.ocean_state, water=water))
    with open_scene(snowy_scene) as simulation:
        simulation.advance(0.0)
        expected = colours(simulation)
        with hide_particles(simulation.world.scenery):
            clear = colours(simulation)
    assert 0.001 < (clear != expected).any(axis=2).mean() < 0.9
    composed = compose(snowy_scene, clear, real_objects=("wall",), has_particles=True)
    assert np.array_equal(composed, expected)
    plain = compose(snowy_scene, clear, real_objects=("wall",))
    assert np.array_equal(plain, clear)
    with pytest.raises(BadSetting, match="no particles to add"):
        compose(scene, clear, has_particles=True)
