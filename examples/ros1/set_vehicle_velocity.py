#!/usr/bin/python3
"""Drive a vehicle at a velocity, as UWSim's setVehicleVelocity: 25 Hz until interrupted.

    set_vehicle_velocity.py TOPIC vx vy vz wr wp wy         m/s and rad/s, body frame

With `uwsim run cirs --ros1`:  set_vehicle_velocity.py /dataNavigator 0.2 0 0 0 0 0.1
"""

import contextlib
import sys

import rospy
from arguments import parse_numbers
from nav_msgs.msg import Odometry


def main() -> None:
    topic, *words = rospy.myargv()[1:] or [""]
    if not topic or len(words) != 6:
        sys.exit(__doc__)
    velocity = parse_numbers(words, __doc__)
    rospy.init_node("set_vehicle_velocity", anonymous=True)
    publisher = rospy.Publisher(topic, Odometry, queue_size=1)
    rate = rospy.Rate(25)
    while not rospy.is_shutdown():
        message = Odometry()
        message.header.stamp = rospy.Time.now()
        message.pose.pose.orientation.w = 1.0
        linear, angular = message.twist.twist.linear, message.twist.twist.angular
        linear.x, linear.y, linear.z, angular.x, angular.y, angular.z = velocity
        publisher.publish(message)
        rate.sleep()


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        main()
