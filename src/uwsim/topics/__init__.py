"""Topics of a scene: the elements of ``<rosInterfaces>``, one file each.

.. code-block:: xml

    <rosInterfaces>
      <VirtualCameraToROSImage>
        <cameraName>bowtech1</cameraName>
        <imageTopic>/uwsim/camera1</imageTopic> <infoTopic>/uwsim/camera1_info</infoTopic>
        <rate>30</rate>
      </VirtualCameraToROSImage>
    </rosInterfaces>

The bus has these topics with and without ROS. An interface without ``bind`` is read and not
simulated.

=====================  ===========================  =============================================
interface              message                      effect
=====================  ===========================  =============================================
ROSPoseToPAT           geometry_msgs/Pose           the pose of the vehicle in L is set
ROSTwistToPAT          geometry_msgs/TwistStamped   one step of the twist (in the base frame)
ROSOdomToPAT           nav_msgs/Odometry            a pose that is not all zero as ROSPoseToPAT,
                                                    else its twist as ROSTwistToPAT
ROSJointStateToArm     sensor_msgs/JointState       positions, else one step of the velocities
u:ROSCmdVelToPAT       geometry_msgs/Twist          as ROSTwistToPAT: x forward, y left, z up
u:ROSThrustersToPAT    std_msgs/Float64MultiArray   commands of the thrusters, simulated only
u:ROSFinsToPAT         std_msgs/Float64MultiArray   angles of the fins [rad], simulated only
u:ROSWrenchToPAT       geometry_msgs/WrenchStamped  force and torque, simulated only
=====================  ===========================  =============================================

Commands are applied at the start of the next step, in the order of their arrival. Poses and
positions between two velocities do not affect the interval between these, as in the original. A
message never sets the pose of a simulated vehicle (``u:dynamics``): a pose is the setpoint of its
autopilot. A twist, a wrench or thruster commands hold until the next command of any kind, and so do
the commands of its joints' servos.
"""

from __future__ import annotations

from ..schema import NAMESPACE
from .arm_to_ros_joint_state import ArmToROSJointStateSpec
from .comms_device_ros import AcousticCommsDeviceROSSpec, CustomCommsDeviceROSSpec
from .contact_sensor_to_ros import ContactSensorToROSSpec
from .depth_images import RangeCameraToPCLSpec, RangeImageSensorToROSImageSpec
from .interface import InterfaceSpec
from .multibeam_to_point_cloud import MultibeamToPointCloud2Spec
from .pat_to_ros_odom import PATToROSOdomSpec
from .ros_joint_state_to_arm import ROSJointStateToArmSpec
from .ros_odom_to_pat import ROSOdomToPATSpec
from .ros_pose_to_pat import ROSPoseToPATSpec
from .ros_twist_to_pat import ROSCmdVelToPATSpec, ROSTwistToPATSpec
from .segmentation_to_ros import SegmentationToROSSpec
from .sensor_topic import (
    BatteryToROSSpec,
    DVLSensorToROSSpec,
    EchoROSSpec,
    ForceSensorROSSpec,
    GPSSensorToROSSpec,
    ImuToROSImuSpec,
    MotorCurrentsToROSSpec,
    MultibeamSensorToLaserScanSpec,
    PressureSensorToROSSpec,
    ProfilingSonarROSSpec,
    RangeSensorToROSRangeSpec,
    SensorToROSSpec,
)
from .simulated_device_ros import SimulatedDeviceROSSpec
from .sonar_to_ros import SonarToROSSpec
from .thruster_commands import ROSFinsToPATSpec, ROSThrustersToPATSpec, ROSWrenchToPATSpec
from .viewer_topics import ROSImageToHUDSpec, ROSPointCloudLoaderSpec
from .virtual_camera_to_ros_image import VirtualCameraToROSImageSpec
from .world_to_ros_tf import WorldToROSTFSpec

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
    f"{{{NAMESPACE}}}ROSCmdVelToPAT": ROSCmdVelToPATSpec,
    f"{{{NAMESPACE}}}ROSThrustersToPAT": ROSThrustersToPATSpec,
    f"{{{NAMESPACE}}}ROSFinsToPAT": ROSFinsToPATSpec,
    f"{{{NAMESPACE}}}ROSWrenchToPAT": ROSWrenchToPATSpec,
    f"{{{NAMESPACE}}}sonarToROS": SonarToROSSpec,
    f"{{{NAMESPACE}}}multibeamToPointCloud2": MultibeamToPointCloud2Spec,
    f"{{{NAMESPACE}}}segmentationToROS": SegmentationToROSSpec,
    f"{{{NAMESPACE}}}batteryToROS": BatteryToROSSpec,
    f"{{{NAMESPACE}}}motorCurrentsToROS": MotorCurrentsToROSSpec,
    f"{{{NAMESPACE}}}sensorToROS": SensorToROSSpec,
}
"""The specs of the elements, in the order of the original grammar; extensions are last."""


def element_name(interface: InterfaceSpec) -> str:
    """Return the name of the element from which an interface was read, as in the table."""
    return next(name for name, spec in INTERFACES.items() if spec is type(interface))


__all__ = ["INTERFACES", "InterfaceSpec", "element_name"]
