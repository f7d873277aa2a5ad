"""Updaters nested three deep: every kind in every kind, each level as it says, restarts too."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.support.bags import IMAGE, INFO, write_bag
from tests.support.fakes import FakeWorld
from tests.support.opened import open_scene
from tests.support.short_trial import make_plan, rows_of, tank
from uwsim.benchmark.updaters import (
    UPDATERS,
    ArmMoveUpdaterSpec,
    BagFogUpdaterSpec,
    CameraNoiseUpdaterSpec,
    CurrentForceUpdaterSpec,
    Level,
    NoneSpec,
    RepeatSpec,
    SceneFogUpdaterSpec,
    SceneLightUpdaterSpec,
    SceneUpdaterSpec,
    SeaStateUpdaterSpec,
    SettingUpdaterSpec,
    SphericalSpec,
    WaterUpdaterSpec,
    apply_level,
    bind_updaters,
    initial_level,
    interval,
    levels,
    n_levels,
    ramp_level,
    swept_parameters,
)
from uwsim.bus import Node
from uwsim.messages import Image, pixels_of
from uwsim.optics import find_water
from uwsim.simulation import Simulation

VEHICLE = "girona500"
GREY = np.full((2, 2), 200, dtype=np.uint8)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("nesting")
    write_bag(folder, "ros1", [(0.0, GREY), (0.01, GREY)], encoding="mono8")
    return folder


def current(**other: object) -> CurrentForceUpdaterSpec:
    still = SphericalSpec(theta=0.0, phi=0.0)
    spec = CurrentForceUpdaterSpec(
        initial_value=0.1, final_value=0.25, step=0.1, interval=1.0, target=VEHICLE,
        spherical_direction=SphericalSpec(theta=math.pi / 2, phi=0.0), force_variation=0.0,
        force_period=4.0, direction_variation=still, direction_period=SphericalSpec(
            theta=4.0, phi=4.0), random=0.0,
    )  # fmt: skip
    return replace(spec, **other)  # type: ignore[arg-type]


ARM = ArmMoveUpdaterSpec(
    arm_position=((0.0, 0.5), (0.4, 0.7)), step=1, interval=1.0, target=VEHICLE
)
MAKE: dict[str, Callable[[Path], SceneUpdaterSpec]] = {
    "armMoveUpdater": lambda folder: ARM,
    "bagFogUpdater": lambda folder: BagFogUpdaterSpec(
        initial_value=0.1, final_value=0.35, step=0.1, interval=1.0, bag="dive.bag",
        image_topic=IMAGE, info_topic=INFO, image_depth=2.0, path=str(folder / "b.xml"),
    ),
    "cameraNoiseUpdater": lambda folder: CameraNoiseUpdaterSpec(
        initial_value=0.01, final_value=0.025, step=0.01, interval=1.0
    ),
    "currentForceUpdater": lambda folder: current(),
    "repeat": lambda folder: RepeatSpec(iterations=2, interval=1.0),
    "sceneFogUpdater": lambda folder: SceneFogUpdaterSpec(
        quantity="attenuationLength", initial_value=8.0, final_value=4.0, step=-2.0, interval=1.0
    ),
    "sceneLightUpdater": lambda folder: SceneLightUpdaterSpec(
        initial_value=0.5, final_value=1.1, step=0.5, interval=1.0
    ),
    "u:seaStateUpdater": lambda folder: SeaStateUpdaterSpec(
        initial_value=0.0, final_value=0.6, step=0.5, interval=1.0
    ),
    "u:settingUpdater": lambda folder: SettingUpdaterSpec(
        path="oceanState.oceanSurfaceHeight", initial_value=0.0, final_value=0.5, step=0.5,
        interval=1.0,
    ),
    "u:waterUpdater": lambda folder: WaterUpdaterSpec(
        initial_value=0.5, final_value=1.6, step=0.5, interval=1.0
    ),
}  # fmt: skip
"""Element -> a sweep of two or three levels."""


def nested(*specs: SceneUpdaterSpec) -> SceneUpdaterSpec:
    """Put each into the one before it."""
    inner: SceneUpdaterSpec | None = None
    for spec in reversed(specs):
        inner = replace(spec, child=inner)
    assert inner is not None
    return inner


def test_every_kind_of_updater_is_nested_here() -> None:
    assert set(MAKE) == set(UPDATERS) - {"none"}


def share_scene(elements: tuple[str, ...]) -> bool:
    """Return whether the scene of some updaters can exist."""
    return not {"sceneFogUpdater", "u:waterUpdater"} <= {*elements}


def triples() -> list[tuple[str, ...]]:
    """Every kind in every other, and in that the kind that the alphabet has next.

    Fog and physical water, which has none, do not share a scene.
    """
    kinds = list(MAKE)
    found = []
    for outer, middle in itertools.permutations(kinds, 2):
        following = kinds[kinds.index(middle) + 1 :] + kinds
        candidates = ((outer, middle, kind) for kind in following if kind not in (outer, middle))
        found += itertools.islice((triple for triple in candidates if share_scene(triple)), 1)
    return found


class Values:
    """Reads what a level has set."""

    def __init__(self, world: FakeWorld) -> None:
        self._world = world
        self._seen: list[np.ndarray] = []
        world.bus.subscribe(IMAGE, Image, lambda said: self._seen.append(pixels_of(said)))

    def has(self, element: str, value: float) -> bool:
        """Tell whether the scene is as this value of this updater wants it."""
        world = self._world
        if element == "armMoveUpdater":
            return world.joints[VEHICLE] == dict(enumerate(ARM.joints(value).tolist()))
        if element == "bagFogUpdater":
            t = math.exp(-((value * 2.0) ** 2))
            fog = 255 * (0.05 * 0.587 + 0.3 * 0.114)
            return bool((self._seen[-1] == round(200 * t + (1 - t) * fog)).all())
        if element == "cameraNoiseUpdater":
            return world.camera_noise == value
        if element == "currentForceUpdater":
            assert world.current is not None
            still, flows = (
                world.current.velocity(np.zeros((1, 3)), time)[0]
                for time in (world.time, world.time + 2.0)
            )
            put_back = world.put_backs[-1]
            return not still.any() and flows[1] == pytest.approx(value) and put_back[0] == VEHICLE
        if element == "sceneFogUpdater":
            return world.fog == pytest.approx(1.0 / value)
        if element == "sceneLightUpdater":
            return world.light_rate == value
        if element == "u:seaStateUpdater":
            return world.water.wave_height == value
        if element == "u:waterUpdater":
            return world.water.settings[-1][0].beam_attenuation[1] == pytest.approx(value)
        return element in ("repeat", "u:settingUpdater")  # the scene was opened with it


@pytest.mark.parametrize("elements", triples(), ids="-".join)
def test_three_deep_every_value_stands_at_every_level_and_restarts(
    folder: Path, elements: tuple[str, ...]
) -> None:
    specs = [MAKE[element](folder) for element in elements]
    spec = nested(*specs)
    played = levels(spec)
    assert n_levels(spec) == len(played) == math.prod(len(one.values()) for one in specs)
    expected = list(itertools.product(*(one.values() for one in specs)))  # outermost slowest
    assert [tuple(value for _, value in level.values) for level in played] == expected
    world = FakeWorld(vehicles=(VEHICLE,), timestep=0.01)
    world.water.medium = find_water("tank") if "u:waterUpdater" in elements else None
    updaters = bind_updaters(spec, world)
    values = Values(world)
    ramp_level(updaters, initial_level(spec))
    before: Level | None = None
    for level in played:
        apply_level(updaters, level, last_level=before)
        before = level
        world.advance(2)
        for element, (_, value) in zip(elements, level.values, strict=True):
            assert values.has(element, value), (str(level), element)
    for updater in updaters:
        updater.close()


def test_a_current_inside_begins_each_of_its_levels_at_rest_and_lives_through_those_within() -> (
    None
):
    spec = nested(
        RepeatSpec(iterations=2, interval=1.0), current(), MAKE["sceneLightUpdater"](Path())
    )
    world = FakeWorld(vehicles=(VEHICLE,))
    updaters = bind_updaters(spec, world)
    before: Level | None = None
    for level in levels(spec):
        apply_level(updaters, level, last_level=before)
        before = level
        world.advance(500)
    assert [time for _, time in world.put_backs] == pytest.approx([0.0, 2.0, 4.0, 6.0])


def test_the_deepest_interval_counts_and_none_may_stand_at_the_bottom() -> None:
    spec = nested(
        RepeatSpec(iterations=2, interval=3.0), replace(ARM, interval=7.0), current(interval=5.0)
    )
    assert interval(spec) == 5.0
    assert swept_parameters(spec) == ("iteration", "armPosition", "current")
    assert n_levels(nested(RepeatSpec(iterations=2, interval=3.0), ARM, NoneSpec())) == 6


@pytest.fixture
def simulation() -> Iterator[Simulation]:
    simulation = open_scene(tank())
    simulation.advance(0.0)
    yield simulation
    simulation.close()


def test_a_restart_brings_back_force_and_pose_in_a_simulation(simulation: Simulation) -> None:
    spec = nested(RepeatSpec(iterations=2, interval=1.0), current(initial_value=0.0), ARM)
    updaters = bind_updaters(spec, simulation.world.stage_view)
    start = simulation.world.bodies.find(VEHICLE).world_from_body.position
    joints = {}
    drifted = {}
    before: Level | None = None
    for level in levels(spec):
        apply_level(updaters, level, last_level=before)
        before = level
        joints[level] = simulation.world.vehicles.find(VEHICLE).joints[:2]
        for _ in range(1250):
            simulation.advance()
        drifted[level] = np.linalg.norm(
            simulation.world.bodies.find(VEHICLE).world_from_body.position - start
        )
    for level in levels(spec):
        (_, iteration), (_, speed), (_, arm) = level.values
        assert joints[level] == pytest.approx(ARM.joints(arm))
        # each current stands for three arms of 2.5 s, of which the first 2 s are still
        assert drifted[level] == pytest.approx(speed * (2.5 * (arm + 1.0) - 2.0), abs=1e-3)
        assert iteration in (0.0, 1.0)


class Idle:
    """Does nothing at all."""

    def start(self, node: Node) -> None:
        pass


NESTED = """<repeat> <iterations>2</iterations> <interval>9</interval> <sceneUpdater>
<armMoveUpdater>
  <armPosition> <joint>0</joint> </armPosition> <armPosition> <joint>1</joint> </armPosition>
  <step>0</step> <interval>9</interval> <target>girona500</target> <sceneUpdater>
<cameraNoiseUpdater>
  <initialValue>0</initialValue> <finalValue>0.1</finalValue> <step>0.05</step>
  <interval>0.1</interval>
</cameraNoiseUpdater> </sceneUpdater> </armMoveUpdater> </sceneUpdater> </repeat>"""


@pytest.mark.parametrize("mode", ["sequential", "independent"])
def test_a_nested_file_is_played_outermost_slowest_in_both_modes(tmp_path: Path, mode: str) -> None:
    rows = rows_of(make_plan(tmp_path, Idle, NESTED, mode=mode))  # type: ignore[arg-type]
    assert [tuple(value for _, value in row.values) for row in rows] == list(
        itertools.product((0.0, 1.0), (0.0, 1.0), (0.0, 0.05, 0.1))
    )
    assert [name for name, _ in rows[0].values] == ["iteration", "armPosition", "noise"]
    assert {round(row.duration, 6) for row in rows} == {0.1}
