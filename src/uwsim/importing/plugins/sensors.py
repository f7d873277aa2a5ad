r"""The sensors of Gazebo and of UUV Simulator as sensors of this simulator.

Frames differ: Gazebo's camera looks along x with z up, this simulator's along -z with y up; the
beams of Gazebo's DVL are around -z, here around z. The mounts are turned accordingly, so that the
sensors look in the same direction.

Not imported: distortion, clipping planes, update rates above 1000 Hz, biases in a body frame.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from lxml import etree

from ...base.geometry import Pose, Triple, rotation_x, rpy_from_rotation
from ...schema import MAX_DISTANCE, Diagnostics
from ...sensors.drift import DriftSpec
from ...sensors.dvl_sensor import DvlSensorSpec
from ...sensors.gps_sensor import GpsSensorSpec
from ...sensors.imu import ImuSpec
from ...sensors.pressure_sensor import PressureSensorSpec
from ...sensors.range_sensor import RangeSensorSpec
from ...sensors.sensor import SensorSpec
from ...sensors.sonar.multibeam_sensor import MultibeamSensorSpec
from ...sensors.virtual_camera import VirtualCameraSpec
from ...sensors.virtual_range_image import VirtualRangeImageSpec
from ..robot import NameTable
from ..sdf.flat_model import FlatPlugin
from ..sdf.spec import Sensor
from ..sdf.values import Source, child_of, children_of, number_of, text_of
from .context import PluginContext, check
from .thrusters import triple

SENSOR_FROM_CAMERA = Pose(
    np.zeros(3), np.array([[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
)
"""The axes of a camera of this simulator (x right, y up, -z ahead) in those of Gazebo's camera."""
SENSOR_FROM_DVL = Pose(np.zeros(3), rotation_x(math.pi))
"""The axes of a DVL of this simulator (z along the beams) in those of Gazebo's DVL."""
SENSOR_FROM_FAN = Pose(np.zeros(3), np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]))
"""The axes of a fan of beams of this simulator (angle 0 along -z, then towards y) in those of
Gazebo's scan (angle 0 along x, then towards y)."""
LINK_FROM_UUV_DVL = Pose(
    np.zeros(3), np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
)
"""The axes of a DVL of this simulator in those of the link of UUV Simulator's DVL, x along the
beams."""
MAX_BEAMS = 4096.0
"""The greatest number of beams of a scan."""
DEFAULT_RATE = 10.0
"""The rate of a sensor without ``<update_rate>`` [Hz]."""
MAX_RATE = 1000.0
"""The greatest rate of a sensor [Hz]."""


@dataclass(frozen=True, kw_only=True)
class ImportedSensor:
    """A sensor with its topic."""

    spec: SensorSpec
    """The sensor."""
    topic: str
    """The topic of the file; empty: the name of the sensor."""
    rate: float
    """The rate [Hz]."""


@dataclass(frozen=True, kw_only=True)
class _MountFields:
    """The fields that the specs of all sensors have."""

    name: str
    relative_to: str
    position: Triple
    orientation: Triple


def _mount(name: str, link: str, pose: Pose) -> _MountFields:
    return _MountFields(
        name=name,
        relative_to=link,
        position=triple(pose.position),
        orientation=triple(np.array(rpy_from_rotation(pose.rotation))),
    )


def read_sensors(context: PluginContext) -> list[ImportedSensor]:
    """Return the sensors of a robot, and those of UUV Simulator's plug-ins."""
    names = NameTable()
    sensors: list[ImportedSensor] = []
    for path, link in context.robot.links.items():
        for sensor, link_from_sensor in link.link.sensors:
            pose = context.robot.frame_from_part(path, link_from_sensor)
            sensors += _read_sensor(sensor, link.name, pose, context, names)
    for plugin in context.model.plugins:
        sensors += _read_plugin_sensor(plugin, context, names)
    return sensors


def _read_sensor(
    sensor: Sensor, link: str, pose: Pose, context: PluginContext, names: NameTable
) -> Iterator[ImportedSensor]:
    label = f"sensor {sensor.name} ({sensor.kind})"
    make = SENSOR_KINDS.get(sensor.kind)
    if make is None:
        context.report.add("left out", label, sensor.place,
                           f"sensors of type {sensor.kind!r} are not imported")  # fmt: skip
        return
    source = Source(sensor.place.file, Diagnostics(sensor.place.file), context.report)
    specs, note = make(sensor.node, _PendingMount(sensor.name, link, pose, names), source)
    check(source)
    if not specs:
        context.report.add("left out", label, sensor.place, note)
        return
    rate = number_of(sensor.node, DEFAULT_RATE, source, "update_rate")
    context.report.add("changed" if note else "imported", label, sensor.place, note)
    topic = text_of(sensor.node, "topic")
    yield from _with_topics(specs, topic, rate)


