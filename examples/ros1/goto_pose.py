#!/usr/bin/python3
"""Go to a pose and end there, as the original's gotoAbsolutePose and gotoRelativePose: 30 Hz.

    goto_pose.py absolute|relative ODOMETRY_TOPIC CONTROL_TOPIC x y z roll pitch yaw   m and rad

Each command is 15 % nearer to the goal than the last odometry, at most 0.1 m (absolute) or 0.05 m
(relative: the goal is in the frame of the first odometry); the attitude turns by the share of
the way that is done. It ends within 1 cm.
With `uwsim run cirs --ros1`:
goto_pose.py absolute /uwsim/girona500/odom /dataNavigator 1 1 2.5 0 0 1
"""

import contextlib
import math
import sys

import poses
import rospy
from arguments import numbers
from nav_msgs.msg import Odometry

SHARE, NEAR = 0.15, 0.01
MAX_STEP = {"absolute": 0.1, "relative": 0.05}


def main() -> None:
    words = rospy.myargv()[1:]
    if len(words) != 9 or words[0] not in MAX_STEP:
        sys.exit(__doc__)
    kind, odometry_topic, control_topic, *given = words
    x, y, z, *angles = numbers(given, __doc__)
    rospy.init_node("goto_pose", anonymous=True)
    publisher = rospy.Publisher(control_topic, Odometry, queue_size=1)
    newest = []
    rospy.Subscriber(odometry_topic, Odometry, lambda m: newest.append(poses.read(m.pose.pose)))
    rate = rospy.Rate(30)
    while not newest and not rospy.is_shutdown():
        rate.sleep()
    if not newest:
        return
    start, attitude = newest[0]
    goal, turned = (x, y, z), poses.quaternion(*angles)
    if kind == "relative":
        goal = tuple(p + d for p, d in zip(start, poses.rotated(attitude, goal), strict=True))
        turned = poses.times(attitude, turned)
    whole = math.dist(start, goal)
    while not rospy.is_shutdown():
        place, _ = newest[-1]
        newest[:] = newest[-1:]
        away = math.dist(place, goal)
        step = 1.0 if away < NEAR else min(SHARE * away, MAX_STEP[kind]) / away
        command = Odometry()
        command.header.stamp = rospy.Time.now()
        done = 1.0 if away < NEAR else max(0.0, 1.0 - away / max(whole, NEAR))
        poses.write(
            command.pose.pose,
            [p + step * (g - p) for p, g in zip(place, goal, strict=True)],
            poses.between(attitude, turned, done),
        )
        publisher.publish(command)
        rate.sleep()
        if away < NEAR:
            print("there")
            return


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        main()
