#!/usr/bin/python3
"""Command thrusters by std_msgs/Float64MultiArray, as UWSim's setVehicleActuators: 5 Hz.

    set_vehicle_actuators.py TOPIC u1 ... un                -1 to 1 each

With `uwsim run grasp-scene --ros1`:
set_vehicle_actuators.py /girona500/thrusters 0.2 0.2 0 0 0
"""

import contextlib
import sys

import rospy
from arguments import parse_numbers
from std_msgs.msg import Float64MultiArray


def main() -> None:
    topic, *words = rospy.myargv()[1:] or [""]
    if not topic or not words:
        sys.exit(__doc__)
    commands = parse_numbers(words, __doc__)
    rospy.init_node("set_vehicle_actuators", anonymous=True)
    publisher = rospy.Publisher(topic, Float64MultiArray, queue_size=1)
    message = Float64MultiArray(data=commands)
    rate = rospy.Rate(5)
    while not rospy.is_shutdown():
        publisher.publish(message)
        rate.sleep()


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        main()