def _with_topics(
    specs: tuple[SensorSpec, ...], topic: str, rate: float
) -> Iterator[ImportedSensor]:
    """Yield the sensors with their topics; the topic of the file belongs to the first."""
    rate = min(rate, MAX_RATE) if rate > 0.0 else DEFAULT_RATE
    for index, spec in enumerate(specs):
        suffix = "_depth" if index and topic else ""
        yield ImportedSensor(spec=spec, topic=topic + suffix, rate=rate)


@dataclass(frozen=True)
class _PendingMount:
    """The mount of a sensor whose name is reserved when the sensor is made."""

    name: str
    link: str
    pose: Pose
    names: NameTable

    def make(self, sensor_from_part: Pose | None = None) -> dict[str, object]:
        """Return the fields of the mount, with the axes of this simulator's sensor."""
        pose = self.pose if sensor_from_part is None else self.pose @ sensor_from_part
        return vars(_mount(self.names.add(self.name or "sensor"), self.link, pose))


SensorSpecs = tuple[tuple[SensorSpec, ...], str]
"""The sensors that an element becomes, none if it has no counterpart, and a remark."""
Maker = Callable[[etree._Element, _PendingMount, Source], SensorSpecs]


def _make_imu(node: etree._Element, mount: _PendingMount, source: Source) -> SensorSpecs:
    imu = child_of(node, "imu")
    rate = max(number_of(node, DEFAULT_RATE, source, "update_rate"), 1e-3)
    gyro = _drift(imu, "angular_velocity", rate, source)
    accelerometer = _drift(imu, "linear_acceleration", rate, source)
    spec = ImuSpec(**mount.make(), gyro=gyro, accelerometer=accelerometer)  # type: ignore[arg-type]
    return (spec,), ""


def _drift(node: etree._Element | None, quantity: str, rate: float, source: Source) -> DriftSpec:
    """Return the white noise and the bias of the x axis: density = std / sqrt(rate)."""
    noise = child_of(node, quantity, "x", "noise")
    std = min(abs(number_of(noise, 0.0, source, "stddev")), 1e3)
    bias = min(abs(number_of(noise, 0.0, source, "bias_stddev")), 1e3)
    return DriftSpec(noise_density=float(f"{std / math.sqrt(rate):.6g}"), turn_on_bias=bias)


def _make_camera(node: etree._Element, mount: _PendingMount, source: Source) -> SensorSpecs:
    camera = child_of(node, "camera")
    width, height, fovy = _image(camera, source)
    std = number_of(camera, 0.0, source, "noise", "stddev")
    spec = VirtualCameraSpec(
        **mount.make(SENSOR_FROM_CAMERA),  # type: ignore[arg-type]
        resw=width,
        resh=height,
        fovy=fovy,
        std=min(max(std, 0.0), 10.0),
        grayscale=text_of(camera, "image", "format").upper().startswith("L"),
    )
    return (spec,), "its distortion is left out" if _is_distorted(camera, source) else ""


def _make_depth_camera(node: etree._Element, mount: _PendingMount, source: Source) -> SensorSpecs:
    width, height, fovy = _image(child_of(node, "camera"), source)
    pose = mount.make(SENSOR_FROM_CAMERA)
    spec = VirtualRangeImageSpec(**pose, resw=width, resh=height, fovy=fovy)  # type: ignore[arg-type]
    return (spec,), ""


def _make_colour_depth_camera(
    node: etree._Element, mount: _PendingMount, source: Source
) -> SensorSpecs:
    colour, note = _make_camera(node, mount, source)
    depth, _ = _make_depth_camera(node, replace(mount, name=f"{mount.name}_depth"), source)
    return (*colour, *depth), note


def _image(camera: etree._Element | None, source: Source) -> tuple[int, int, float]:
    """Return width and height [px], and the vertical field of view [deg]."""
    width = int(min(max(number_of(camera, 320.0, source, "image", "width"), 1.0), 16384.0))
    height = int(min(max(number_of(camera, 240.0, source, "image", "height"), 1.0), 16384.0))
    fov = min(max(number_of(camera, 1.047, source, "horizontal_fov"), 0.01), 3.1)
    fovy = 2.0 * math.atan(math.tan(0.5 * fov) * height / width)
    return width, height, round(math.degrees(fovy), 6)


