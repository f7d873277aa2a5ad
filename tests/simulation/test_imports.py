"""A scene without cameras starts without the libraries that it does not use."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

UNUSED = (
    "OpenGL",
    "cv2",
    "jinja2",
    "matplotlib",
    "moderngl",
    "pandas",
    "ray",
    "rich",
    "scipy.linalg",
    "scipy.optimize",
    "scipy.sparse",
    "scipy.spatial",
    "scipy.special",
    "scipy.stats",
    "trimesh",
    "typer",
)
SCENE = """<?xml version="1.0"?>
<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle>
    <name>girona500</name> <file>data/scenes/g500ARM5.urdf</file>
    <position> <x>0</x> <y>0</y> <z>2.5</z> </position>
    <u:dynamics>g500_physical</u:dynamics>
  </vehicle>
  <object>
    <name>terrain</name> <file>terrain/CIRS/cirs_trident.osg</file>
    <position> <x>0</x> <y>0</y> <z>0</z> </position>
    <physics> <mass>0</mass> <collisionShapeType>trimesh</collisionShapeType> </physics>
  </object>
</UWSimScene>
"""
START = """
import sys, uwsim
with uwsim.load(sys.argv[1]) as simulation:
    simulation.advance(0.1)
print(*(name for name in sys.argv[2:] if name in sys.modules))
"""


def started(scene: Path, environment: dict[str, str]) -> str:
    """Which of `UNUSED` a new process imported to step the scene."""
    return subprocess.run(
        [sys.executable, "-c", START, str(scene), *UNUSED],
        check=True,
        capture_output=True,
        text=True,
        env=environment,
    ).stdout.strip()


@pytest.mark.slow
def test_a_scene_without_cameras_imports_only_what_it_uses(tmp_path: Path) -> None:
    scene = tmp_path / "tank.xml"
    scene.write_text(SCENE)
    environment = {**os.environ, "XDG_CACHE_HOME": str(tmp_path / "cache")}
    started(scene, environment)  # fills the caches
    assert started(scene, environment) == ""
