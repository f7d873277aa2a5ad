#!/usr/bin/python3
"""Hold the joints of an arm at positions, as UWSim's setJointPosition: 30 Hz.

    set_joint_position.py TOPIC q1 q2 q3 q4 q5              rad

With `uwsim run cirs --ros1`:  set_joint_position.py /uwsim/joint_state_command 0.3 0.5 1 0 0.2
"""

import contextlib
import sys

import rospy
from arguments import parse_numbers
from sensor_msgs.msg import JointState

NAMES = ["Slew", "Shoulder", "Elbow", "JawRotate", "JawOpening"]


def main() -> None:
    topic, *words = rospy.myargv()[1:] or [""]
    if not topic or len(words) != len(NAMES):
        sys.exit(__doc__)
    commands = parse_numbers(words, __doc__)
    rospy.init_node("set_joint_position", anonymous=True)
    publisher = rospy.Publisher(topic, JointState, queue_size=1)
    rate = rospy.Rate(30)
    while not rospy.is_shutdown():
        message = JointState(name=NAMES, position=commands)
        message.header.stamp = rospy.Time.now()
        publisher.publish(message)
        rate.sleep()


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        main()
