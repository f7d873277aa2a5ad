#!/usr/bin/python3
"""Keep a position in a current: a program of rospy that needs nothing of uwsim.

    keep_station.py ODOMETRY_TOPIC TWIST_TOPIC x y z        m, in the frame of the odometry

Ten times a second it commands a velocity towards the goal, 0.4 1/s times the distance. Before the
first command it calls `startBench`, which starts a benchmark. In two terminals:

    uwsim bench examples/ros1/keep_station.xml --ros1 --client keep_station --sync none
    examples/ros1/keep_station.py /g500/odom /g500/twist -9 -8 10

With `--sync output --output /g500/twist=10Hz` instead of `--sync none` simulation time waits
for each command.
"""

import contextlib
import sys

import rospy
from arguments import parse_numbers
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from std_srvs.srv import Empty

KP, PERIOD = 0.4, 0.1


class KeepStation:
    """A proportional controller of the position."""

    def __init__(self, odometry_topic: str, twist_topic: str, goal: list) -> None:
        self.goal, self.odometry, self.has_begun = goal, None, False
        self.publisher = rospy.Publisher(twist_topic, TwistStamped, queue_size=1)
        rospy.Subscriber(odometry_topic, Odometry, self.store_odometry, queue_size=1)
        rospy.Timer(rospy.Duration(PERIOD), self.control)

    def store_odometry(self, odometry: Odometry) -> None:
        """Store the latest odometry."""
        self.odometry = odometry

    def control(self, _event: object) -> None:
        """Command a velocity in the axes of the vehicle."""
        if self.odometry is None:
            return
        if not self.has_begun:
            self.has_begun = True
            with contextlib.suppress(
                rospy.ServiceException, rospy.ROSException
            ):  # `uwsim run` does not offer it
                rospy.ServiceProxy("startBench", Empty)()
        command = TwistStamped()
        command.header.stamp = rospy.Time.now()
        linear = command.twist.linear
        linear.x, linear.y, linear.z = velocity(self.odometry, self.goal)
        self.publisher.publish(command)


def velocity(odometry: Odometry, goal: list) -> list:
    """Return the velocity towards the goal in the axes of the vehicle, 3 numbers [m/s]."""
    p, q = odometry.pose.pose.position, odometry.pose.pose.orientation
    ground_velocity = [KP * (g - x) for g, x in zip(goal, (p.x, p.y, p.z), strict=True)]
    axis = (q.x, q.y, q.z)
    cross_product = cross(axis, ground_velocity)  # the velocity, rotated by the inverse attitude
    return [
        v - 2.0 * q.w * t + 2.0 * u
        for v, t, u in zip(ground_velocity, cross_product, cross(axis, cross_product), strict=True)
    ]


def cross(a: list, b: list) -> list:
    """Return the cross product."""
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def main() -> None:
    if len(rospy.myargv()) != 6:
        sys.exit(__doc__)
    odometry_topic, twist_topic, *goal_words = rospy.myargv()[1:]
    goal = parse_numbers(goal_words, __doc__)
    rospy.init_node("keep_station")
    # Wait for /clock: a timer created before would fire twice at its first message.
    while rospy.Time.now().is_zero() and not rospy.is_shutdown():
        rospy.rostime.wallsleep(0.01)
    KeepStation(odometry_topic, twist_topic, goal)
    rospy.spin()


if __name__ == "__main__":
    main()
