"""Forces on bodies: in the step in which they are computed, with their reaction, and saved."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from tests.simulation.girona500 import SCENE
from tests.support.opened import open_scene
from uwsim.base.geometry import Array, Pose
from uwsim.base.record import RandomState
from uwsim.checks import check_file
from uwsim.devices.force_sensor import ForceSensorSpec
from uwsim.errors import SceneError, SimulationFailed, UnknownName, UwsimError
from uwsim.forces import DockingMagnetSpec, Force, ForceSpec
from uwsim.forces.docking_magnet import MagnetSpec
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.reader import read_scene
from uwsim.scene.settings import apply_setting
from uwsim.scene.sim_params import SimParamsSpec
from uwsim.scene.spec import SceneSpec
from uwsim.scene.writer import write_scene
from uwsim.simulation import Simulation
from uwsim.simulation.world_views.force_view import ForceView
from uwsim.world import Attachment, ForceWorld

NOMINAL = read_scene(SCENE).nominal_scene
BLACKBOX = next(thing for thing in NOMINAL.objects if thing.name == "blackbox")
GIRONA = replace(NOMINAL.vehicles[0], parts=())
STEP = 0.002  # [s]
WEIGHTLESS = (0.0, 0.0, -1e-12)  # in the original's physics: three zeros are 1 m/s2 down


@dataclass(frozen=True, kw_only=True)
class PullSpec(ForceSpec):
    """A constant wrench at a point of a body."""

    name: str = "pull"
    body: str
    at: tuple[float, float, float] = (0.0, 0.0, 0.0)
    wrench: tuple[float, ...]

    def bind(self, world: ForceWorld) -> Pull:
        return Pull(world.attach(self.body, self.at), np.array(self.wrench))


class Pull(Force):
    def __init__(self, attachment: Attachment, wrench: Array) -> None:
        self.attachment, self._wrench = attachment, wrench

    def wrenches(self, time: float) -> Iterable[tuple[Attachment, Array]]:
        yield self.attachment, self._wrench


@dataclass(frozen=True, kw_only=True)
class GustSpec(ForceSpec):
    """A force that is drawn at random in each step."""

    body: str

    def bind(self, world: ForceWorld) -> Gust:
        return Gust(world.attach(self.body), world.stream("gust"))


class Gust(Force):
    def __init__(self, attachment: Attachment, random: np.random.Generator) -> None:
        self._attachment, self.state = attachment, RandomState(random)

    def wrenches(self, time: float) -> Iterable[tuple[Attachment, Array]]:
        yield self._attachment, np.array([*self.state.rng.standard_normal(3), 0.0, 0.0, 0.0])


class Probe(Force):
    """Records what it sees, and pushes nothing."""

    def __init__(self, world: ForceWorld, body: str, at: tuple[float, float, float]) -> None:
        self._world, self._attachment = world, world.attach(body, at)
        self.seen: list[dict[str, Any]] = []

    def wrenches(self, time: float) -> Iterable[tuple[Attachment, Array]]:
        here = self._attachment
        place = here.world_from_body.position
        self.seen.append(
            {
                "time": time,
                "place": place,
                "velocity": here.motion().velocity,
                "spin": here.motion().angular_velocity,
                "water": self._world.water_velocity(place[None], time, here.vehicle)[0],
                "density": self._world.water_density(place[None] + [[0, 0, 0], [0, 0, 99.0]]),
            }
        )
        return ()


@dataclass(frozen=True, kw_only=True)
class ProbeSpec(ForceSpec):
    name: str = "probe"
    body: str
    at: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def bind(self, world: ForceWorld) -> Probe:
        return Probe(world, self.body, self.at)


def box(name: str = "box", x: float = 0.0, **physics: Any) -> ObjectSpec:
    """A box whose centre of mass is its origin; its added mass and drag are those of 0.2 m."""
    body = PhysicsSpec(**{"mass": 10.0, "centre_of_mass": (0.0, 0.0, 0.0), **physics})
    return replace(
        BLACKBOX, name=name, is_solid=None, position=(x, 0.0, 2.0), orientation=(0.0, 0.0, 0.0),
        physics=body,
    )  # fmt: skip


def middle() -> tuple[float, float, float]:
    """Where in the mesh frame of a box its centre of mass is."""
    mesh = box().object_from_mesh
    x, y, z = (
        Pose(np.array(BLACKBOX.scale_factor) * mesh.position, mesh.rotation).inverse().position
    )
    return float(x), float(y), float(z)


MIDDLE = middle()


def falling(*objects: ObjectSpec, forces: tuple[ForceSpec, ...] = ()) -> Simulation:
    """Objects without any water: the original's physics, next to no gravity, L being W."""
    params = SimParamsSpec(enable_physics=True, gravity=WEIGHTLESS)
    return open_scene(SceneSpec(sim_params=params, objects=objects, forces=forces), is_blind=True)


