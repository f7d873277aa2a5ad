"""Every element of ``<rosInterfaces>`` on the bus: message type, direction and rate."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.opened import open_scene
from uwsim.checks import check_file
from uwsim.middleware.recording import TopicRate, TopicRates
from uwsim.scene.reader import read_scene
from uwsim.schema.names import prefixed_name
from uwsim.topics import INTERFACES

SENSOR = "<name>{0}</name> <relativeTo>base_link</relativeTo>"
DEVICE = (
    "<dccommsId>{0}</dccommsId> {1} <relativeTo>base_link</relativeTo> <mac>{2}</mac> {3} "
    "<txPacketBuilder> <className>x</className> </txPacketBuilder>"
    "<rxPacketBuilder> <className>x</className> </rxPacketBuilder>"
)
PARTS = f"""
    <virtualCamera> {SENSOR.format("camera")} <resw>16</resw> <resh>12</resh> </virtualCamera>
    <rangeSensor> {SENSOR.format("sonar")} <range>10</range> </rangeSensor>
    <imu> {SENSOR.format("imu")} </imu>
    <pressureSensor> {SENSOR.format("pressure")} </pressureSensor>
    <gpsSensor> {SENSOR.format("gps")} </gpsSensor>
    <dvlSensor> {SENSOR.format("dvl")} </dvlSensor>
    <virtualRangeImage> {SENSOR.format("depth")} <resw>16</resw> <resh>12</resh>
    </virtualRangeImage>
    <multibeamSensor> {SENSOR.format("multibeam")} <initAngle>-10</initAngle>
      <finalAngle>10</finalAngle> <angleIncr>5</angleIncr> <range>10</range> </multibeamSensor>
    <ProfilingSonar> {SENSOR.format("profiler")} <initAngle>-10</initAngle>
      <finalAngle>10</finalAngle> <angleIncr>5</angleIncr> <range>10</range> <fov>2</fov>
    </ProfilingSonar>
    <simulatedDevices> <echo> <name>echo</name> <info>hello</info> </echo> </simulatedDevices>
    <ForceSensor> <name>force</name> <target>base_link</target>
      <offsetp> <x>0</x> <y>0</y> <z>0</z> </offsetp>
      <offsetr> <x>0</x> <y>0</y> <z>0</z> </offsetr>
    </ForceSensor>
