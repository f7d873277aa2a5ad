"""The scene of a scenario: the base scene, whose vehicle repeats the mission."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from ..devices.motion.scripted_motion import ScriptedMotionSpec
from ..errors import BadSetting, UnknownName
from ..scene.ocean_state import OceanStateSpec
from ..scene.physical_water import PhysicalWaterSpec
from ..scene.reader import read_scene
from ..scene.spec import SceneSpec
from ..sensors.virtual_camera import VirtualCameraSpec
from ..topics.virtual_camera_to_ros_image import VirtualCameraToROSImageSpec
from ..virtual_sensors import replace_motion
from .request import ScenarioRequest

TRAJECTORY_FILE = "trajectory.csv"
"""The name of the file with the poses of the vehicle."""
PRELUDE = 2.0
"""The duration of the prelude of a level, in which the vehicle waits at its first pose [s]."""
IMAGE_TOPIC, INFO_TOPIC = "/uwsim/camera1", "/uwsim/camera1_info"
"""The topics on which trackers read images."""
IMAGE_RATE = 30.0
"""The rate of rendered images, if the base scene does not publish the camera [Hz]."""


@dataclass(frozen=True, kw_only=True)
class SceneFiles:
    """The scene of a scenario for each kind of images."""

    recorded_scene: SceneSpec
    """The scene beside recorded images, whose camera publishes nothing."""
    rendered_scene: SceneSpec
    """The scene whose camera publishes what it renders."""


def choose_camera(scene: SceneSpec, vehicle: str, name: str | None) -> str:
    """Return the camera of a vehicle; raise UnknownName or BadSetting if there is no such one."""
    spec = next(item for item in scene.vehicles if item.name == vehicle)
    names = [camera.name for camera in spec.parts_of(VirtualCameraSpec)]
    if name is not None:
        if name not in names:
            raise UnknownName(f"virtual camera of {vehicle}", name, names)
        return name
    if len(names) != 1:
        raise BadSetting(
            f"{vehicle} has {len(names)} virtual cameras ({', '.join(names) or 'none'}); --camera "
            "chooses the one at the place of the real camera."
        )
    return names[0]


def find_noise(scene: SceneSpec, vehicle: str, camera: str) -> float:
    """Return the noise of a camera, as a fraction of white [1]; 0 for one with a response."""
    spec = next(item for item in scene.vehicles if item.name == vehicle)
    view = next(part for part in spec.parts_of(VirtualCameraSpec) if part.name == camera)
    return min(view.std, 1.0) if view.response is None else 0.0


def make_scenes(
    scene: SceneSpec, vehicle: str, camera: str | None, request: ScenarioRequest
) -> SceneFiles:
    """Return the scenes of a scenario.

    Args:
        scene: the base scene with its drawn variations.
        vehicle: the vehicle that repeats the mission.
        camera: the camera whose images are scored; None: none are.
        request: the request.
    """
    motion = ScriptedMotionSpec(
        file=TRAJECTORY_FILE, start=-PRELUDE, max_gap=request.max_gap, gaps=request.gaps
    )
    moving_scene = replace(replace_motion(scene, vehicle, motion), vary=())
    if camera is None:
        return SceneFiles(recorded_scene=moving_scene, rendered_scene=moving_scene)
    camera_interfaces = [
        spec
        for spec in scene.ros_interfaces
        if isinstance(spec, VirtualCameraToROSImageSpec)
        and spec.camera_name == camera
        and not spec.depth
    ]
    other_interfaces = tuple(s for s in scene.ros_interfaces if s not in camera_interfaces)
    interface = VirtualCameraToROSImageSpec(
        camera_name=camera,
        image_topic=IMAGE_TOPIC,
        info_topic=INFO_TOPIC,
        rate=camera_interfaces[0].rate if camera_interfaces else IMAGE_RATE,
    )
    return SceneFiles(
        recorded_scene=replace(moving_scene, ros_interfaces=other_interfaces),
        rendered_scene=replace(moving_scene, ros_interfaces=(*other_interfaces, interface)),
    )


def replace_water(scene: SceneSpec, water: Path) -> SceneSpec:
    """Return a scene with the water of a water file (JSON), or that of another scene (XML).

    Raises:
        BadSetting: the file is neither, or the other scene has no physical water.
    """
    ocean = scene.ocean_state
    if water.suffix.lower() == ".json":
        base = ocean.water or PhysicalWaterSpec(law="physical")
        new_water = replace(
            base,
            type="",
            file=water.name,
            spectrum=None,
            absorption=None,
            beam_attenuation=None,
            scattering=None,
            phase_function=(),
        )
        return replace(scene, ocean_state=replace(ocean, water=new_water))
    if water.suffix.lower() != ".xml":
        raise BadSetting(f"{water}: expected a water file (.json) or a scene (.xml).")
    other_ocean: OceanStateSpec = read_scene(water).ocean_state
    return replace(
        scene,
        ocean_state=replace(
            ocean,
            water=other_ocean.water,
            fog=other_ocean.fog,
            color=other_ocean.color,
            attenuation=other_ocean.attenuation,
        ),
    )