def in_water(
    *objects: ObjectSpec, forces: tuple[ForceSpec, ...] = (), vehicles: int = 1
) -> Simulation:
    """Simulated vehicles far from some objects."""
    robots = tuple(
        replace(GIRONA, name=f"girona{i}", position=(20.0 + 5.0 * i, 20.0, 2.0))
        for i in range(vehicles)
    )
    scene = replace(NOMINAL, vehicles=robots, objects=objects, ros_interfaces=(), forces=forces)
    return open_scene(scene, is_blind=True)


def engine(simulation: Simulation) -> tuple[mujoco.MjModel, mujoco.MjData]:
    return simulation.world.engine._model, simulation.world.engine._data


def velocity(simulation: Simulation, number: int = 0) -> np.ndarray:
    """Of an object's origin, in W, then of its turning, in its axes, (6,)."""
    model, data = engine(simulation)
    dof = int(model.body_dofadr[model.body(f"object/{number}").id])
    return np.array(data.qvel[dof : dof + 6])


def generalised(simulation: Simulation, body: str, point: Array, wrench: Array) -> np.ndarray:
    """What a wrench in W about a point of a body does to the degrees of freedom, (nv,)."""
    model, data = engine(simulation)
    found = np.zeros(model.nv)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_applyFT(model, data, wrench[:3], wrench[3:], point, model.body(body).id, found)
    return found


def test_a_force_acts_in_the_step_in_which_it_is_computed() -> None:
    with falling(box(), forces=(PullSpec(body="box", wrench=(3.0, 0, 0, 0, 0, 0)),)) as simulation:
        simulation.advance()
        assert velocity(simulation)[0] == pytest.approx(3.0 / 10.0 * STEP, rel=1e-9)


def test_a_constant_force_on_a_free_object_gives_the_closed_form_of_the_integrator() -> None:
    """Semi-implicit Euler: v = n h F/m, x = n (n + 1) / 2 h^2 F/m."""
    with falling(box(), forces=(PullSpec(body="box", wrench=(3.0, 0, 0, 0, 0, 0)),)) as simulation:
        before = simulation.pose("box").position[0]
        simulation.advance(1.0)
        n = 500
        assert velocity(simulation)[0] == pytest.approx(0.3, rel=1e-9)
        moved = simulation.pose("box").position[0] - before
        assert moved == pytest.approx(n * (n + 1) / 2 * STEP**2 * 0.3, rel=1e-7)


def test_a_force_off_the_centre_of_mass_also_turns_the_object() -> None:
    pull = PullSpec(body="box", at=(0.0, 0.5, 0.0), wrench=(3.0, 0, 0, 0, 0, 0.25))
    thing = box(inertia=(1.0, 1.0, 1.0))
    with falling(thing, forces=(pull,)) as simulation:
        attached = simulation.world.forces[0].attachment.world_from_body.position
        lever = attached - simulation.world.engine.poses.object(0).position
        simulation.advance()
        torque = np.cross(lever, [3.0, 0, 0]) + np.array([0, 0, 0.25])
        assert velocity(simulation)[3:] == pytest.approx(torque * STEP, abs=1e-8)


def test_a_towed_ball_comes_to_the_speed_at_which_its_drag_is_the_force() -> None:
    """F = rho / 2 * 0.47 * pi R^2 v^2: the drag of `uwsim.physics.free_objects`."""
    ball = box(mass=20.0, volume=0.02, collision_shape_type="sphere", centre_of_mass=None)
    with in_water(ball) as simulation:
        density = simulation.world.model.density_levels[0][1]
        model, data = engine(simulation)
        mesh = simulation.world.bodies.find("box").world_from_body
        centre = mesh.inverse().transform(data.xipos[[model.body("object/0").id]])[0]
    pull = PullSpec(body="box", at=tuple(centre), wrench=(20.0, 0, 0, 0, 0, 0))
    with in_water(ball, forces=(pull,)) as simulation:
        model, _ = engine(simulation)
        radius = float(model.geom_size[model.body_geomadr[model.body("object/0").id], 0])
        speed = math.sqrt(2.0 * 20.0 / (density * 0.47 * math.pi * radius**2))
        simulation.advance(20.0)
        assert velocity(simulation)[:3] == pytest.approx([speed, 0, 0], abs=1e-3 * speed)


