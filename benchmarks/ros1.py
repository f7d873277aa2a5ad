"""Measure ROS 1: images to a subscriber of rospy, and the jitter of a topic beside cameras.

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

TARGET_MS = 5.0
"""The target of an image, one way [ms]."""
N_IMAGES, RATE = 150, 30.0
TARGET_JITTER_MS, TARGET_FACTOR = 3.0, 0.99
"""The targets of the jitter at 100 Hz [ms], and of the real-time factor."""
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

JITTER_LISTENER = """
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


def measure_jitter(*cameras: str) -> dict[str, object]:
    """Measure the jitter of odometry at 100 Hz in rospy, with images of cameras."""
    import uwsim

    scene = (Path(uwsim.__file__).parent / "data" / "scenes" / "cirs.xml").read_text()
    element = "<PATToROSOdom> <topic>/uwsim/girona500/odom</topic>"
    assert element in scene
    variables = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
    log = Log("ros1", lambda line: None)
    master = Master(log)
    environment = {"ROS_MASTER_URI": master.uri, "ROS_IP": "127.0.0.1"}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "cirs.xml"
        path.write_text(scene.replace(element, f"{element} <rate>100</rate>"))
        run = subprocess.Popen(
            [sys.executable, "-m", "uwsim", "run", str(path), "--ros1"],
            env={**os.environ, **environment},
            stdout=subprocess.DEVNULL,
        )
        listener = subprocess.run(
            [PYTHON, "-c", JITTER_LISTENER, str(N_ODOMETRY), *cameras],
            env={**variables, **environment},
            stdout=subprocess.PIPE,
            text=True,
            timeout=300.0,
        )
        run.send_signal(signal.SIGINT)
        run.wait(60.0)
    master.close()
    times, n_images = json.loads(listener.stdout)
    arrival_times, stamps = np.array(times).T
    delays = (arrival_times - arrival_times[0]) - (stamps - stamps[0])
    jitter = 1000.0 * float(np.percentile(np.abs(delays - np.median(delays)), 95))
    return {
        "jitter_ms_95": round(jitter, 3),
        "factor": round(
            float((stamps[-1] - stamps[0]) / (arrival_times[-1] - arrival_times[0])), 4
        ),
        "images": n_images,
        "target_ms": TARGET_JITTER_MS,
        "target_factor": TARGET_FACTOR,
        "ratio": round(jitter / TARGET_JITTER_MS, 3),
    }


def measure_images(n: int = N_IMAGES) -> dict[str, object]:
    """Publish images at 30 Hz, and measure their arrival in rospy."""
    bus, log = Bus(), Log("ros1", lambda line: None)
    master = Master(log)
    bridge = Ros1Bridge(bus, lambda: 0.0, master=master.uri, log=log, parameters={})
    publish = bus.publisher("camera", Image)
    bridge.step()
    variables = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
    environment = {**variables, "ROS_MASTER_URI": master.uri, "ROS_IP": "127.0.0.1"}
    listener = subprocess.Popen(
        [PYTHON, "-c", LISTENER, str(n)], env=environment, stdout=subprocess.PIPE, text=True
    )
    pixels = np.zeros((480, 640, 3), np.uint8)
    while not bus.has_subscribers("camera"):
        bridge.step()
        time.sleep(0.01)
    start_time = time.monotonic()
    for i in range(n):
        time.sleep(max(0.0, start_time + i / RATE - time.monotonic()))
        publish(image(pixels, time=time.time()))
        bus.deliver()
        bridge.step()
    try:
        output, _ = listener.communicate(timeout=10.0)
        times = [1000.0 * delay for delay in json.loads(output)]
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
        "target_ms": TARGET_MS,
        "ratio": round(median(times) / TARGET_MS, 3),
    }


if __name__ == "__main__":
    cameras = ("/uwsim/camera1", "/uwsim/camera2")
    main(
        lambda: {
            "640x480 image to rospy": measure_images(),
            "100 Hz to rospy": measure_jitter(),
            "100 Hz to rospy beside two cameras": measure_jitter(*cameras),
        }
    )
