"""The ARM5E's jaw takes a flight recorder by its handle, lifts it, holds it and carries it."""

from dataclasses import replace

import numpy as np
import pytest

from tests.simulation.girona500 import SCENE, run
from tests.support.opened import open_scene
from uwsim.base.geometry import Pose, quaternion_from_rotation
from uwsim.messages import JointState, Point, Quaternion, header
from uwsim.messages import Pose as PoseMessage
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.reader import read_scene
from uwsim.scene.sim_params import ContactMode
from uwsim.scene.urdf.kinematics import link_poses
from uwsim.scene.urdf.reader import read_urdf
from uwsim.schema import Spec
from uwsim.topics import InterfaceSpec
from uwsim.topics.ros_joint_state_to_arm import ROSJointStateToArmSpec
from uwsim.topics.ros_pose_to_pat import ROSPoseToPATSpec
from uwsim.world import GRAVITY

ARM = [0.0, 0.48, 0.563, 0.0]  # the jaw points down
OPEN, CLOSED = 0.3, -0.05
BAR = 0.135  # of the handle below the wrist, within the fingers' reach [m]
BAR_OVER_BOX = 0.128  # over the box's middle [m]
VOLUME = 0.0067  # of a box of 0.15 x 0.32 x 0.14 m, m3


class Grasp:
    """A vehicle that stays in its place, its open jaw around the handle of a box on a stand."""

    def __init__(
        self,
        mass: float = 12.0,
        timestep: float = 0.002,
        *,
        friction: float | None = None,
        contacts: ContactMode = "default",
        parts: tuple[Spec, ...] = (),
        topics: tuple[InterfaceSpec, ...] = (),
    ) -> None:
        scene = read_scene(SCENE).nominal_scene
        vehicle = replace(scene.vehicles[0], parts=parts, joint_values=(*ARM, OPEN))
        self.place = vehicle.localized_from_base
        robot = read_urdf(SCENE.parent / "g500ARM5.urdf")
        wrist = self.place @ link_poses(robot, [*ARM, OPEN])["part4_base"]
        middle = wrist.transform(np.array([[0.0, 0.0, BAR + BAR_OVER_BOX]]))[0]
        box = ObjectSpec(
            name="blackbox",
            file="objects/blackbox_standard.osg",
            position=tuple(middle),
            orientation=(0.0, np.pi, np.pi / 2),
            physics=PhysicsSpec(
                mass=mass, collision_shape_type="compound box", volume=VOLUME, friction=friction
            ),
        )
        stand = ObjectSpec(
            name="stand",
            file="objects/blackbox_uib_trimesh.osg",  # 0.15 m high
            position=(middle[0], middle[1], middle[2] + 0.07 + 0.075),
            physics=PhysicsSpec(mass=0.0),
        )
        interfaces = (
            ROSPoseToPATSpec(topic="/pose", vehicle_name="girona500"),
            ROSJointStateToArmSpec(topic="/arm", vehicle_name="girona500"),
            *topics,
        )
        self.simulation = open_scene(
            replace(
                scene,
                vehicles=(vehicle,),
                objects=(box, stand),
                ros_interfaces=interfaces,
                sim_params=replace(scene.sim_params, contacts=contacts),
            ),
            timestep=timestep,
        )
        self.simulation.advance(0.0)
        self.go_up(0.0)
        run(self.simulation, 1.0)

    def jaw(self, opening: float) -> None:
        """Close or open the jaw, and wait until it has."""
        self._bend(["JawOpening"], position=[opening])
        run(self.simulation, 1.5)

    def lift(self) -> None:
        """Close the jaw and rise by 0.3 m."""
        self.jaw(CLOSED)
        self.go_up(0.3)
        run(self.simulation, 5.0)

    def turn(self, slew: float, shoulder: float, elbow: float, wrist: float) -> None:
        """Turn the arm with these speeds from now on [rad/s]."""
        names = ["Slew", "Shoulder", "Elbow", "JawRotate"]
        self._bend(names, velocity=[slew, shoulder, elbow, wrist])

    def go_up(self, height: float) -> None:
        x, y, z = self.place.position
        qw, qx, qy, qz = quaternion_from_rotation(self.place.rotation).tolist()
        message = PoseMessage(
            position=Point(x=x, y=y, z=z - height), orientation=Quaternion(x=qx, y=qy, z=qz, w=qw)
        )
        self.simulation.bus.publisher("/pose", PoseMessage)(message)

    def box_in_jaw(self) -> Pose:
        wrist = self.simulation.world.bodies.find("girona500/part4_base").world_from_body
        return wrist.inverse() @ self.simulation.world.bodies.find("blackbox").world_from_body

    @property
    def touches(self) -> set[str]:
        return {contact.other for contact in self.simulation.world.contacts.find("blackbox")}

    def _bend(self, names: list[str], **given: list[float]) -> None:
        arrays = {
            name: np.array(given.get(name, [])) for name in ("position", "velocity", "effort")
        }
        message = JointState(header=header(0.0), name=names, **arrays)
        self.simulation.bus.publisher("/arm", JointState)(message)


def slip(before: Pose, after: Pose) -> float:
    return float(np.linalg.norm(after.position - before.position))