@pytest.mark.parametrize("link", ["base_link", "end_effector"])
def test_a_force_on_a_link_is_felt_by_base_and_joints_as_its_jacobian_says(link: str) -> None:
    wrench = np.array([4.0, -7.0, 2.0, 1.0, 0.5, -0.25])
    at = (0.1, 0.2, -0.05)
    pull = PullSpec(body=f"girona0/{link}", at=at, wrench=tuple(wrench))
    with in_water() as plain, in_water(forces=(pull,)) as simulation:
        world_from_link = plain.world.bodies.find(f"girona0/{link}").world_from_body
        point = world_from_link.position + world_from_link.rotation @ np.array(at)
        plain.advance(0.0)
        expected = generalised(plain, f"vehicle/0/{link}", point, wrench)
        simulation.advance(0.0)
        plain.advance()
        simulation.advance()
        felt = engine(simulation)[1].qfrc_smooth - engine(plain)[1].qfrc_smooth
        assert felt == pytest.approx(expected, rel=1e-3, abs=1e-3)
        assert (np.abs(expected[6:]) > 0.1).any() is np.bool_(link == "end_effector")
        assert not np.array_equal(plain.velocity("girona0"), simulation.velocity("girona0"))


def wrist_wrench(simulation: Simulation) -> np.ndarray:
    """What the end effector of the first vehicle does to its joint, in W, (6,) [N, N m]."""
    vehicle = simulation.world.vehicles[0]
    wrist = ForceSensorSpec(name="wrist", target="end_effector", measures="joint")
    found = vehicle.wrench_sampler(wrist, at_joint=True).take(0.0).reshape(2, 3)
    return (found @ vehicle.mount(wrist).world_from_body.rotation.T).ravel()


def test_a_force_is_what_is_applied_by_hand_also_to_a_sensor_in_the_joint() -> None:
    wrench = np.array([4.0, -7.0, 5.0, 1.0, 0.5, -0.25])
    pull = PullSpec(body="girona0/end_effector", wrench=tuple(wrench))
    with in_water() as plain, in_water(forces=(pull,)) as simulation:
        (model, data), link = engine(plain), "vehicle/0/end_effector"
        readings, poses = [], plain.world.engine.poses
        for _ in range(20):
            place, body = poses.link(0, "end_effector").position, model.body(link).id
            data.xfrc_applied[body, :3] = wrench[:3]
            lever = place - data.xipos[body]
            data.xfrc_applied[body, 3:] = wrench[3:] + np.cross(lever, wrench[:3])
            plain.advance()
            simulation.advance()
        for each in (plain, simulation):
            readings.append(wrist_wrench(each))
        assert engine(simulation)[1].qpos == pytest.approx(data.qpos, abs=1e-12)
        assert readings[1] == pytest.approx(readings[0], abs=1e-9)
        data.xfrc_applied[:] = 0.0
        without = wrist_wrench(plain)
        assert readings[0][:3] - without[:3] == pytest.approx(wrench[:3], abs=1e-9)


def test_only_the_vehicle_that_is_named_is_pushed() -> None:
    pull = PullSpec(body="girona1", wrench=(200.0, 0, 0, 0, 0, 0))
    with in_water(vehicles=2) as plain, in_water(vehicles=2, forces=(pull,)) as simulation:
        plain.advance(0.1)
        simulation.advance(0.1)
        assert simulation.velocity("girona0").tolist() == plain.velocity("girona0").tolist()
        change = simulation.velocity("girona1") - plain.velocity("girona1")
        assert np.linalg.norm(change[:3]) > 0.01


@pytest.mark.parametrize("seconds", [0.002, 0.1])
def test_steps_taken_at_once_ask_the_force_in_each(seconds: float) -> None:
    with in_water(box(), forces=(ProbeSpec(body="box"),)) as simulation:
        simulation.advance(seconds)
        times = [seen["time"] for seen in simulation.world.forces[0].seen]
        assert times == pytest.approx(np.arange(round(seconds / STEP)) * STEP)