def _is_distorted(camera: etree._Element | None, source: Source) -> bool:
    names = ("k1", "k2", "k3", "p1", "p2")
    return any(number_of(camera, 0.0, source, "distortion", name) for name in names)


def _make_pressure(node: etree._Element, mount: _PendingMount, source: Source) -> SensorSpecs:
    std = number_of(node, 0.0, source, "air_pressure", "pressure", "noise", "stddev")
    spec = PressureSensorSpec(**mount.make(), std=abs(std), measures="pressure")  # type: ignore[arg-type]
    return (spec,), "absolute pressure, under water, too"


def _make_altimeter(node: etree._Element, mount: _PendingMount, source: Source) -> SensorSpecs:
    std = number_of(node, 0.0, source, "altimeter", "vertical_position", "noise", "stddev")
    spec = PressureSensorSpec(**mount.make(), std=abs(std))  # type: ignore[arg-type]
    return (spec,), "the depth below the surface, instead of the height above the start"


def _make_gps(node: etree._Element, mount: _PendingMount, source: Source) -> SensorSpecs:
    noise = (
        child_of(node, "navsat") if child_of(node, "navsat") is not None else child_of(node, "gps")
    )
    std = number_of(noise, 0.0, source, "position_sensing", "horizontal", "noise", "stddev")
    spec = GpsSensorSpec(**mount.make(), std=min(abs(std), 1000.0))  # type: ignore[arg-type]
    return (spec,), "it has no position under water"


def _make_range(node: etree._Element, mount: _PendingMount, source: Source) -> SensorSpecs:
    scans = (child_of(node, name) for name in ("lidar", "ray", "sonar"))
    scan = next((child for child in scans if child is not None), None)
    n_beams = number_of(scan, 1.0, source, "scan", "horizontal", "samples")
    if number_of(scan, 1.0, source, "scan", "vertical", "samples") > 1.0:
        return (), "scans of several rows are not imported"
    reach = min(max(number_of(scan, 10.0, source, "range", "max"), 1e-3), MAX_DISTANCE)
    std = min(abs(number_of(scan, 0.0, source, "noise", "stddev")), 1000.0)
    if n_beams <= 1.0:
        range_sensor = RangeSensorSpec(**mount.make(), range=reach, std=std)  # type: ignore[arg-type]
        return (range_sensor,), ""
    ends = [
        math.degrees(number_of(scan, default, source, "scan", "horizontal", name))
        for name, default in (("min_angle", 0.0), ("max_angle", 0.0))
    ]
    if not 0.0 < ends[1] - ends[0] <= 360.0 or n_beams > MAX_BEAMS:
        return (), f"it has {n_beams:g} beams from {ends[0]:.6g} to {ends[1]:.6g} degrees"
    spec = MultibeamSensorSpec(
        **mount.make(SENSOR_FROM_FAN),  # type: ignore[arg-type]
        init_angle=round(ends[0], 6),
        final_angle=round(ends[1], 6),
        angle_incr=round((ends[1] - ends[0]) / (n_beams - 1.0), 9),
        range=reach,
        std=std,
    )
    return (spec,), ""


def _make_dvl(node: etree._Element, mount: _PendingMount, source: Source) -> SensorSpecs:
    dvl = child_of(node, "dvl")
    beams = child_of(dvl, "arrangement")
    tilts, apertures = [], 0
    for beam in [] if beams is None else children_of(beams, "beam"):
        tilt = number_of(beam, 0.0, source, "tilt")
        is_degrees = (beams is not None) and (beams.get("degrees") or "") in ("true", "1")
        tilts.append(tilt if is_degrees else math.degrees(tilt))
        apertures += 1
    note = ""
    angle = tilts[0] if tilts else 30.0
    if len(set(tilts)) > 1 or apertures not in (0, 4) or not 0.0 < angle <= 60.0:
        note = "four beams of the same angle"
        angle = angle if 0.0 < angle <= 60.0 else 30.0
    cosine = math.cos(math.radians(angle))
    far = number_of(dvl, 81.0 / cosine, source, "maximum_range") * cosine
    near = number_of(dvl, 0.0, source, "minimum_range") * cosine
    std = number_of(dvl, 0.0, source, "tracking", "bottom_mode", "noise", "stddev")
    spec = DvlSensorSpec(
        **mount.make(SENSOR_FROM_DVL),  # type: ignore[arg-type]
        beam_angle=angle,
        min_altitude=round(max(near, 0.0), 6),
        max_altitude=round(min(max(far, 1e-3), 1e5), 6),
        std=min(abs(std), 10.0),
    )
    return (spec,), note


