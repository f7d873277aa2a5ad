"""With what shapes the links of a vehicle are touched."""

from __future__ import annotations

from pathlib import Path

from tests.simulation.small_robots import joint, scene_of, shape, write_robot
from uwsim.model.collision.scene_shapes import collision_shapes
from uwsim.model.resolved_scene import ResolvedScene
from uwsim.scene.urdf.reader import read_urdf
from uwsim.scene.vehicle import VehicleSpec

WEDGE = """v 0 0 0
v 0.2 0 0
v 0 0.1 0
v 0 0 0.1
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
"""
MESH = '<collision><geometry><mesh filename="wedge.obj"/></geometry></collision>'


def test_only_a_finger_is_touched_as_its_convex_mesh(tmp_path: Path) -> None:
    (tmp_path / "wedge.obj").write_text(WEDGE)
    links = f'<link name="base">{shape()}</link> <link name="palm">{MESH}</link>'
    links += f'<link name="finger">{MESH}</link> <link name="tip">{MESH}</link>'
    joints = joint("wrist", "base palm", kind="continuous")
    joints += joint("jaw", "palm finger", kind="continuous") + joint("glue", "palm tip")
    file = write_robot(tmp_path, links + joints)
    scene = scene_of(VehicleSpec(name="v", file=str(file)))
    shapes = collision_shapes(ResolvedScene(scene=scene, robots={0: read_urdf(file)}), [0], {})
    kinds = {name.rpartition("/")[2]: [one.kind for one in each] for name, each in shapes.items()}
    assert kinds == {"base": ["box"], "palm": ["box"], "finger": ["hull"], "tip": ["box"]}