def test_a_force_sees_places_velocities_and_the_water_at_the_beginning_of_the_step() -> None:
    at = (0.3, 0.0, 0.1)
    link = "girona0/end_effector"
    with in_water(forces=(ProbeSpec(body=link, at=at),)) as simulation:
        simulation.set_current([0.1, 0.2, 0.0])
        simulation.advance(0.2)
        seen = simulation.world.forces[0].seen
        here = simulation.world.bodies.find(link).world_from_body
        assert np.linalg.norm(seen[-1]["velocity"]) > 1e-4
        gone = (seen[-1]["place"] - seen[-2]["place"]) / STEP
        assert seen[-1]["velocity"] == pytest.approx(gone, rel=0.05, abs=1e-4)
        lever = here.rotation @ np.array(at)
        assert seen[-1]["place"] == pytest.approx(here.position + lever, abs=1e-3)
        turn = simulation.world.model.scene.world_from_localized.rotation
        assert seen[-1]["water"] == pytest.approx(turn @ [0.1, 0.2, 0.0])
        assert seen[-1]["density"][0] == simulation.world.model.density_levels[0][1]
        assert seen[-1]["density"][1] == 0.0  # above the surface


def test_the_velocity_of_a_point_of_a_loose_object_has_its_turning_in_it() -> None:
    with falling(box(), forces=(ProbeSpec(body="box", at=(0.0, 0.5, 0.0)),)) as simulation:
        model, data = engine(simulation)
        dof = int(model.body_dofadr[model.body("object/0").id])
        data.qvel[dof + 5] = 2.0  # about z, its own and W's
        place = simulation.world.forces[0]._attachment.world_from_body.position
        middle = simulation.world.engine.poses.object(0).position
        simulation.advance()
        seen = simulation.world.forces[0].seen[0]
        assert seen["velocity"] == pytest.approx(np.cross([0, 0, 2.0], place - middle), abs=1e-9)
        assert seen["spin"] == pytest.approx([0, 0, 2.0])


def magnets(moment: float, *, second: str = "right") -> DockingMagnetSpec:
    along = (moment, 0.0, 0.0)
    return DockingMagnetSpec(
        name="latch",
        closest=0.05,
        first=MagnetSpec(body="left", position=MIDDLE, moment=along),
        second=MagnetSpec(body=second, position=MIDDLE, moment=along),
    )


def test_two_magnets_in_line_gain_the_energy_of_their_field_and_no_momentum() -> None:
    """Their energy is -mu m1 m2 / (2 pi r^3); of equal masses m each gets the half."""
    left, right = box("left"), box("right", x=2.0)
    mass = 10.0  # [kg]
    with falling(left, right, forces=(magnets(2000.0),)) as simulation:
        start = distance(simulation)
        assert start == pytest.approx(2.0)
        while distance(simulation) > 1.0 and simulation.time < 30.0:
            simulation.advance()
        end = distance(simulation)
        first, second = velocity(simulation, 0), velocity(simulation, 1)
        assert end < 1.0
        assert mass * (first + second)[:3] == pytest.approx(np.zeros(3), abs=1e-9)
        strength = 4e-7 * math.pi * 2000.0**2 / (2.0 * math.pi)
        gained = strength * (end**-3 - start**-3)
        assert mass * first[0] ** 2 == pytest.approx(gained, rel=0.01)


def distance(simulation: Simulation) -> float:
    poses = simulation.world.engine.poses
    return float(np.linalg.norm(poses.object(1).position - poses.object(0).position))


def test_a_magnet_on_a_vehicle_pulls_it_as_it_pulls_the_object() -> None:
    """The impulses in one step on both trees add up to nothing."""
    spec = DockingMagnetSpec(
        name="latch",
        closest=0.05,
        first=MagnetSpec(body="girona0/end_effector", moment=(500.0, 200.0, 0.0)),
        second=MagnetSpec(body="box", moment=(300.0, 0.0, 100.0)),
    )
    thing = replace(box(), position=(21.5, 20.0, 2.5))
    with in_water(thing, forces=(spec,)) as simulation:
        simulation.advance()
        model, data = engine(simulation)
        applied = data.xfrc_applied[:, :3]
        on = {model.body(int(i)).name for i in np.flatnonzero(np.abs(applied).sum(axis=1))}
        assert on == {"vehicle/0/end_effector", "object/0"}
        assert applied.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-12)
        torques = data.xfrc_applied[:, 3:] + np.cross(data.xipos, applied)
        scale = float(np.abs(np.cross(data.xipos, applied)).max())
        assert torques.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-3 * scale)


