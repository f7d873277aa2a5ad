#!/usr/bin/env python3
"""Add a mesh to the scene, or delete it, as UWSim's spawnMarker; needs `websockets`.

    spawn_marker.py add|del NS ID MESH x y z roll pitch yaw [--uri ws://127.0.0.1:9090]   m and rad

MESH is a URI, such as package://uwsim/data/objects/amphora.osg; a path alone is relative to
package://uwsim/. The rotation is Rx Ry Rz.
With `uwsim run cirs --web 9090`:  spawn_marker.py add toys 1 data/objects/sphere.osg 1 0 3 0 0 0
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from typing import Any

from websockets.exceptions import WebSocketException
from websockets.sync.client import connect

ADD, DELETE, MESH = 0, 2, 10
"""The constants of visualization_msgs/Marker."""


def quaternion(roll: float, pitch: float, yaw: float) -> dict[str, float]:
    """Return the rotation Rx Ry Rz as geometry_msgs/Quaternion."""
    a, b, c = (math.cos(angle / 2) for angle in (roll, pitch, yaw))
    d, e, f = (math.sin(angle / 2) for angle in (roll, pitch, yaw))
    return {
        "x": d * b * c + a * e * f,
        "y": a * e * c - d * b * f,
        "z": a * b * f + d * e * c,
        "w": a * b * c - d * e * f,
    }


def make_marker(options: argparse.Namespace) -> dict[str, Any]:
    """Return the request of the service."""
    x, y, z, *angles = options.pose
    return {
        "header": {"frame_id": "world"},
        "ns": options.ns,
        "id": options.id,
        "type": MESH,
        "action": ADD if options.action == "add" else DELETE,
        "pose": {"position": {"x": x, "y": y, "z": z}, "orientation": quaternion(*angles)},
        "scale": {"x": 1.0, "y": 1.0, "z": 1.0},
        "color": {"r": 1.0, "g": 1.0, "b": 1.0, "a": 1.0},
        "mesh_resource": options.mesh
        if "://" in options.mesh
        else f"package://uwsim/{options.mesh}",
    }


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("action", choices=("add", "del"))
    parser.add_argument("ns")
    parser.add_argument("id", type=int)
    parser.add_argument("mesh")
    parser.add_argument("pose", type=float, nargs=6)
    parser.add_argument("--uri", default="ws://127.0.0.1:9090")
    options = parser.parse_args()
    call = {"op": "call_service", "id": "1", "service": "/SpawnMarker"}
    try:
        with connect(options.uri) as socket:
            socket.send(json.dumps({**call, "args": {"marker": make_marker(options)}}))
            while (answer := json.loads(socket.recv())).get("op") != "service_response":
                if answer.get("op") == "status":
                    sys.exit(answer["msg"])
    except (OSError, WebSocketException) as error:
        sys.exit(f"{options.uri}: {error}")
    if not answer["result"]:
        sys.exit(str(answer["values"]))
    print(answer["values"]["status_message"])
    sys.exit(0 if answer["values"]["success"] else 1)


if __name__ == "__main__":
    main()