"""
NAMED = "<vehicleName>rov</vehicleName>"
IMAGES = "<imageTopic>/t/{0}</imageTopic> <infoTopic>/t/{0}_info</infoTopic>"
IMAGE, INFO = "sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo"
SCAN = "sensor_msgs/msg/LaserScan"

TABLE: dict[str, tuple[str, dict[str, str], float | None]] = {
    "ROSOdomToPAT": (NAMED, {"": "nav_msgs/msg/Odometry"}, None),
    "PATToROSOdom": (NAMED, {"": "nav_msgs/msg/Odometry"}, 20),
    "WorldToROSTF": (
        "<rootName>world</rootName> <enableObjects>1</enableObjects>",
        {"/tf": "tf2_msgs/msg/TFMessage"},
        20,
    ),
    "ArmToROSJointState": (NAMED, {"": "sensor_msgs/msg/JointState"}, 20),
    "ROSJointStateToArm": (NAMED, {"": "sensor_msgs/msg/JointState"}, None),
    "VirtualCameraToROSImage": ("<cameraName>camera</cameraName>", {"": IMAGE, "_info": INFO}, 20),
    "ROSImageToHUD": ("<width>16</width> <height>12</height>", {"": IMAGE}, None),
    "ROSTwistToPAT": (NAMED, {"": "geometry_msgs/msg/TwistStamped"}, None),
    "RangeSensorToROSRange": ("<name>sonar</name>", {"": "sensor_msgs/msg/Range"}, 20),
    "ROSPoseToPAT": (NAMED, {"": "geometry_msgs/msg/Pose"}, None),
    "ImuToROSImu": ("<name>imu</name>", {"": "sensor_msgs/msg/Imu"}, 20),
    "PressureSensorToROS": (
        "<name>pressure</name>",
        {"": "underwater_sensor_msgs/msg/Pressure"},
        20,
    ),
    "GPSSensorToROS": ("<name>gps</name>", {"": "sensor_msgs/msg/NavSatFix"}, 20),
    "DVLSensorToROS": ("<name>dvl</name>", {"": "underwater_sensor_msgs/msg/DVL"}, 20),
    "RangeImageSensorToROSImage": (
        "<cameraName>depth</cameraName>",
        {"": IMAGE, "_info": INFO},
        20,
    ),
    "multibeamSensorToLaserScan": ("<name>multibeam</name>", {"": SCAN}, 20),
    "ProfilingSonarROS": ("<name>profiler</name>", {"": SCAN}, 20),
    "SimulatedDeviceROS": ("", {"": "std_msgs/msg/String"}, 20),
    "contactSensorToROS": ("<name>rov</name>", {"": "std_msgs/msg/Bool"}, 20),
    "echoROS": ("<name>echo</name>", {"": "std_msgs/msg/String"}, 20),
    "ForceSensorROS": ("<name>force</name>", {"": "geometry_msgs/msg/WrenchStamped"}, 20),
    "ROSPointCloudLoader": ("", {"": "sensor_msgs/msg/PointCloud2"}, None),
    "RangeCameraToPCL": ("<cameraName>depth</cameraName>", {"": "sensor_msgs/msg/PointCloud2"}, 20),
    "CustomCommsDeviceROS": ("<name>custom</name>", {"": "geometry_msgs/msg/Pose"}, 20),
    "AcousticCommsDeviceROS": ("<name>modem</name>", {"": "geometry_msgs/msg/Pose"}, 20),
}
"""Element -> what it has besides topic and rate; suffix of its topic -> type; rate [Hz]."""
BY_IMAGE_TOPIC = ("VirtualCameraToROSImage", "ROSImageToHUD", "RangeImageSensorToROSImage")


def interface(element: str) -> str:
    content, _, rate = TABLE[element]
    topics = IMAGES.format(element) if element in BY_IMAGE_TOPIC else f"<topic>/t/{element}</topic>"
    topics = "" if element == "WorldToROSTF" else topics
    body = f"{content} {topics} {'' if rate is None else f'<rate>{rate}</rate>'}"
    if element == "SimulatedDeviceROS":
        body = f"<echoROS> <name>echo</name> {body} </echoROS>"
    return f"<{element}> {body} </{element}>"


COMMS = DEVICE.format(
    "custom",
    "<txChannelId>0</txChannelId> <rxChannelId>0</rxChannelId>",
    1,
    "<bitrate>100</bitrate>",
)
MODEM = DEVICE.format(
    "modem", "<channelId>0</channelId>", 2, "<symbolsPerSecond>100</symbolsPerSecond>"
)
SCENE = f"""<UWSimScene>
  <CustomCommsChannel> <id>0</id> </CustomCommsChannel>
  <AcousticCommsChannel> <id>0</id> </AcousticCommsChannel>
  <vehicle>
    <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>-2</z> </position>
    {PARTS}
    <CustomCommsDevice> {COMMS} </CustomCommsDevice>
    <AcousticCommsDevice> {MODEM} </AcousticCommsDevice>
  </vehicle>
  <rosInterfaces>
    {chr(10).join(map(interface, TABLE))}
  </rosInterfaces>
</UWSimScene>
"""


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("scene") / "scene.xml"
    path.write_text(SCENE)
    return path


@pytest.fixture(scope="module")
def rates(scene: Path) -> dict[str, TopicRate]:
    """What came on every topic in half a second."""
    with open_scene(read_scene(scene), is_blind=True) as simulation:
        counted = TopicRates(simulation.bus, lambda: simulation.time)
        simulation.advance(0.5)
        return {each.topic: each for each in counted.rates()}


def test_the_table_has_every_element_of_the_original() -> None:
    assert set(TABLE) == {name for name in INTERFACES if not name.startswith("{")}
    assert len(TABLE) == 25  # the 24 of its grammar, and ProfilingSonarROS


@pytest.mark.parametrize("element", TABLE)
def test_type_direction_and_rate(element: str, rates: dict[str, TopicRate]) -> None:
    _, types, rate = TABLE[element]
    if not INTERFACES[element].is_simulated():
        pytest.skip(f"{element} is read but not simulated yet")
    for suffix, message_type in types.items():
        found = rates["/tf" if suffix == "/tf" else f"/t/{element}{suffix}"]
        assert found.message_type == message_type
        assert found.is_published is (rate is not None)
        n_samples = 0 if rate is None else 11
        if element == "WorldToROSTF":  # both communication devices publish frames, too
            assert found.n_messages == 3 * n_samples
            return
        assert found.n_messages == n_samples
        assert found.rate == (None if rate is None else pytest.approx(rate))


def test_check_reports_none_of_those_that_are_simulated(scene: Path) -> None:
    warnings = [each.message for each in check_file(scene) if "not simulated" in each.message]
    simulated = {prefixed_name(name) for name, spec in INTERFACES.items() if spec.is_simulated()}
    assert {"ROSImageToHUD", "ROSPointCloudLoader"} <= simulated
    assert [name for name in simulated for text in warnings if f": {name} (" in text] == []
