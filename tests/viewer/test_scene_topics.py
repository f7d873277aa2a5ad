"""What a run tells of its scene: shapes, frames, the robot; latched, and in recordings."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from websockets.sync.client import connect

import uwsim
from tests.support.waiting import wait_until
from uwsim.cli import main
from uwsim.middleware.log import Log
from uwsim.middleware.web.options import WebOptions
from uwsim.middleware.web.server import WebBridge
from uwsim.viewer.scene_topics import SceneTopics

SCENE = """<UWSimScene>
  <vehicle>
    <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>1</x> <y>0</y> <z>2</z> </position>
    <imu> <name>imu</name> <relativeTo>base_link</relativeTo>
      <position> <x>0</x> <y>0</y> <z>0.1</z> </position> </imu>
  </vehicle>
  <rosInterfaces>
    <ImuToROSImu> <name>imu</name> <topic>/imu</topic> </ImuToROSImu>
    {more}
  </rosInterfaces>
</UWSimScene>
"""
FRAMES = "<WorldToROSTF> <rootName>sea</rootName> <rate>10</rate> </WorldToROSTF>"


def recorded(path: Path) -> dict[str, list[Any]]:
    """Topic -> its messages."""
    found: dict[str, list[Any]] = {}
    with path.open("rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        for _, channel, _, message in reader.iter_decoded_messages():
            found.setdefault(channel.topic, []).append(message)
    return found


def frames(messages: list[Any]) -> dict[str, str]:
    """Frame -> its parent."""
    return {
        each.child_frame_id: each.header.frame_id
        for message in messages
        for each in message.transforms
    }


@pytest.mark.parametrize("more", ["", FRAMES], ids=["no-interface", "WorldToROSTF"])
def test_a_recording_of_a_run_is_seen_in_3d_panels(tmp_path: Path, more: str) -> None:
    scene, one, two = tmp_path / "scene.xml", tmp_path / "one.mcap", tmp_path / "two.mcap"
    scene.write_text(SCENE.format(more=more))
    for path in (one, two):
        assert main(["run", str(scene), "--for", "1s", "--record", str(path)]) == 0
    assert one.read_bytes() == two.read_bytes()
    found = recorded(one)
    root = "sea" if more else "world"
    moving, fixed = frames(found["/tf"]), frames(found["/tf_static"])
    assert not set(moving) & set(fixed)
    parents = {**moving, **fixed}
    assert parents[root] == "map"
    assert parents["rov"] == root
    assert parents["imu"] == "rov/base_link"
    assert len(found["/tf"]) == (11 if more else 31)
    (shapes,) = found["/scene"]
    assert shapes.markers
    for marker in shapes.markers:
        frame = marker.header.frame_id
        while frame != "map":
            frame = parents[frame]
    assert "<robot" in found["/robot_description"][0].data


@pytest.mark.slow
def test_shapes_are_where_the_renderer_has_them(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    assert main(["run", "shapes-scene", "--for", "100ms", "--record", str(path)]) == 0
    found = recorded(path)
    world_from: dict[str, Any] = {"map": np.eye(4)}
    newest = {
        each.child_frame_id: each
        for message in (*found["/tf_static"], *found["/tf"][:1])
        for each in message.transforms
    }

    def matrix(frame: str) -> Any:
        if frame not in world_from:
            each = newest[frame]
            t, q = each.transform.translation, each.transform.rotation
            pose = uwsim.base.geometry.Pose.from_quaternion(
                np.array([t.x, t.y, t.z]), np.array([q.w, q.x, q.y, q.z])
            )
            world_from[frame] = matrix(each.header.frame_id) @ pose.matrix
        return world_from[frame]

    with uwsim.load("shapes-scene") as simulation:
        simulation.advance(0.0)
        scenery = simulation.world.scenery
        meshes = [(part, mesh) for part in scenery.parts for mesh in part.model.meshes]
        (shapes,) = found["/scene"]
        assert len(meshes) == len(shapes.markers)
        for (part, mesh), marker in zip(meshes, shapes.markers, strict=True):
            place = matrix(marker.header.frame_id)
            got = np.array([[p.x, p.y, p.z] for p in marker.points[:300]])
            placed = scenery.world_from_mesh(part)
            want = mesh.vertices[mesh.triangles.ravel()[:300]] @ placed[:3, :3].T + placed[:3, 3]
            np.testing.assert_allclose(got @ place[:3, :3].T + place[:3, 3], want, atol=2e-3)


def test_a_late_web_client_gets_what_was_published_once(tmp_path: Path) -> None:
    scene = tmp_path / "scene.xml"
    scene.write_text(SCENE.format(more=""))
    with uwsim.load(str(scene)) as simulation:
        SceneTopics(simulation, is_on_bus=True)
        log = Log("test", lambda line: None)
        bridge = WebBridge(simulation.bus, lambda: simulation.time, WebOptions(port=0), log)
        simulation.watch(bridge.step)
        try:
            simulation.advance(0.1)
            with connect(f"ws://127.0.0.1:{bridge.port}", max_size=None) as client:
                topics = ("tf_static", "robot_description", "scene", "tf")
                for topic in topics:
                    client.send(json.dumps({"op": "subscribe", "topic": f"/{topic}"}))
                heard: dict[str, Any] = {}

                def hear() -> None:
                    simulation.advance(0.05)
                    try:
                        frame = json.loads(client.recv(timeout=0.01))
                    except TimeoutError:
                        return
                    heard[frame["topic"]] = frame["msg"]

                wait_until(lambda: len(heard) == len(topics), hear)
        finally:
            bridge.close()
    assert "<robot" in heard["/robot_description"]["data"]
    assert heard["/scene"]["markers"][0]["header"]["frame_id"].startswith("rov/")
    assert heard["/tf"]["transforms"][0]["child_frame_id"] == "rov"
