"""Topics in and out of a scene: the elements of ``<rosInterfaces>``.

.. code-block:: xml

    <rosInterfaces>
      <VirtualCameraToROSImage>
        <cameraName>bowtech1</cameraName>
        <imageTopic>/uwsim/camera1</imageTopic> <infoTopic>/uwsim/camera1_info</infoTopic>
        <rate>30</rate>
      </VirtualCameraToROSImage>
    </rosInterfaces>

The bus uses these topics whether or not there is any ROS.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..dialect import NAMESPACE, element


@dataclass(frozen=True, kw_only=True)
class InterfaceSpec:
    """An element of ``<rosInterfaces>``."""


@dataclass(frozen=True, kw_only=True)
class ROSOdomToPATSpec(InterfaceSpec):
    """Moves a vehicle by nav_msgs/Odometry.

    A position or turn that is not all zero puts it there, in L; else it goes on by the twist, in
    its own axes, for the time since the twist before (1 s at most). A pose takes no time from a
    twist.
    """

    topic: str
    """Name of the topic."""
    vehicle_name: str
    """Name of the vehicle."""


@dataclass(frozen=True, kw_only=True)
class PATToROSOdomSpec(InterfaceSpec):
    """Publishes the pose of a vehicle as nav_msgs/Odometry."""

    topic: str
    """Name of the topic."""
    vehicle_name: str
    """Name of the vehicle."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class WorldToROSTFSpec(InterfaceSpec):
    """Publishes the frames of vehicles, sensors and objects."""

    root_name: str
    """Name of the frame of the file."""
    enable_objects: bool = False
    """Whether objects are published too."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class ArmToROSJointStateSpec(InterfaceSpec):
    """Publishes the joints of a vehicle as sensor_msgs/JointState."""

    topic: str
    """Name of the topic."""
    vehicle_name: str
    """Name of the vehicle."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class ROSJointStateToArmSpec(InterfaceSpec):
    """Moves the joints of a vehicle by sensor_msgs/JointState."""

    topic: str
    """Name of the topic."""
    vehicle_name: str
    """Name of the vehicle."""


@dataclass(frozen=True, kw_only=True)
class VirtualCameraToROSImageSpec(InterfaceSpec):
    """Publishes a camera as sensor_msgs/Image and CameraInfo."""

    camera_name: str
    """Name of the camera."""
    image_topic: str
    """Topic of the pictures."""
    info_topic: str
    """Topic of the camera's description."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""
    depth: bool = False
    """Whether depth is published instead of colour (range cameras only)."""


@dataclass(frozen=True, kw_only=True)
class ROSImageToHUDSpec(InterfaceSpec):
    """Shows pictures of a topic in the viewer."""

    width: int = element(minimum=1)
    """Columns of the pictures [px]."""
    height: int = element(minimum=1)
    """Rows of the pictures [px]."""
    posx: int = 0
    """From the left edge of the window [px]."""
    posy: int = 0
    """From the bottom edge of the window [px]."""
    scale: float = 1.0
    """Size on the screen [1]."""
    black_white: bool = False
    """Whether the pictures have one channel."""
    image_topic: str
    """Topic of the pictures."""
    info_topic: str = ""
    """Topic of the camera's description."""


@dataclass(frozen=True, kw_only=True)
class ROSTwistToPATSpec(InterfaceSpec):
    """Moves a vehicle by geometry_msgs/TwistStamped in its own axes.

    It goes on for the time since the message before; nothing is held after more than 1 s.
    """

    topic: str
    """Name of the topic."""
    vehicle_name: str
    """Name of the vehicle."""


@dataclass(frozen=True, kw_only=True)
class RangeSensorToROSRangeSpec(InterfaceSpec):
    """Publishes a range sensor or picker as sensor_msgs/Range."""

    name: str
    """Name of the range sensor or picker."""
    topic: str
    """Name of the topic."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class ROSPoseToPATSpec(InterfaceSpec):
    """Moves a vehicle by geometry_msgs/Pose."""

    topic: str
    """Name of the topic."""
    vehicle_name: str
    """Name of the vehicle."""


@dataclass(frozen=True, kw_only=True)
class ImuToROSImuSpec(InterfaceSpec):
    """Publishes an imu as sensor_msgs/Imu."""

    name: str
    """Name of the imu."""
    topic: str
    """Name of the topic."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class PressureSensorToROSSpec(InterfaceSpec):
    """Publishes a pressure sensor."""

    name: str
    """Name of the pressure sensor."""
    topic: str
    """Name of the topic."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class GPSSensorToROSSpec(InterfaceSpec):
    """Publishes a GPS as sensor_msgs/NavSatFix."""

    name: str
    """Name of the GPS."""
    topic: str
    """Name of the topic."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class DVLSensorToROSSpec(InterfaceSpec):
    """Publishes a DVL."""

    name: str
    """Name of the DVL."""
    topic: str
    """Name of the topic."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class RangeImageSensorToROSImageSpec(InterfaceSpec):
    """Publishes a depth camera as sensor_msgs/Image and CameraInfo."""

    camera_name: str
    """Name of the depth camera."""
    image_topic: str
    """Topic of the pictures."""
    info_topic: str
    """Topic of the camera's description."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class MultibeamSensorToLaserScanSpec(InterfaceSpec):
    """Publishes a multibeam as sensor_msgs/LaserScan."""

    name: str
    """Name of the multibeam."""
    topic: str
    """Name of the topic."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class ProfilingSonarROSSpec(InterfaceSpec):
    """Publishes a profiling sonar as sensor_msgs/LaserScan."""

    name: str
    """Name of the profiling sonar."""
    topic: str
    """Name of the topic."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class ContactSensorToROSSpec(InterfaceSpec):
    """Publishes whether something touches, as std_msgs/Bool."""

    name: str
    """Name of the vehicle or object."""
    topic: str
    """Name of the topic."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class EchoROSSpec(InterfaceSpec):
    """Publishes the text of an echo device as std_msgs/String."""

    name: str
    """Name of the echo device."""
    topic: str
    """Name of the topic."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class SimulatedDeviceROSSpec(InterfaceSpec):
    """An optional wrapper around the interface of a device."""

    echo_ros: EchoROSSpec | None = element("echoROS", default=None)
    """Interface of an echo device."""