SENSOR_KINDS: dict[str, Maker] = {
    "imu": _make_imu,
    "camera": _make_camera,
    "wideanglecamera": _make_camera,
    "depth": _make_depth_camera,
    "depth_camera": _make_depth_camera,
    "rgbd": _make_colour_depth_camera,
    "rgbd_camera": _make_colour_depth_camera,
    "air_pressure": _make_pressure,
    "altimeter": _make_altimeter,
    "gps": _make_gps,
    "navsat": _make_gps,
    "ray": _make_range,
    "gpu_ray": _make_range,
    "lidar": _make_range,
    "gpu_lidar": _make_range,
    "sonar": _make_range,
    "dvl": _make_dvl,
}
"""The sensors by their type in SDF."""


def _read_plugin_sensor(
    plugin: FlatPlugin, context: PluginContext, names: NameTable
) -> Iterator[ImportedSensor]:
    """Yield the sensor of a plug-in of UUV Simulator."""
    make = PLUGIN_KINDS.get(plugin.plugin.kind)
    if make is None:
        return
    node, source = plugin.plugin.node, context.source(plugin)
    name = text_of(node, "link_name") or text_of(node, "frame_id")
    path = context.find_link(name, plugin) if name else context.robot.root
    if path is None:
        return
    base = plugin.plugin.kind.removeprefix("uuv_gazebo_ros_").removesuffix("_plugin")
    pose = context.robot.frame_from_part(path, Pose.identity())
    mount = _PendingMount(base, context.robot.links[path].name, pose, names)
    specs, note = make(node, mount, source)
    check(source)
    context.add("changed" if note else "imported", plugin, note)
    rate = number_of(node, DEFAULT_RATE, source, "update_rate")
    topic = text_of(node, "sensor_topic") or text_of(node, "topic")
    yield from _with_topics(specs, topic, rate)


def _make_uuv_dvl(node: etree._Element, mount: _PendingMount, source: Source) -> SensorSpecs:
    std = min(abs(number_of(node, 0.0, source, "noise_sigma")), 10.0)
    spec = DvlSensorSpec(**mount.make(LINK_FROM_UUV_DVL), std=std)  # type: ignore[arg-type]
    return (spec,), "along x of its link; the geometry of the beams is that of this simulator"


def _make_uuv_pressure(node: etree._Element, mount: _PendingMount, source: Source) -> SensorSpecs:
    kilopascal = abs(number_of(node, 0.0, source, "noise_sigma"))
    spec = PressureSensorSpec(
        **mount.make(),  # type: ignore[arg-type]
        std=1000.0 * kilopascal,
        measures="pressure",
    )
    return (spec,), "in Pa instead of kPa"


def _make_uuv_imu(node: etree._Element, mount: _PendingMount, source: Source) -> SensorSpecs:
    def density(*names: str) -> float:
        values = (number_of(node, 0.0, source, name) for name in names)
        return min(max((abs(value) for value in values), default=0.0), 1e3)

    gyro = DriftSpec(noise_density=density("gyroscopeNoiseDensity", "gyroscope_noise_density"))
    accelerometer = DriftSpec(
        noise_density=density("accelerometerNoiseDensity", "accelerometer_noise_density")
    )
    spec = ImuSpec(**mount.make(), gyro=gyro, accelerometer=accelerometer)  # type: ignore[arg-type]
    return (spec,), ""


def _make_uuv_gps(node: etree._Element, mount: _PendingMount, source: Source) -> SensorSpecs:
    spec = GpsSensorSpec(**mount.make())  # type: ignore[arg-type]
    return (spec,), "it has no position under water"


PLUGIN_KINDS: dict[str, Maker] = {
    "uuv_gazebo_ros_dvl_plugin": _make_uuv_dvl,
    "uuv_gazebo_ros_subsea_pressure_plugin": _make_uuv_pressure,
    "uuv_gazebo_ros_imu_plugin": _make_uuv_imu,
    "uuv_gazebo_ros_gps_plugin": _make_uuv_gps,
    "sea_pressure_sensor": _make_uuv_pressure,
}
"""The sensors by the file of their plug-in."""
