#!/usr/bin/python3
"""Move a vehicle with a marker in RViz, as UWSim's followMarker.

    follow_marker.py TOPIC [x y z roll pitch yaw [markerScale controlScale [xRot yRot zRot]]]

It is the server of the interactive marker `uwsim_marker` in the frame `world`; the marker's pose,
added to the start pose (x y z roll pitch yaw), is sent to TOPIC as nav_msgs/Odometry. It does
not need the package interactive_markers; the protocol has three topics.
With `uwsim run cirs --ros1`:  follow_marker.py /dataNavigator 0 0 2 0 0 0
"""

import contextlib
import math
import sys

import poses
import rospy
from arguments import parse_numbers
from nav_msgs.msg import Odometry
from visualization_msgs.msg import (
    InteractiveMarker,
    InteractiveMarkerControl,
    InteractiveMarkerFeedback,
    InteractiveMarkerInit,
    InteractiveMarkerPose,
    InteractiveMarkerUpdate,
    Marker,
)

NAME, FRAME = "uwsim_marker", "world"
DEFAULTS = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 0.0, 0.0, 0.0)
HALF = math.sqrt(0.5)
AXES = {"x": (HALF, 0, 0, HALF), "y": (0, 0, HALF, HALF), "z": (0, HALF, 0, HALF)}
"""The orientation of the control of each axis, as RViz expects it."""


def make_marker(size: float, scale: float, box_orientation: tuple) -> InteractiveMarker:
    """Return a box with handles for six degrees of freedom."""
    interactive_marker = InteractiveMarker(name=NAME, description="vehicle", scale=scale)
    interactive_marker.header.frame_id = FRAME
    interactive_marker.pose.orientation.w = 1.0
    box = Marker(type=Marker.CUBE)
    box.scale.x = box.scale.y = box.scale.z = size
    box.color.r = box.color.g = box.color.b = box.color.a = 0.5
    poses.write(box.pose, (0.0, 0.0, 0.0), box_orientation)
    interactive_marker.controls.append(InteractiveMarkerControl(always_visible=True, markers=[box]))
    for axis, orientation in AXES.items():
        for name, mode in (
            ("move", InteractiveMarkerControl.MOVE_AXIS),
            ("rotate", InteractiveMarkerControl.ROTATE_AXIS),
        ):
            control = InteractiveMarkerControl(name=f"{name}_{axis}", interaction_mode=mode)
            o = control.orientation
            o.x, o.y, o.z, o.w = orientation
            interactive_marker.controls.append(control)
    return interactive_marker


class Server:
    """A server of the marker, which commands the vehicle to its pose."""

    def __init__(self, topic: str, numbers: list) -> None:
        x, y, z, *angles, size, scale, x_turn, y_turn, z_turn = numbers
        self._start = (x, y, z), poses.quaternion(*angles)
        self._marker = make_marker(size, scale, poses.quaternion(x_turn, y_turn, z_turn))
        self._sequence_number = 1
        self._command_publisher = rospy.Publisher(topic, Odometry, queue_size=1)
        self._marker_publisher = rospy.Publisher(
            f"{NAME}/update_full", InteractiveMarkerInit, queue_size=1, latch=True
        )
        self._update_publisher = rospy.Publisher(
            f"{NAME}/update", InteractiveMarkerUpdate, queue_size=10
        )
        self._publish_marker()
        rospy.Subscriber(f"{NAME}/feedback", InteractiveMarkerFeedback, self._on_feedback)
        rospy.Timer(
            rospy.Duration(0.5), lambda _: self._publish_update(InteractiveMarkerUpdate.KEEP_ALIVE)
        )

    def _publish_marker(self) -> None:
        self._marker_publisher.publish(
            InteractiveMarkerInit(
                server_id=NAME, seq_num=self._sequence_number, markers=[self._marker]
            )
        )

    def _publish_update(self, kind: int, **changes: list) -> None:
        message = InteractiveMarkerUpdate(
            server_id=NAME, seq_num=self._sequence_number, type=kind, **changes
        )
        self._update_publisher.publish(message)

    def _on_feedback(self, feedback: InteractiveMarkerFeedback) -> None:
        if feedback.event_type != InteractiveMarkerFeedback.POSE_UPDATE:
            return
        self._marker.pose = feedback.pose
        self._sequence_number += 1
        self._publish_marker()
        marker_pose = InteractiveMarkerPose(pose=feedback.pose, name=NAME)
        marker_pose.header.frame_id = FRAME
        self._publish_update(InteractiveMarkerUpdate.UPDATE, poses=[marker_pose])
        start, attitude = self._start
        offset, rotation = poses.read(feedback.pose)
        command = Odometry()
        command.header.stamp = rospy.Time.now()
        position = [p + d for p, d in zip(start, offset, strict=True)]
        poses.write(command.pose.pose, position, poses.multiply(attitude, rotation))
        self._command_publisher.publish(command)


def main() -> None:
    topic, *words = rospy.myargv()[1:] or [""]
    if not topic or len(words) not in (0, 6, 8, 11):
        sys.exit(__doc__)
    pose = parse_numbers(words, __doc__)
    rospy.init_node("follow_marker", anonymous=True)
    Server(topic, [*pose, *DEFAULTS[len(pose) :]])
    rospy.spin()


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        main()