@dataclass(frozen=True, kw_only=True)
class ForceSensorROSSpec(InterfaceSpec):
    """Publishes a force sensor as geometry_msgs/WrenchStamped."""

    name: str
    """Name of the force sensor."""
    topic: str
    """Name of the topic."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class ROSPointCloudLoaderSpec(InterfaceSpec):
    """Shows sensor_msgs/PointCloud2 in the scene."""

    topic: str
    """Name of the topic."""
    del_last_pcd: bool = element("delLastPCD", attribute=True, default=True)
    """Whether a cloud replaces the one before."""


@dataclass(frozen=True, kw_only=True)
class RangeCameraToPCLSpec(InterfaceSpec):
    """Publishes a depth camera as sensor_msgs/PointCloud2."""

    camera_name: str
    """Name of the depth camera."""
    topic: str
    """Name of the topic."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class CustomCommsDeviceROSSpec(InterfaceSpec):
    """Publishes the pose of a communication device."""

    name: str
    """Name of the device."""
    topic: str
    """Name of the topic."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class AcousticCommsDeviceROSSpec(InterfaceSpec):
    """Publishes the pose of an acoustic modem."""

    name: str
    """Name of the device."""
    topic: str
    """Name of the topic."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""


@dataclass(frozen=True, kw_only=True)
class ROSThrustersToPATSpec(InterfaceSpec):
    """Commands the thrusters of a simulated vehicle by std_msgs/Float64MultiArray.

    One value from -1 to 1 a thruster, in the order of the vehicle's side file; held until the
    next command of any kind. The autopilot holds nothing meanwhile.
    """

    topic: str = element(namespaced=True)
    """Name of the topic."""
    vehicle_name: str = element(namespaced=True)
    """Name of the vehicle; it has ``u:dynamics``."""


@dataclass(frozen=True, kw_only=True)
class ROSWrenchToPATSpec(InterfaceSpec):
    """Pushes a simulated vehicle with its thrusters by geometry_msgs/WrenchStamped.

    Force and torque at the origin of its base, in its axes, as far as the thrusters reach; held
    until the next command of any kind. The autopilot holds nothing meanwhile.
    """

    topic: str = element(namespaced=True)
    """Name of the topic."""
    vehicle_name: str = element(namespaced=True)
    """Name of the vehicle; it has ``u:dynamics``."""


INTERFACES: dict[str, type[InterfaceSpec]] = {
    "ROSOdomToPAT": ROSOdomToPATSpec,
    "PATToROSOdom": PATToROSOdomSpec,
    "WorldToROSTF": WorldToROSTFSpec,
    "ArmToROSJointState": ArmToROSJointStateSpec,
    "ROSJointStateToArm": ROSJointStateToArmSpec,
    "VirtualCameraToROSImage": VirtualCameraToROSImageSpec,
    "ROSImageToHUD": ROSImageToHUDSpec,
    "ROSTwistToPAT": ROSTwistToPATSpec,
    "RangeSensorToROSRange": RangeSensorToROSRangeSpec,
    "ROSPoseToPAT": ROSPoseToPATSpec,
    "ImuToROSImu": ImuToROSImuSpec,
    "PressureSensorToROS": PressureSensorToROSSpec,
    "GPSSensorToROS": GPSSensorToROSSpec,
    "DVLSensorToROS": DVLSensorToROSSpec,
    "RangeImageSensorToROSImage": RangeImageSensorToROSImageSpec,
    "multibeamSensorToLaserScan": MultibeamSensorToLaserScanSpec,
    "ProfilingSonarROS": ProfilingSonarROSSpec,
    "SimulatedDeviceROS": SimulatedDeviceROSSpec,
    "contactSensorToROS": ContactSensorToROSSpec,
    "echoROS": EchoROSSpec,
    "ForceSensorROS": ForceSensorROSSpec,
    "ROSPointCloudLoader": ROSPointCloudLoaderSpec,
    "RangeCameraToPCL": RangeCameraToPCLSpec,
    "CustomCommsDeviceROS": CustomCommsDeviceROSSpec,
    "AcousticCommsDeviceROS": AcousticCommsDeviceROSSpec,
    f"{{{NAMESPACE}}}ROSThrustersToPAT": ROSThrustersToPATSpec,
    f"{{{NAMESPACE}}}ROSWrenchToPAT": ROSWrenchToPATSpec,
}
"""Element -> spec, in the order of the original grammar; ours last."""
