#!/usr/bin/python3
"""Move a vehicle to a position, similar to UWSim's gotoAbsolutePose.

    goto_position.py ODOMETRY_TOPIC POSE_TOPIC x y z        m

At 30 Hz it commands a pose 15 % nearer to the goal than the last odometry, at most 0.1 m. The
attitude stays the same. The program ends within 1 cm of the goal.
With `uwsim run cirs --ros1`:  goto_position.py /uwsim/girona500/odom /g500/pose 1 1 2.5
"""

import contextlib
import math
import sys

import rospy
from arguments import parse_numbers
from geometry_msgs.msg import Pose
from nav_msgs.msg import Odometry

SHARE, MAX_STEP, GOAL_TOLERANCE = 0.15, 0.1, 0.01


def main() -> None:
    if len(rospy.myargv()) != 6:
        sys.exit(__doc__)
    odometry_topic, pose_topic, *goal_words = rospy.myargv()[1:]
    goal = parse_numbers(goal_words, __doc__)
    rospy.init_node("goto_position", anonymous=True)
    latest_poses = []
    rospy.Subscriber(
        odometry_topic, Odometry, lambda message: latest_poses.append(message.pose.pose)
    )
    publisher = rospy.Publisher(pose_topic, Pose, queue_size=1)
    rate = rospy.Rate(30)
    while not rospy.is_shutdown():
        rate.sleep()
        if not latest_poses:
            continue
        pose = latest_poses[-1]
        latest_poses[:] = [pose]
        current_position = (pose.position.x, pose.position.y, pose.position.z)
        distance = math.dist(goal, current_position)
        if distance < GOAL_TOLERANCE:
            print("goal reached")
            return
        step = min(SHARE * distance, MAX_STEP) / distance
        command = Pose(orientation=pose.orientation)
        position = command.position
        position.x, position.y, position.z = (
            p + step * (g - p) for p, g in zip(current_position, goal, strict=True)
        )
        publisher.publish(command)


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        main()
