#!/usr/bin/python3
"""Move the joints of an arm at velocities, as UWSim's setJointVelocity: 30 Hz.

    set_joint_velocity.py TOPIC v1 v2 v3 v4 v5              rad/s

With `uwsim run cirs --ros1`:  set_joint_velocity.py /uwsim/joint_state_command 0.1 0 0 0 0
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
    rospy.init_node("set_joint_velocity", anonymous=True)
    publisher = rospy.Publisher(topic, JointState, queue_size=1)
    rate = rospy.Rate(30)
    while not rospy.is_shutdown():
        message = JointState(name=NAMES, velocity=commands)
        message.header.stamp = rospy.Time.now()
        publisher.publish(message)
        rate.sleep()


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        main()
