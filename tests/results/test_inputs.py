"""The inputs of a result: nothing that is read is without its hash."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image
from scipy.io import netcdf_file

from tests.support.opened import open_scene
from uwsim.base.files.input_files import record_inputs
from uwsim.errors import ResultError
from uwsim.results import journal
from uwsim.results.inputs import Inputs, input_differences
from uwsim.runs.planning.make_plan import make_plan
from uwsim.runs.planning.plan import Plan
from uwsim.runs.planning.plan_request import PlanRequest
from uwsim.runs.result_inputs import inputs_of
from uwsim.runs.run import Run
from uwsim.verify.recorded_plan import check_inputs

BENCHMARK = """<benchmark xmlns:u="urn:uwsim:1" u:scene="sea.xml">
  <measures>
    <time> <name>t</name>
      <startOn><type>onInit</type></startOn> <stopOn><type>never</type></stopOn> </time>
  </measures>
  <startOn><type>onInit</type></startOn> <stopOn><type>never</type></stopOn>
  <function>t</function>
  <sceneUpdater>
    <sceneFogUpdater>
      <initialValue>0</initialValue> <finalValue>0.2</finalValue> <step>0.1</step>
      <interval>0.1</interval>
    </sceneFogUpdater>
  </sceneUpdater>
</benchmark>
"""
OBJECT = "<object> <name>{name}</name> <file>{file}</file> </object>"
SCENE = f"""<UWSimScene xmlns:u="urn:uwsim:1">
  <oceanState>
    <u:current>
      <u:field> <u:file>data/drift.csv</u:file> </u:field>
      <u:field> <u:file>tide.nc</u:file> </u:field>
      <u:pythonFunction> <u:function>own_eddy:eddy</u:function> </u:pythonFunction>
    </u:current>
  </oceanState>
  <vehicle> <name>rov</name> <file>rov.urdf</file> <u:dynamics>small</u:dynamics> </vehicle>
  {OBJECT.format(name="rock", file="models/rock.obj")}
  {OBJECT.format(name="box", file="models/box.gltf")}
</UWSimScene>
"""
URDF = """<robot name="rov"> <link name="base">
  <inertial> <mass value="10"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/> </inertial>
  <visual> <geometry> <mesh filename="hull.stl"/> </geometry> </visual>
</link> </robot>
"""
BODY = """<body link="base"> <mass>10</mass> <volume>0.01</volume>
  <addedMass>1 1 1 1 1 1</addedMass> </body>"""
TRACKER = """
import json
from own_parts.filter import gain

class Tracker:
    def start(self, node):
        self.gain = gain
