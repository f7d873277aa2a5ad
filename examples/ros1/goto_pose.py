#!/usr/bin/python3
"""Move a vehicle to a pose, as UWSim's gotoAbsolutePose and gotoRelativePose: 30 Hz.

    goto_pose.py absolute|relative ODOMETRY_TOPIC CONTROL_TOPIC x y z roll pitch yaw   m and rad

Each command is 15 % nearer to the goal than the last odometry, at most 0.1 m (absolute) or 0.05 m
(relative: the goal is in the frame of the first odometry). The attitude is interpolated by the
share of the completed distance. The program ends within 1 cm of the goal.
With `uwsim run cirs --ros1`:
goto_pose.py absolute /uwsim/girona500/odom /dataNavigator 1 1 2.5 0 0 1
"""

import contextlib
import math
import sys

import poses
import rospy
from arguments import parse_numbers
from nav_msgs.msg import Odometry

SHARE, GOAL_TOLERANCE = 0.15, 0.01
MAX_STEP = {"absolute": 0.1, "relative": 0.05}


def main() -> None:
    words = rospy.myargv()[1:]
    if len(words) != 9 or words[0] not in MAX_STEP:
        sys.exit(__doc__)
    kind, odometry_topic, control_topic, *pose_words = words
    x, y, z, *angles = parse_numbers(pose_words, __doc__)
    rospy.init_node("goto_pose", anonymous=True)
    publisher = rospy.Publisher(control_topic, Odometry, queue_size=1)
    latest_poses = []
    rospy.Subscriber(
        odometry_topic, Odometry, lambda m: latest_poses.append(poses.read(m.pose.pose))
    )
    rate = rospy.Rate(30)
    while not latest_poses and not rospy.is_shutdown():
        rate.sleep()
    if not latest_poses:
        return
    start, attitude = latest_poses[0]
    goal, goal_attitude = (x, y, z), poses.quaternion(*angles)
    if kind == "relative":
        goal = tuple(p + d for p, d in zip(start, poses.rotate(attitude, goal), strict=True))
        goal_attitude = poses.multiply(attitude, goal_attitude)
    start_distance = math.dist(start, goal)
    while not rospy.is_shutdown():
        position, _ = latest_poses[-1]
        latest_poses[:] = latest_poses[-1:]
        distance = math.dist(position, goal)
        step = (
            1.0 if distance < GOAL_TOLERANCE else min(SHARE * distance, MAX_STEP[kind]) / distance
        )
        command = Odometry()
        command.header.stamp = rospy.Time.now()
        progress = (
            1.0
            if distance < GOAL_TOLERANCE
            else max(0.0, 1.0 - distance / max(start_distance, GOAL_TOLERANCE))
        )
        poses.write(
            command.pose.pose,
            [p + step * (g - p) for p, g in zip(position, goal, strict=True)],
            poses.interpolate(attitude, goal_attitude, progress),
        )
        publisher.publish(command)
        rate.sleep()
        if distance < GOAL_TOLERANCE:
            print("goal reached")
            return


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        main()
