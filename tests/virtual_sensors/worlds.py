"""A scene with a camera, and the log of a vehicle that moves in it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from tests.simulation.small_robots import shape, write_robot
from uwsim.logs import MotionSeries, VehicleLog
from uwsim.scene.object import ObjectSpec
from uwsim.scene.ocean_state import FogSpec, OceanStateSpec
from uwsim.scene.sim_params import SimParamsSpec
from uwsim.scene.spec import SceneSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.sensors.virtual_camera import VirtualCameraSpec
from uwsim.topics import VirtualCameraToROSImageSpec

WIDTH, HEIGHT, FOVY = 160, 120, 60.0
WALL = ObjectSpec(
    name="wall", file="objects/box.osg", position=(6.0, 0.0, -2.0), scale_factor=(0.5, 9.0, 9.0)
)
BALL = ObjectSpec(name="ball", file="objects/sphere.osg", position=(3.0, 0.4, -2.2))
POST = ObjectSpec(
    name="post", file="objects/box.osg", position=(2.0, 0.25, -2.0), scale_factor=(0.1, 0.1, 6.0)
)
"""A wall behind a ball, and a post before it; L is W, the camera looks along x."""


def camera_scene(
    folder: Path, *objects: ObjectSpec, fog: float = 0.0, std: float = 0.0
) -> SceneSpec:
    """A vehicle with a forward camera at the depth of 2 m, in clear water or in fog."""
    robot = write_robot(folder, f'<link name="base_link">{shape(size=(0.1, 0.1, 0.1))}</link>')
    camera = VirtualCameraSpec(
        name="eye", relative_to="base_link", resw=WIDTH, resh=HEIGHT, fovy=FOVY, std=std,
        position=(0.1, 0.0, 0.0), look_at="forward",
    )  # fmt: skip
    vehicle = VehicleSpec(name="rov", file=str(robot), position=(0.0, 0.0, -2.0), parts=(camera,))
    interface = VirtualCameraToROSImageSpec(
        camera_name="eye", image_topic="/rov/image", info_topic="/rov/info", rate=10.0
    )
    ocean = OceanStateSpec(fog=FogSpec(density=fog, color=(0.1, 0.35, 0.5)))
    return SceneSpec(
        vehicles=(vehicle,),
        objects=objects,
        ocean_state=ocean,
        sim_params=SimParamsSpec(),
        ros_interfaces=(interface,),
    )


def with_fog(scene: SceneSpec, fog: float) -> SceneSpec:
    ocean = replace(scene.ocean_state, fog=replace(scene.ocean_state.fog, density=fog))
    return replace(scene, ocean_state=ocean)


def moving_log(times: np.ndarray, positions: np.ndarray, yaws: np.ndarray) -> VehicleLog:
    """The log of a vehicle with positions (n, 3) [m] and headings (n,) [rad]."""
    zeros = np.zeros(len(times))
    quaternions = np.column_stack([np.cos(yaws / 2), zeros, zeros, np.sin(yaws / 2)])
    motion = MotionSeries(times=times, positions=positions, quaternions=quaternions)
    return VehicleLog(path="dive.csv", format="csv", sha256="", vehicle="rov", motion=motion)
