#!/usr/bin/python3
"""Lead a vehicle by a marker in RViz, as the original's followMarker.

    follow_marker.py TOPIC [x y z roll pitch yaw [markerScale controlScale [xRot yRot zRot]]]

It is the server of the interactive marker `uwsim_marker` in the frame `world`; the marker's pose,
added to the start pose (x y z roll pitch yaw), is sent to TOPIC as nav_msgs/Odometry. It needs no
package interactive_markers: that protocol is three topics.
With `uwsim run cirs --ros1`:  follow_marker.py /dataNavigator 0 0 2 0 0 0
"""

import contextlib
import math
import sys

import poses
import rospy
from arguments import numbers
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
"""Orientation of the control of each axis, as RViz wants it."""


def marker(size: float, scale: float, turned: tuple) -> InteractiveMarker:
    """A box with handles for six degrees of freedom."""
    found = InteractiveMarker(name=NAME, description="vehicle", scale=scale)
    found.header.frame_id = FRAME
    found.pose.orientation.w = 1.0
    box = Marker(type=Marker.CUBE)
    box.scale.x = box.scale.y = box.scale.z = size
    box.color.r = box.color.g = box.color.b = box.color.a = 0.5
    poses.write(box.pose, (0.0, 0.0, 0.0), turned)
    found.controls.append(InteractiveMarkerControl(always_visible=True, markers=[box]))
    for axis, orientation in AXES.items():
        for name, mode in (
            ("move", InteractiveMarkerControl.MOVE_AXIS),
            ("rotate", InteractiveMarkerControl.ROTATE_AXIS),
        ):
            control = InteractiveMarkerControl(name=f"{name}_{axis}", interaction_mode=mode)
            o = control.orientation
            o.x, o.y, o.z, o.w = orientation
            found.controls.append(control)
    return found


class Server:
    """Shows the marker, and sends the vehicle after it."""

    def __init__(self, topic: str, numbers: list) -> None:
        x, y, z, *angles, size, scale, x_turn, y_turn, z_turn = numbers
        self._start = (x, y, z), poses.quaternion(*angles)
        self._marker = marker(size, scale, poses.quaternion(x_turn, y_turn, z_turn))
        self._seq = 1
        self._command = rospy.Publisher(topic, Odometry, queue_size=1)
        self._all = rospy.Publisher(
            f"{NAME}/update_full", InteractiveMarkerInit, queue_size=1, latch=True
        )
        self._update = rospy.Publisher(f"{NAME}/update", InteractiveMarkerUpdate, queue_size=10)
        self._show()
        rospy.Subscriber(f"{NAME}/feedback", InteractiveMarkerFeedback, self._moved)
        rospy.Timer(rospy.Duration(0.5), lambda _: self._tell(InteractiveMarkerUpdate.KEEP_ALIVE))

    def _show(self) -> None:
        self._all.publish(
            InteractiveMarkerInit(server_id=NAME, seq_num=self._seq, markers=[self._marker])
        )

    def _tell(self, kind: int, **changes: list) -> None:
        message = InteractiveMarkerUpdate(server_id=NAME, seq_num=self._seq, type=kind, **changes)
        self._update.publish(message)

    def _moved(self, feedback: InteractiveMarkerFeedback) -> None:
        if feedback.event_type != InteractiveMarkerFeedback.POSE_UPDATE:
            return
        self._marker.pose = feedback.pose
        self._seq += 1
        self._show()
        there = InteractiveMarkerPose(pose=feedback.pose, name=NAME)
        there.header.frame_id = FRAME
        self._tell(InteractiveMarkerUpdate.UPDATE, poses=[there])
        start, attitude = self._start
        place, turned = poses.read(feedback.pose)
        command = Odometry()
        command.header.stamp = rospy.Time.now()
        moved = [p + d for p, d in zip(start, place, strict=True)]
        poses.write(command.pose.pose, moved, poses.times(attitude, turned))
        self._command.publish(command)


def main() -> None:
    topic, *given = rospy.myargv()[1:] or [""]
    if not topic or len(given) not in (0, 6, 8, 11):
        sys.exit(__doc__)
    pose = numbers(given, __doc__)
    rospy.init_node("follow_marker", anonymous=True)
    Server(topic, [*pose, *DEFAULTS[len(pose) :]])
    rospy.spin()


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        main()
