#!/usr/bin/python3
"""Go to a position and end there, in the manner of the original's gotoAbsolutePose.

    goto_position.py ODOMETRY_TOPIC POSE_TOPIC x y z        m

At 30 Hz it commands a pose 15 % nearer to the goal than the last odometry, at most 0.1 m; the
attitude stays. It ends within 1 cm.
With `uwsim run cirs --ros1`:  goto_position.py /uwsim/girona500/odom /g500/pose 1 1 2.5
"""

import contextlib
import math
import sys

import rospy
from arguments import numbers
from geometry_msgs.msg import Pose
from nav_msgs.msg import Odometry

SHARE, MAX_STEP, NEAR = 0.15, 0.1, 0.01


def main() -> None:
    if len(rospy.myargv()) != 6:
        sys.exit(__doc__)
    odometry_topic, pose_topic, *given = rospy.myargv()[1:]
    goal = numbers(given, __doc__)
    rospy.init_node("goto_position", anonymous=True)
    newest = []
    rospy.Subscriber(odometry_topic, Odometry, lambda message: newest.append(message.pose.pose))
    publisher = rospy.Publisher(pose_topic, Pose, queue_size=1)
    rate = rospy.Rate(30)
    while not rospy.is_shutdown():
        rate.sleep()
        if not newest:
            continue
        here = newest[-1]
        newest[:] = [here]
        place = (here.position.x, here.position.y, here.position.z)
        away = math.dist(goal, place)
        if away < NEAR:
            print("there")
            return
        step = min(SHARE * away, MAX_STEP) / away
        command = Pose(orientation=here.orientation)
        position = command.position
        position.x, position.y, position.z = (
            p + step * (g - p) for p, g in zip(place, goal, strict=True)
        )
        publisher.publish(command)


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        main()
