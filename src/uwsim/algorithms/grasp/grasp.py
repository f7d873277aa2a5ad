"""``grasp``: an algorithm that finds a box by camera, grasps its handle with an arm and lifts it.

It reads only sensors that a real vehicle has: camera, DVL, IMU, depth sensor, joint positions and
efforts of the drives, and a force sensor in the wrist. A derived class can replace each part of the
algorithm: `Grasp.navigation`, `Grasp.detector`, `Grasp.tracker`, `Grasp.controller` and
`Grasp.kinematics`; and `Grasp.model` and `Grasp.perception` for an object other than the box.
`uwsim.algorithms.grasp.phases` describes the state machine, and the package
`uwsim.algorithms.grasp` the frames.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from typing import ClassVar

import numpy as np

from ...base.geometry import Array, Pose, rotation_from_rpy
from ...base.numerics.linear import product
from ...bus import Node
from ...errors import BadSetting, UnknownName
from ...messages import (
    CameraInfo,
    Empty,
    Image,
    JointState,
    String,
    TwistStamped,
    WrenchStamped,
    pixels_of,
)
from ..direct_tracker import DirectTracker
from ..esm.alignment import Method
from ..esm.pyramid import Grey
from ..navigation import NavigationSpec, Navigator
from ..tracker import Tracker
from ..tracker_node import merge_parameters
from .arm import Arm5e, Kinematics
from .box import BoxSpec
from .camera import Pinhole, View
from .detector import ColourDetector, Detector
from .perception import GraspModel, ObjectPerception, Perception
from .phases import PHASES, Phase
from .station import StationController, StationLaw
from .task import Task, square_spiral
from .vehicle_interface import VehicleInterface

PERIOD = 0.1
"""The period of the control loop [s]."""
OPENGL_FROM_OPENCV: Array = np.diag([1.0, -1.0, -1.0])
"""The rotation from the camera axes of OpenCV (y down, z forward) to OpenGL (y up, z back)."""
SEARCH_HEIGHT = 2.6
"""The height of the base over the seabed during the search, at which arm and camera are clear of
the seabed [m]."""


class Grasp:
    """Finds a box by camera, keeps station over the box, grasps its handle and lifts it."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "kp": 0.6,
        "ki": 0.03,
        "feed_forward": 1.0,
        "limit": 0.3,
        "search_spacing": 1.2,
        "search_radius": 2.5,
        "tolerance": 0.02,
        "descent": 0.06,
        "lift": 0.65,
        "settle": 6.0,
        "hold": 11.0,
        "attempts": 4.0,
        "min_load": 15.0,
        "camera_place": "0.22 0.12 0.98",
        "camera_rpy": "2.5818 -0.1257 1.5708",
        "dvl_place": "0.5 0 0.8",
        "image_topic": "/girona500/camera",
        "info_topic": "/girona500/camera_info",
        "imu_topic": "/girona500/imu",
        "dvl_topic": "/girona500/dvl",
        "depth_topic": "/girona500/pressure",
        "joint_topic": "/girona500/joint_state",
        "wrist_topic": "/girona500/wrist",
        "twist_topic": "/girona500/twist",
        "arm_topic": "/girona500/joint_command",
    }
    """The parameters with their defaults.

    Station keeping: gains ``kp`` [1/s] and ``ki`` [1/s2], ``feed_forward`` 1 or 0, largest
    correction ``limit`` [m/s]. Search pattern: ``search_spacing``, ``search_radius`` [m]. Grasp:
    horizontal ``tolerance`` [m], speed of ``descent`` [m/s], height of the ``lift`` [m], time
    ``settle`` for which the lift pauses until the box hangs still [s], ``hold`` time [s], number of
    ``attempts``, minimum load on the wrist ``min_load`` [N]. Mounts in the frame of the base:
    positions [m], roll pitch yaw [rad]; ``camera_rpy`` is the orientation of the camera's OpenGL
    axes (x right, y up, z back).
    """

    PHASES: ClassVar[Mapping[str, type[Phase]]] = PHASES
    """The phases by name; the first is that of the search."""

    def __init__(self) -> None:
        self._parameters: dict[str, float | str] = dict(self.PARAMETERS)
        self._info: CameraInfo | None = None
        self._phase: Phase | None = None
        self._last_time = 0.0

    @property
    def parameters(self) -> Mapping[str, float | str]:
        """The parameters in force, after `start`."""
        return dict(self._parameters)

    @staticmethod
    def check_parameters(parameters: Mapping[str, float | str]) -> None:
        """Raise BadSetting if a position or angles are not three numbers."""
        for name in ("camera_place", "camera_rpy", "dvl_place"):
            if name in parameters:
                parse_triple(name, parameters[name])

    # -- the parts, which a derived class can replace ------------------------------------------

    def navigation(self, node: Node) -> Navigator:
        """Make the estimator of the vehicle's pose and velocity, and of the seabed's depth."""
        position = parse_triple("dvl_place", self._parameters["dvl_place"])
        topics = {name: self.text(name) for name in ("imu_topic", "dvl_topic", "depth_topic")}
        return Navigator(node, topics, NavigationSpec(dvl_place=position))

    def detector(self) -> Detector:
        """Make the detector of outlines that may be the box."""
        return ColourDetector()

    def tracker(self, image: Grey, quad: Array) -> Tracker | str:
        """Make a tracker of the top face of the box.

        Args:
            image: the image from which the template is taken, (h, w) [grey level].
            quad: the corners of the top face, (4, 2) [px].

        Returns:
            The tracker, or a text with the reason why the face cannot be tracked.
        """
        method = Method(blend="esm", photometric=True, max_iterations=10, precision=1e-3)
        return DirectTracker.from_image(image, quad, levels=2, method=method)

    def controller(self) -> StationLaw:
        """Make the control law of the station keeping."""
        return StationController(
            kp=self.number("kp"),
            ki=self.number("ki"),
            feeds_forward=self.number("feed_forward") > 0.0,
            limit=self.number("limit"),
        )

    def kinematics(self) -> Kinematics:
        """Make the kinematics of the arm."""
        return Arm5e()

    def box(self) -> BoxSpec:
        """Make the model of the box."""
        return BoxSpec()

    def model(self) -> GraspModel:
        """Make the model of the grasped object."""
        return self.box()

    def perception(self) -> ObjectPerception:
        """Make the perception, which estimates the pose of the object from images."""
        return Perception(self.detector(), self.tracker, self.box())

    def number(self, name: str) -> float:
        """Return a parameter as a number."""
        return float(self._parameters[name])

    def text(self, name: str) -> str:
        """Return a parameter as text."""
        return str(self._parameters[name])

    def start(self, node: Node) -> None:
        """Make the parts, and connect to topics."""
        self._parameters = merge_parameters(self.PARAMETERS, node.parameters)
        self.check_parameters(self._parameters)
        self._node = node
        status = node.publisher("algorithmStatus", String)
        self._publish_phase = node.publisher("phase", String)
        self._publish_twist = node.publisher(self.text("twist_topic"), TwistStamped)
        self._publish_joints = node.publisher(self.text("arm_topic"), JointState)
        self.vehicle = VehicleInterface(self.controller(), self.kinematics())
        self.task = Task(
            self.vehicle,
            self.perception(),
            self.model(),
            self._parameters,
            lambda text: status(String(data=text)),
        )
        mount = parse_triple("camera_rpy", self._parameters["camera_rpy"])
        self._base_from_camera = Pose(
            np.array(parse_triple("camera_place", self._parameters["camera_place"])),
            product(rotation_from_rpy(*mount), OPENGL_FROM_OPENCV),
        )
        self._subscribe(node)
        node.create_timer(PERIOD, self._tick)

    def _subscribe(self, node: Node) -> None:
        self._navigator = self.navigation(node)
        node.subscribe(self.text("joint_topic"), JointState, self.vehicle.on_joints)
        node.subscribe(self.text("wrist_topic"), WrenchStamped, self.vehicle.wrist.on_wrist)
        node.subscribe(self.text("info_topic"), CameraInfo, self._on_info)
        node.subscribe(self.text("image_topic"), Image, self._on_image)

    def _on_info(self, info: CameraInfo) -> None:
        self._info = info

    def _on_image(self, message: Image) -> None:
        phase = self._phase
        if self._info is None or phase is None or not phase.uses_images:
            return
        view = self._view(Pinhole.from_info(self._info))
        self.task.perception.observe(pixels_of(message), view, self.task.target, self._node.now)

    def _view(self, pinhole: Pinhole) -> View:
        """Return the present view, with the depth of the seabed at the target, if there is one."""
        seabed = self._navigator.bottom
        camera = self._navigator.pose @ self._base_from_camera
        if self.task.target.pose is not None:
            position = self.task.target.pose.position
        else:
            view_axis = camera.rotation[:, 2]
            height = seabed.depth_at(camera.position) - float(camera.position[2])
            position = camera.position + view_axis * (height / max(float(view_axis[2]), 0.2))
        return View(
            pinhole=pinhole,
            navigation_from_camera=camera,
            seabed_depth=seabed.depth_at(position),
            slopes=seabed.slopes,
        )

    def _tick(self) -> None:
        """Run the state machine and publish the commands."""
        navigator, vehicle, task = self._navigator, self.vehicle, self.task
        if not navigator.is_ready or not navigator.bottom.is_known:
            return
        vehicle.pose, vehicle.velocity = navigator.pose, navigator.velocity
        task.now = now = self._node.now
        if self._phase is None:
            self._start_search(now)
        assert self._phase is not None
        next_phase = self._phase.step(task)
        if next_phase is None and task.phase_time > self._phase.limit:
            next_phase = self._phase.timeout_phase
            timeout = f"{self._phase.name} took longer than {self._phase.limit:g} s"
            task.failure = task.failure or timeout
        if next_phase is not None:
            self._enter_phase(next_phase)
        self._publish_twist(vehicle.twist(now, now - self._last_time))
        self._last_time = now
        if (command := vehicle.joint_command(now)) is not None:
            self._publish_joints(command)

    def _start_search(self, now: float) -> None:
        vehicle, task = self.vehicle, self.task
        vehicle.goal_heading, self._last_time = vehicle.heading, now
        seabed_depth = self._navigator.bottom.depth_at(vehicle.pose.position)
        task.search_depth = seabed_depth - SEARCH_HEIGHT
        task.pattern = square_spiral(
            vehicle.pose.position,
            vehicle.goal_heading,
            self.number("search_spacing"),
            self.number("search_radius"),
        )
        with suppress(UnknownName):
            self._node.call("startBench", Empty())
        self._enter_phase("search")

    def _enter_phase(self, name: str) -> None:
        task = self.task
        self._phase, task.phase_start = self.PHASES[name](), task.now
        self.vehicle.goal_velocity = np.zeros(3)
        self._phase.enter(task)
        text = f"{name}: {task.failure}" if name in ("aborted", "retry") else name
        self._publish_phase(String(data=text))


def parse_triple(name: str, value: float | str) -> tuple[float, float, float]:
    """Parse a parameter of three numbers.

    Raises:
        BadSetting: the parameter is not three finite numbers.
    """
    try:
        x, y, z = (float(word) for word in str(value).replace(",", " ").split())
    except ValueError:
        x = y = z = math.nan
    if not all(map(math.isfinite, (x, y, z))):
        raise BadSetting(
            f"Parameter {name!r} of the algorithm is {value!r}; expected three numbers."
        )
    return x, y, z