"""


def _write(folder: Path) -> None:
    """A benchmark whose scene reads a file of every kind."""
    for name in ("data", "models", "own_parts"):
        (folder / name).mkdir()
    texts = {
        "b.xml": BENCHMARK,
        "sea.xml": SCENE,
        "rov.urdf": URDF,
        "small.xml": '<hydrodynamics name="small"> <source>me</source> '
        "<include>hull.xml</include> </hydrodynamics>",
        "hull.xml": f'<hydrodynamics name="hull"> <source>me</source> {BODY} </hydrodynamics>',
        "data/drift.csv": "x,u,v\n0,0.1,0\n1,0.2,0\n",
        "own_eddy.py": "from own_depth import speed\n\ndef eddy(point, time, vehicle):\n"
        "    return speed, 0.0, 0.0\n",
        "own_depth.py": "speed = 0.1\n",
        "own_tracker.py": TRACKER,
        "own_parts/__init__.py": "",
        "own_parts/filter.py": "from . import numbers\n\ngain = numbers.gain\n",
        "own_parts/numbers.py": "gain = 0.5\n",
        "models/rock.obj": "mtllib rock.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
        "usemtl m\nf 1/1 2/2 3/3\n",
        "models/rock.mtl": "newmtl m\nmap_Kd rock.png\n",
    }
    for name, text in texts.items():
        (folder / name).write_text(text)
    for name, data in trimesh.creation.box((1.0, 2.0, 3.0)).export(file_type="gltf").items():
        (folder / "models" / name.replace("model", "box")).write_bytes(data)
    trimesh.creation.box((1.0, 1.0, 1.0)).export(folder / "hull.stl")
    Image.new("RGB", (4, 2), (200, 100, 50)).save(folder / "models" / "rock.png")
    with netcdf_file(folder / "tide.nc", "w") as file:
        file.createDimension("x", 2)
        for name, values in (("x", [0.0, 1.0]), ("u", [0.1, 0.2]), ("v", [0.0, 0.0])):
            variable = file.createVariable(name, "f8", ("x",))
            variable[:] = np.array(values)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    _write(tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    yield tmp_path
    for name in [name for name in sys.modules if name.startswith("own_")]:
        del sys.modules[name]


def _plan(algorithm: str = "own_tracker:Tracker") -> Plan:
    return make_plan(PlanRequest(benchmark="b.xml", algorithm=algorithm, seed=0, repeat=1))


def _inputs(algorithm: str = "own_tracker:Tracker") -> Inputs:
    plan = _plan(algorithm)
    with record_inputs() as files:
        simulation = open_scene(plan.scene)
    simulation.close()
    return inputs_of(plan, simulation, files)


def _edited(name: str, data: bytes) -> bytes:
    """The same content in other bytes."""
    suffix = Path(name).suffix
    if suffix == ".stl":
        return b"edited" + data[6:]  # its header
    return data + {".obj": b"# more\n", ".mtl": b"# more\n", ".py": b"# more\n"}.get(suffix, b"\n")


ASSETS = [
    "data/drift.csv",
    "hull.stl",
    "hull.xml",
    "models/box.gltf",
    "models/gltf_buffer_0.bin",
    "models/gltf_buffer_1.bin",
    "models/rock.mtl",
    "models/rock.obj",
    "models/rock.png",
    "own_depth.py",
    "own_eddy.py",
    "rov.urdf",
    "small.xml",
    "tide.nc",
]
SOURCES = ["own_parts/__init__.py", "own_parts/filter.py", "own_parts/numbers.py", "own_tracker.py"]


def test_every_file_that_is_read_is_among_the_inputs(folder: Path) -> None:
    inputs = _inputs()
    assert list(inputs.as_dict()) == ["benchmark", "scene", "assets", "algorithm"]
    assert (list(inputs.assets or ()), list(inputs.algorithm or ())) == (ASSETS, SOURCES)
    assert str(folder) not in str(inputs)
    assert "algorithm" not in inputs.drop_algorithm().as_dict()
    assert "algorithm" not in _inputs("p").as_dict()


def test_a_file_that_was_changed_is_named(folder: Path) -> None:
    before = _inputs()
    for role, names in (("assets", ASSETS), ("algorithm", SOURCES)):
        for name in names:
            kept = (folder / name).read_bytes()
            (folder / name).write_bytes(_edited(name, kept))
            said = input_differences(before, _inputs())
            file = name if role == "assets" else f"{role} {name}"
            assert [line.partition(" (")[0] for line in said] == [f"{file} is another file now"]
            (folder / name).write_bytes(kept)
    assert input_differences(before, _inputs()) == []


def test_inputs_are_compared_as_json_has_them_and_as_python_has_them() -> None:
    stored = {"scene": ("a.xml", "sha256:1"), "plugins": (("p.py", "sha256:2"),), "assets": {}}
    now = {"scene": ["a.xml", "sha256:1"], "plugins": [["p.py", "sha256:3"]], "assets": {"x": "y"}}
    before, after = Inputs.from_dict(stored), Inputs.from_dict(now)
    assert list(before.files()) == [
        ("scene", "a.xml", "sha256:1"),
        ("plugins", "p.py", "sha256:2"),
    ]
    assert input_differences(before, after) == [
        "plugins p.py is another file now (2 then, 3 now)",
        "x was not used then",
    ]


def test_an_edited_algorithm_is_not_mixed_into_a_result_that_is_resumed(folder: Path) -> None:
    inputs = _inputs()
    bench = Run(plan=_plan(), out=folder / "out", inputs=inputs, renderer="none")
    journal.Journal(bench.out, 0, bench.head(bench.begin()[0])).close()
    (folder / "own_parts" / "numbers.py").write_text("gain = 0.6\n")
    said = "algorithm own_parts/numbers.py is another file now"
    with pytest.raises(ResultError, match=f"belongs to another run: {said}"):
        replace(bench, inputs=_inputs()).begin()
    with pytest.raises(ResultError, match=f"made with other files: {said}"):
        check_inputs(inputs, _inputs())


def test_a_resumed_run_says_what_of_it_is_another(folder: Path) -> None:
    bench = Run(plan=_plan("p"), out=folder / "out", inputs=_inputs("p"), renderer="none")
    journal.Journal(bench.out, 0, bench.head(bench.begin()[0])).close()
    other = replace(bench, plan=replace(bench.plan, seed=4))
    with pytest.raises(ResultError, match="belongs to another run: seed is 4 now, was 0"):
        other.begin()


def test_a_shape_without_a_hash_of_an_earlier_version_is_no_input() -> None:
    inputs = Inputs(assets={"box": "sha256:", "rov.urdf": "sha256:" + 64 * "a"})
    assert [name for _, name, _ in inputs.files()] == ["rov.urdf"]
    assert input_differences(inputs, Inputs(assets={"rov.urdf": "sha256:" + 64 * "a"})) == []
