#!/usr/bin/python3
"""Drive a vehicle by geometry_msgs/TwistStamped, as UWSim's setVehicleTwist: 25 Hz.

    set_vehicle_twist.py TOPIC vx vy vz wr wp wy            m/s and rad/s, body frame

With `uwsim run cirs --ros1`:  set_vehicle_twist.py /g500/twist 0.2 0 0 0 0 0.1
"""

import contextlib
import sys

import rospy
from arguments import parse_numbers
from geometry_msgs.msg import TwistStamped


def main() -> None:
    topic, *words = rospy.myargv()[1:] or [""]
    if not topic or len(words) != 6:
        sys.exit(__doc__)
    twist = parse_numbers(words, __doc__)
    rospy.init_node("set_vehicle_twist", anonymous=True)
    publisher = rospy.Publisher(topic, TwistStamped, queue_size=1)
    rate = rospy.Rate(25)
    while not rospy.is_shutdown():
        message = TwistStamped()
        message.header.stamp = rospy.Time.now()
        linear, angular = message.twist.linear, message.twist.angular
        linear.x, linear.y, linear.z, angular.x, angular.y, angular.z = twist
        publisher.publish(message)
        rate.sleep()


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        main()