@pytest.mark.parametrize("forces", [(GustSpec(name="gust", body="box"),), (magnets(50.0),)])
def test_a_restored_simulation_goes_on_to_the_bit(forces: tuple[ForceSpec, ...]) -> None:
    objects = [box(), box("left", x=1.5), box("right", x=3.0)]
    with in_water(*objects, forces=forces) as simulation:
        simulation.advance(0.1)
        saved = simulation.save()
        simulation.advance(0.1)
        after = engine(simulation)[1].qpos.tobytes()
        simulation.restore(saved)
        simulation.advance(0.1)
        assert engine(simulation)[1].qpos.tobytes() == after
    with in_water(*objects, forces=forces) as other:
        other.restore(saved)
        other.advance(0.1)
        assert engine(other)[1].qpos.tobytes() == after


def test_a_scene_without_forces_touches_nothing_of_the_engine() -> None:
    with in_water(box()) as simulation:
        assert simulation.world.forces == ()
        data = engine(simulation)[1]
        data.xfrc_applied[1, 2] = 1.0  # would be cleared
        simulation.advance(0.1)
        assert data.xfrc_applied[1, 2] == 1.0


@pytest.mark.parametrize("wrench", [(math.nan, 0, 0, 0, 0, 0), (0, 0, 1.0)])
def test_a_force_that_is_no_six_numbers_ends_the_run_with_its_name(
    wrench: tuple[float, ...],
) -> None:
    with (
        falling(box(), forces=(PullSpec(body="box", wrench=wrench),)) as simulation,
        pytest.raises(
            SimulationFailed,
            match=r"'pull' \(PullSpec\) acts on 'box' with \[.*at 0 s; expected six",
        ),
    ):
        simulation.advance()


def fail(*_: object) -> None:
    raise ZeroDivisionError("of mine")


def refuse(_: object) -> None:
    raise UnknownName("body", "nowhere", ())