@pytest.mark.parametrize("timestep", [0.002, 0.005, 0.01])
def test_a_lifted_box_is_held_for_ten_seconds(timestep: float) -> None:
    grasp = Grasp(timestep=timestep)
    grasp.lift()
    start = grasp.box_in_jaw()
    run(grasp.simulation, 10.0)
    assert grasp.touches == {"girona500"}
    assert slip(start, grasp.box_in_jaw()) < 0.001


@pytest.mark.parametrize("timestep", [0.002, 0.005, 0.01])
def test_a_lifted_box_is_held_for_ten_seconds_and_while_the_arm_moves(timestep: float) -> None:
    grasp = Grasp(timestep=timestep)
    grasp.lift()
    start = grasp.box_in_jaw()
    assert grasp.touches == {"girona500"}
    run(grasp.simulation, 10.0)
    held = grasp.box_in_jaw()
    assert slip(start, held) < 0.001  # 0.49 mm: the creep of soft friction
    for speeds, seconds in (
        ((0.1, 0.0, 0.0, 0.0), 4.0),
        ((-0.1, 0.1, -0.1, 0.0), 4.0),
        ((0.0, -0.1, 0.1, 0.1), 4.0),
        ((0.0, 0.0, 0.0, 0.0), 1.0),
    ):
        grasp.turn(*speeds)
        run(grasp.simulation, seconds)
    end = grasp.box_in_jaw()
    assert grasp.touches == {"girona500"}
    assert slip(held, end) < 0.005
    lean = np.degrees(np.arccos(np.clip(held.rotation[:, 2] @ end.rotation[:, 2], -1.0, 1.0)))
    assert lean < 3.0


def test_a_box_that_is_let_go_sinks() -> None:
    grasp = Grasp()
    grasp.lift()
    before = grasp.simulation.world.bodies.find("blackbox").world_from_body.position[2]
    grasp.jaw(OPEN)
    after = grasp.simulation.world.bodies.find("blackbox").world_from_body.position[2]
    assert after < before - 0.1
    assert "girona500" not in grasp.touches


def test_a_box_heavier_than_friction_can_bear_slips_out() -> None:
    """Two fingers press with 10 N m at 0.1 m: 0.8 * 2 * 100 N bears about 160 N."""
    grasp = Grasp(mass=30.0)  # 229 N in water
    grasp.lift()
    run(grasp.simulation, 5.0)
    assert "girona500" not in grasp.touches


@pytest.mark.slow
@pytest.mark.parametrize(
    ("friction", "contacts", "most"), [(0.5, "default", 0.003), (0.5, "precise", 0.0003)]
)
def test_a_box_of_52_newton_creeps_by_so_little_in_ten_seconds(
    friction: float, contacts: ContactMode, most: float
) -> None:
    grasp = Grasp(friction=friction, contacts=contacts)
    grasp.lift()
    start = grasp.box_in_jaw()
    run(grasp.simulation, 10.0)
    assert grasp.touches == {"girona500"}
    assert slip(start, grasp.box_in_jaw()) < most  # 0.50 and 0.05 mm


@pytest.mark.parametrize("friction", [0.1, 0.2])
def test_with_less_friction_than_statics_asks_for_the_box_is_not_lifted(friction: float) -> None:
    """The two fingers press with 10 N m at 0.09 m each: friction below 52 N / 222 N, 0.23."""
    grasp = Grasp(friction=friction)
    grasp.lift()
    assert grasp.touches == {"stand"}


def test_the_weight_of_a_held_box_is_what_the_fingers_feel_to_two_percent() -> None:
    grasp = Grasp()
    grasp.lift()
    run(grasp.simulation, 5.0)
    total = 0.0
    for _ in range(100):
        run(grasp.simulation, 0.02)
        total += grasp.simulation.world.contacts.forces("blackbox")["girona500"][2]
    weight = (12.0 - 1000.0 * VOLUME) * GRAVITY
    assert total / 100 == pytest.approx(weight, rel=0.02)


def test_the_fingers_stay_mirror_images_of_each_other() -> None:
    grasp = Grasp()
    grasp.lift()
    model, data = grasp.simulation.world.engine._model, grasp.simulation.world.engine._data
    data.xfrc_applied[model.body("object/0").id, :2] = 20.0  # across the jaw and along it [N]
    run(grasp.simulation, 1.0)
    first, second = (
        data.qpos[model.joint(f"vehicle/0/joint/{name}").qposadr[0]]
        for name in ("JawOpening", "part4_to_link4_jaw2")
    )
    assert first > -0.01  # on the bar; closed to -0.05 where there is none
    assert second == pytest.approx(first, abs=0.01)


def test_the_faces_of_the_fingers_are_parallel_on_the_bar_and_touch_it_with_all_corners() -> None:
    """Faces like a wedge touch the bar with one edge: load goes to one end, and the box swings."""
    grasp = Grasp()
    grasp.lift()
    fingers = {"girona500/part4_jaw1": 1.0, "girona500/part4_jaw2": -1.0}
    normals = [
        side * grasp.simulation.world.bodies.find(name).world_from_body.rotation[:, 0]
        for name, side in fingers.items()
    ]
    assert float(normals[0] @ normals[1]) < -np.cos(0.01)
    assert len(grasp.simulation.world.contacts.find("blackbox")) == 8
