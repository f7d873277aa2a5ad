"""Interfaces of a scene: the elements of ``<rosInterfaces>``, which publish or subscribe to topics.

.. code-block:: xml

    <rosInterfaces>
      <VirtualCameraToROSImage>
        <cameraName>bowtech1</cameraName>
        <imageTopic>/uwsim/camera1</imageTopic> <infoTopic>/uwsim/camera1_info</infoTopic>
        <rate>30</rate>
      </VirtualCameraToROSImage>
    </rosInterfaces>

The topics are on the bus of the process, with and without ROS. An interface whose spec has no
``bind`` is read but has no effect. L is the localized world: the frame of the scene file, which the
scene's offset relates to the world frame W. The original is UWSim (C++).

=====================  ===========================  =============================================
interface              message                      effect on a vehicle without ``u:dynamics``
=====================  ===========================  =============================================
ROSPoseToPAT           geometry_msgs/Pose           its pose in L is set
ROSTwistToPAT          geometry_msgs/TwistStamped   it moves by the twist, in its base frame
ROSOdomToPAT           nav_msgs/Odometry            as ROSPoseToPAT, or as ROSTwistToPAT if
                                                    position and orientation are all zero
ROSJointStateToArm     sensor_msgs/JointState       positions are set, or joints move by velocities
u:ROSCmdVelToPAT       geometry_msgs/Twist          as ROSTwistToPAT, with x forward, y left, z up
=====================  ===========================  =============================================

=====================  ===========================  =============================================
interface              message                      effect on a vehicle with ``u:dynamics``
=====================  ===========================  =============================================
the five above                                      a setpoint of its autopilot or servos
u:ROSThrustersToPAT    std_msgs/Float64MultiArray   one command from -1 to 1 for each thruster
u:ROSFinsToPAT         std_msgs/Float64MultiArray   one angle for each fin [rad]
u:ROSWrenchToPAT       geometry_msgs/WrenchStamped  force and torque of all thrusters together
=====================  ===========================  =============================================

Commands are applied at the start of the next step, in the order of their arrival. A vehicle without
``u:dynamics`` moves for the interval since its previous velocity command; commands of poses and
positions in between do not affect this interval, as in the original. A vehicle with ``u:dynamics``
holds a twist, a wrench or thruster commands until the next command of any kind; the servos of its
joints hold theirs likewise.
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
from .tethers import ROSToWinchSpec, TetherToROSSpec
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
    f"{{{NAMESPACE}}}tetherToROS": TetherToROSSpec,
    f"{{{NAMESPACE}}}ROSToWinch": ROSToWinchSpec,
}
"""The specs of the elements, in the order of the original grammar; extensions are last."""


def element_name(interface: InterfaceSpec) -> str:
    """Return the name of the element from which an interface was read, as in the table."""
    return next(name for name, spec in INTERFACES.items() if spec is type(interface))


__all__ = ["INTERFACES", "InterfaceSpec", "element_name"]