@pytest.mark.parametrize(
    "answer",
    [
        lambda attachment: None,
        lambda attachment: "no wrench",
        lambda attachment: (attachment, np.zeros(6)),
        lambda attachment: [(attachment, np.array([None] * 6))],
        lambda attachment: [(attachment, np.zeros(6, complex))],
        lambda attachment: [(attachment, [1.0, [2.0], 3.0, 4.0, 5.0, 6.0])],
        lambda attachment: [(attachment, "123456")],
        lambda attachment: [(attachment, [10**400] * 6)],
        lambda attachment: [(None, [math.nan] * 6)],
        fail,
        lambda attachment: map(fail, [attachment]),
        refuse,
    ],
)
@pytest.mark.parametrize("is_bundled", [True, False])
def test_a_force_that_fails_is_named_with_the_time(
    answer: Callable[[Attachment], Any],
    is_bundled: bool,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    if is_bundled:
        simulation = open_scene(read_scene(scene_file(tmp_path)), is_blind=True)
        named = r"The force 'latch' \(<u:dockingMagnet>\)"
    else:
        simulation = falling(box(), forces=(PullSpec(body="box", wrench=(0.0,) * 6),))
        named = r"The force 'pull' \(PullSpec\)"
    with simulation:
        attachment = ForceView(simulation.world).attach("girona500" if is_bundled else "box")
        force = simulation.world.forces[0]
        monkeypatch.setattr(force, "wrenches", lambda time: answer(attachment))
        with pytest.raises(UwsimError, match=rf"^{named} (raised|returned|acts on) .* at 0 s.*$"):
            simulation.advance()


def test_an_object_is_found_although_a_link_has_its_name() -> None:
    pull = PullSpec(body="part0", at=(0.1, 0.2, 0.3), wrench=(1.0, 0, 0, 0, 0, 0))
    with in_water(box("part0"), forces=(pull,)) as simulation:
        here = simulation.world.forces[0].attachment.world_from_body
        assert np.linalg.norm(here.position[:2]) < 2.0  # the vehicle is far away
        simulation.advance()
        assert velocity(simulation)[0] > 0.0


def test_the_frame_of_an_object_is_that_of_its_mesh() -> None:
    scaled = replace(box(), scale_factor=(2.0, 1.0, 0.5), orientation=(0.1, 0.2, 0.3))
    probe = PullSpec(body="box", at=(0.1, 0.2, 0.3), wrench=(0.0,) * 6)
    with falling(scaled, forces=(probe,)) as simulation:
        mesh = simulation.world.bodies.find("box").world_from_body
        here = simulation.world.forces[0].attachment.world_from_body
        assert here.rotation == pytest.approx(mesh.rotation)
        expected = mesh.position + mesh.rotation @ [0.1, 0.2, 0.3]
        assert here.position == pytest.approx(expected, abs=1e-12)


def test_a_force_that_acts_on_what_it_has_not_attached_is_an_error() -> None:
    with falling(box(), forces=(PullSpec(body="box", wrench=(0.0,) * 6),)) as simulation:
        simulation.world.forces[0].attachment = simulation.world.bodies.find("box")
        with pytest.raises(
            UwsimError, match=r"acts on a SceneBody at 0 s; expected what attach\(\)"
        ):
            simulation.advance()


def test_a_kinematic_vehicle_and_a_fixed_object_are_not_moved_by_a_force() -> None:
    vehicle = replace(GIRONA, dynamics=None)
    params = SimParamsSpec(enable_physics=True, gravity=WEIGHTLESS)
    fixed = box("fixed", x=5.0, mass=0.0)
    pulls = tuple(PullSpec(body=n, wrench=(1e3, 0, 0, 0, 0, 0)) for n in ("girona500", "fixed"))
    scene = SceneSpec(
        sim_params=params,
        vehicles=(vehicle,),
        objects=(box(), fixed),
        forces=pulls,
        path=str(SCENE),
    )
    with open_scene(scene, is_blind=True) as simulation:
        before = [simulation.pose(name).position for name in ("girona500", "fixed")]
        simulation.advance(0.1)
        after = [simulation.pose(name).position for name in ("girona500", "fixed")]
        assert np.array(after) == pytest.approx(np.array(before))


TEXT = """<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle> <name>girona500</name> <file>data/scenes/g500ARM5.urdf</file>
    <position> <x>0</x> <y>0</y> <z>-3</z> </position>
    <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
    {dynamics}
  </vehicle>
  <u:forces>
    <u:dockingMagnet> <name>latch</name>
      <first>
        <body>{first}</body> <moment> <x>5</x> <y>0</y> <z>0</z> </moment> </first>
      <second>
        <body>girona500/part0</body> <moment> <x>5</x> <y>0</y> <z>0</z> </moment> </second>
      <closest>{closest}</closest>
    </u:dockingMagnet>
  </u:forces>
</UWSimScene>
"""
DYNAMICS = "<u:dynamics>g500_physical</u:dynamics>"


def scene_file(folder: Path, **given: str) -> Path:
    values = {"dynamics": DYNAMICS, "first": "girona500/base_link", "closest": "0.05", **given}
    path = folder / "scene.xml"
    path.write_text(TEXT.format(**values))
    return path


def test_a_scene_with_a_magnet_is_read_and_written_back(tmp_path: Path) -> None:
    scene = read_scene(scene_file(tmp_path))
    assert [type(force).__name__ for force in scene.forces] == ["DockingMagnetSpec"]
    again = tmp_path / "again.xml"
    again.write_text(write_scene(scene))
    assert read_scene(again).forces == scene.forces


def test_a_number_of_a_force_can_be_set(tmp_path: Path) -> None:
    scene = read_scene(scene_file(tmp_path))
    changed = apply_setting(scene, "forces.dockingMagnet[latch].first.moment.x", "7")
    [force] = changed.forces
    assert isinstance(force, DockingMagnetSpec)
    assert force.first.moment == (7.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("given", "line", "message"),
    [
        ({"first": "girona500/base_lnk"}, 10, "Did you mean 'girona500/base_link'?"),
        ({"first": "dock"}, 10, "No vehicle, link or object is called 'dock'"),
        ({"closest": "0"}, 13, "expected a number > 0 and <= 100 [m]"),
        ({"dynamics": ""}, 8, "forces do not move 'girona500/base_link' and 'girona500/part0'"),
    ],
)
def test_check_reports_what_is_wrong_with_a_force_with_its_line(
    given: dict[str, str], line: int, message: str, tmp_path: Path
) -> None:
    found = [d for d in check_file(scene_file(tmp_path, **given)) if message in d.message]
    assert [(each.line, each.severity) for each in found] == [
        (line, "warning" if "dynamics" in given else "error")
    ]


def test_a_body_that_is_not_there_is_an_error_when_the_scene_is_opened(tmp_path: Path) -> None:
    scene = read_scene(scene_file(tmp_path, first="dock"))
    with pytest.raises(SceneError, match=r"scene.xml:8: the force 'latch': No vehicle, link"):
        open_scene(scene, is_blind=True)
    with pytest.raises(UnknownName):
        falling(box(), forces=(PullSpec(body="bx", wrench=(0.0,) * 6),))
