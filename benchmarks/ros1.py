"""What ROS 1 costs: images to a subscriber of rospy, and the rhythm of a topic beside cameras.

Run ``python benchmarks/ros1.py``; ``scripts/ros1_peers`` installs rospy. Images of 640x480 are
published at 30 Hz by the wall clock; the target is 5 ms one way, without loss. Then ``uwsim run
cirs`` goes in real time, with odometry at 100 Hz and both cameras of 320x240 subscribed to: the
target is 3 ms of jitter (how much a message is early or late by its stamp, the median taken for
on time; 95 of 100 are less), and a real-time factor of 0.99.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

import numpy as np
from measure import main

from uwsim.bus import Bus
from uwsim.messages import Image, image
from uwsim.middleware.log import Log
from uwsim.middleware.ros1 import Master, Ros1Bridge

TARGET = 5.0
"""Of an image, one way [ms]."""
N_IMAGES, RATE = 150, 30.0
JITTER_TARGET, FACTOR_TARGET = 3.0, 0.99
"""Of a topic at 100 Hz [ms], and of simulation time per real time."""
N_ODOMETRY = 1500
PYTHON = "/usr/bin/python3"
LISTENER = """
import json, sys, time, rospy
from sensor_msgs.msg import Image
times = []
def receive(message):
    times.append(time.time() - message.header.stamp.to_sec() + 1.0)
    if len(times) == int(sys.argv[1]):
        rospy.signal_shutdown("done")
rospy.init_node("listener")
rospy.Subscriber("/camera", Image, receive, queue_size=10, buff_size=2**24, tcp_nodelay=True)
rospy.spin()
print(json.dumps(times))
"""

RHYTHM = """
import json, sys, time, rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Image
n, cameras = int(sys.argv[1]), sys.argv[2:]
times, pictures = [], [0]
def receive(message):
    if not all_there():
        return
    times.append((time.monotonic(), message.header.stamp.to_sec()))
    if len(times) == n:
        rospy.signal_shutdown("done")
def look(message):
    pictures[0] += 1
def all_there():
    return pictures[0] >= 20 * len(cameras)
rospy.init_node("listener", disable_signals=True)
rospy.Subscriber("/uwsim/girona500/odom", Odometry, receive, queue_size=100, tcp_nodelay=True)
for each in cameras:
    rospy.Subscriber(each, Image, look, queue_size=10, buff_size=2**24, tcp_nodelay=True)
rospy.spin()
print(json.dumps([times, pictures[0]]))
"""


def rhythm(*cameras: str) -> dict[str, object]:
    """Have rospy note when odometry at 100 Hz comes while cameras are drawn."""
    import uwsim

    scene = (Path(uwsim.__file__).parent / "data" / "scenes" / "cirs.xml").read_text()
    was = "<PATToROSOdom> <topic>/uwsim/girona500/odom</topic>"
    assert was in scene
    own = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
    log = Log("ros1", lambda line: None)
    master = Master(log)
    environment = {"ROS_MASTER_URI": master.uri, "ROS_IP": "127.0.0.1"}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "cirs.xml"
        path.write_text(scene.replace(was, f"{was} <rate>100</rate>"))
        run = subprocess.Popen(
            [sys.executable, "-m", "uwsim", "run", str(path), "--ros1"],
            env={**os.environ, **environment},
            stdout=subprocess.DEVNULL,
        )
        listener = subprocess.run(
            [PYTHON, "-c", RHYTHM, str(N_ODOMETRY), *cameras],
            env={**own, **environment},
            stdout=subprocess.PIPE,
            text=True,
            timeout=300.0,
        )
        run.send_signal(signal.SIGINT)
        run.wait(60.0)
    master.close()
    times, n_images = json.loads(listener.stdout)
    arrived, stamps = np.array(times).T
    late = (arrived - arrived[0]) - (stamps - stamps[0])
    jitter = 1000.0 * float(np.percentile(np.abs(late - np.median(late)), 95))
    return {
        "jitter_ms_95": round(jitter, 3),
        "factor": round(float((stamps[-1] - stamps[0]) / (arrived[-1] - arrived[0])), 4),
        "images": n_images,
        "target_ms": JITTER_TARGET,
        "target_factor": FACTOR_TARGET,
        "ratio": round(jitter / JITTER_TARGET, 3),
    }


def images(n: int = N_IMAGES) -> dict[str, object]:
    """Publish images at 30 Hz and have rospy note when each is there."""
    bus, log = Bus(), Log("ros1", lambda line: None)
    master = Master(log)
    bridge = Ros1Bridge(bus, lambda: 0.0, master=master.uri, log=log, parameters={})
    publish = bus.publisher("camera", Image)
    bridge.step()
    own = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
    environment = {**own, "ROS_MASTER_URI": master.uri, "ROS_IP": "127.0.0.1"}
    listener = subprocess.Popen(
        [PYTHON, "-c", LISTENER, str(n)], env=environment, stdout=subprocess.PIPE, text=True
    )
    pixels = np.zeros((480, 640, 3), np.uint8)
    while not bus.has_subscribers("camera"):
        bridge.step()
        time.sleep(0.01)
    began = time.monotonic()
    for i in range(n):
        time.sleep(max(0.0, began + i / RATE - time.monotonic()))
        publish(image(pixels, time=time.time()))
        bus.deliver()
        bridge.step()
    try:
        printed, _ = listener.communicate(timeout=10.0)
        times = [1000.0 * each for each in json.loads(printed)]
    except subprocess.TimeoutExpired:
        listener.kill()
        return {"lost": "some", "of": n}
    finally:
        bridge.close()
        master.close()
    return {
        "wall_ms": round(median(times), 3),
        "wall_ms_95": round(sorted(times)[int(0.95 * len(times))], 3),
        "lost": n - len(times),
        "of": n,
        "target_ms": TARGET,
        "ratio": round(median(times) / TARGET, 3),
    }


if __name__ == "__main__":
    cameras = ("/uwsim/camera1", "/uwsim/camera2")
    main(
        lambda: {
            "640x480 image to rospy": images(),
            "100 Hz to rospy": rhythm(),
            "100 Hz to rospy beside two cameras": rhythm(*cameras),
        }
    )
