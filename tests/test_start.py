"""A start imports nothing that it does not use: `benchmarks/start.py` measures what it costs."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

LEFT_OUT = (
    *("PIL", "cv2", "glfw", "lark", "matplotlib"),
    *("pandas", "rosbags", "scipy.linalg", "trimesh"),
)
"""Modules that a scene without cameras, images and formulas does without."""
COMPILING = "numba.cpython.printimpl"
"""One of numba's that only compiling needs."""
SCENE = """<?xml version="1.0"?>
<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle> <name>v</name> <file>data/scenes/g500ARM5.urdf</file>
    <position> <x>0</x> <y>0</y> <z>-1</z> </position>
    <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
    <u:dynamics>g500_physical</u:dynamics>
  </vehicle>
  <object> <name>floor</name> <file>floor.obj</file>
    <position> <x>0</x> <y>0</y> <z>-3</z> </position>
    <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
    <physics> <mass>0</mass> <collisionShapeType>trimesh</collisionShapeType> </physics>
  </object>
  <rosInterfaces>
    <ROSTwistToPAT> <topic>/v</topic> <vehicleName>v</vehicleName> </ROSTwistToPAT>
  </rosInterfaces>
</UWSimScene>
"""
FLOOR = "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3\nf 1 3 4\n"
PACKAGE = Path(__file__).parent.parent / "src" / "uwsim"
IMPORT_EACH = """
import importlib, os, sys
import llvmlite.binding, numba, numpy
for package in sys.argv[1:]:
    child = os.fork()
    if not child:
        try:
            importlib.import_module(package)
        finally:
            os._exit(1 + ("glfw" in sys.modules) if package in sys.modules else 3)
    print(package, os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""
"""Imports each package in a process of its own, where numba is loaded and nothing of uwsim: the
status is 1 without windows, 2 with them, 3 where it cannot be imported."""
PROGRAM = """
import sys
import uwsim
with uwsim.load(sys.argv[1]) as simulation:
    simulation.advance(0.01)
print(*(name for name in sys.argv[2:] if name in sys.modules))
"""


@pytest.mark.slow
def test_a_second_start_without_cameras_imports_no_library_that_it_does_not_use(
    tmp_path: Path,
) -> None:
    (tmp_path / "scene.xml").write_text(SCENE)
    (tmp_path / "floor.obj").write_text(FLOOR)
    command = [sys.executable, "-c", PROGRAM, str(tmp_path / "scene.xml"), *LEFT_OUT, COMPILING]
    subprocess.run(command, capture_output=True, check=True)  # fills the caches
    second = subprocess.run(command, capture_output=True, text=True, check=True)
    assert second.stdout.split() == []


def imports_the_engine(module: Path) -> bool:
    return any(
        isinstance(node, ast.Import) and any(each.name == "mujoco" for each in node.names)
        for node in ast.parse(module.read_text()).body
    )


def test_whatever_is_imported_first_the_engine_looks_for_no_windows() -> None:
    # it does so in a process of its own, which shows a traceback when the run is ended
    rooms = {module.relative_to(PACKAGE).parts[0] for module in PACKAGE.rglob("*.py")}
    first = {
        m.relative_to(PACKAGE).parts[0] for m in PACKAGE.rglob("*.py") if imports_the_engine(m)
    }
    assert first == {"physics"}  # whose first line has it imported by base/engine.py
    packages = sorted(
        f"uwsim.{room}" for room in rooms if (PACKAGE / room / "__init__.py").exists()
    )
    packages += ["uwsim.model.scene_model", "uwsim.base.engine"]
    command = [sys.executable, "-c", IMPORT_EACH, *packages]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == [f"{package} 1" for package in packages]
