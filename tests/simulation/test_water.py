"""What floats in moving water goes where the water goes, whichever way a scene says it moves."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.io import netcdf_file

from tests.support.opened import open_scene
from uwsim.scene.reader import read_scene

ROBOT = """<robot name="float"><link name="hull">
  <visual><geometry><box size="0.3 0.2 0.1"/></geometry></visual>
</link></robot>"""
# neutral, and so much drag that it lags behind the water by 0.05 s
SET = """<hydrodynamics name="neutral"><body link="hull">
  <mass>10</mass> <inertia>0.1 0.1 0.1 0 0 0</inertia> <addedMass>5 10 10 0.1 0.1 0.1</addedMass>
  <linearDamping>300 400 400 2 2 2</linearDamping> <volume>0.01</volume>
  <implicitness>1</implicitness>
</body></hydrodynamics>"""
SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
<oceanState><u:current>{current}</u:current></oceanState>
<simParams>
  <offsetp> <x>0</x> <y>0</y> <z>0</z> </offsetp>
  <offsetr> <x>M_PI</x> <y>0</y> <z>-M_PI_2</z> </offsetr>
</simParams>
<vehicle> <name>float</name> <file>float.urdf</file>
  <position> <x>1</x> <y>0.5</y> <z>4</z> </position>
  <orientation> <r>0</r> <p>0</p> <y>1</y> </orientation>
  {dynamics}
</vehicle></UWSimScene>"""
START = np.array([1.0, 0.5, 4.0])
AXES = {
    "t": np.array([0.0, 7.0, 30.0]),
    "x": np.array([-4.0, 0.0, 1.0, 6.0]),
    "y": np.array([-4.0, 6.0]),
    "z": np.array([0.0, 3.0, 8.0]),
}
Law = Callable[[np.ndarray, float], np.ndarray]


def eddy(point: np.ndarray, time: float) -> np.ndarray:
    """Turns about (0, 0), more slowly further down, and swells: linear along every axis."""
    x, y, z = point
    return np.array([-0.15 * y + 0.01 * time, 0.15 * x, 0.004 * (z - 4.0) + 0.002 * time])


def csv(folder: Path) -> str:
    rows = ["x,y,z,t,u,v,w"]
    for x, y, z, t in itertools.product(AXES["x"], AXES["y"], AXES["z"], AXES["t"]):
        rows.append(
            ",".join(
                f"{value!r}" for value in map(float, (x, y, z, t, *eddy(np.array([x, y, z]), t)))
            )
        )
    (folder / "eddy.csv").write_text("\n".join(rows) + "\n")
    return "<u:field> <u:file>eddy.csv</u:file> </u:field>"


def netcdf(folder: Path) -> str:
    with netcdf_file(folder / "eddy.nc", "w") as data:
        for name, values in AXES.items():
            data.createDimension(name, len(values))
            data.createVariable(name, "d", (name,))[:] = values
        shape = tuple(len(values) for values in AXES.values())
        for i, name in enumerate("uvw"):
            values = np.empty(shape)
            for t, x, y, z in np.ndindex(shape):
                node = np.array([AXES["x"][x], AXES["y"][y], AXES["z"][z]])
                values[t, x, y, z] = eddy(node, AXES["t"][t])[i]
            data.createVariable(name, "d", tuple(AXES))[:] = values
    return "<u:field> <u:file>eddy.nc</u:file> </u:field>"


def later(folder: Path) -> str:
    csv(folder)
    return "<u:field> <u:file>eddy.csv</u:file> <u:start>5</u:start> </u:field>"


def function(folder: Path) -> str:
    (folder / "my_own_water.py").write_text(
        "def eddy(point, time, vehicle):\n"
        "    assert vehicle in ('float', '')\n"
        "    x, y, z = point\n"
        "    return -0.15 * y + 0.01 * time, 0.15 * x, 0.004 * (z - 4.0) + 0.002 * time\n"
    )
    return "<u:pythonFunction> <u:function>my_own_water:eddy</u:function> </u:pythonFunction>"


def tidal(folder: Path) -> str:
    return (
        "<u:tidal> <u:start>1000</u:start> <u:constituent> <u:name>M2</u:name>"
        "<u:semiMajor>0.4</u:semiMajor> <u:semiMinor>-0.05</u:semiMinor>"
        "<u:inclination>M_PI_4</u:inclination> </u:constituent> </u:tidal>"
    )


def tide(point: np.ndarray, time: float) -> np.ndarray:
    angle = 2.0 * math.pi * (1000.0 + time) / (12.4206012 * 3600.0)
    along, across = 0.4 * math.cos(angle), -0.05 * math.sin(angle)
    return np.array([along - across, along + across, 0.0]) * math.sqrt(0.5)


def power(folder: Path) -> str:
    return (
        "<u:powerProfile> <u:velocity> <x>0.4</x> <y>-0.1</y> <z>0</z> </u:velocity>"
        "<u:depth>5</u:depth> </u:powerProfile>"
    )


def log(folder: Path) -> str:
    return (
        "<u:logProfile> <u:velocity> <x>0.4</x> <y>-0.1</y> <z>0</z> </u:velocity>"
        "<u:depth>5</u:depth> <u:roughness>0.001</u:roughness> </u:logProfile>"
    )


def layers(folder: Path) -> str:
    layer = "<u:layer> <u:depth>{}</u:depth> <u:velocity> {} </u:velocity> </u:layer>"
    speeds = {0: 0.5, 3: 0.3, 5: 0.1}
    each = [layer.format(d, f"<x>{x}</x> <y>0</y> <z>0</z>") for d, x in speeds.items()]
    return f"<u:layers> {' '.join(each)} </u:layers>"


SAID: dict[str, tuple[Callable[[Path], str], Law]] = {
    "csv": (csv, eddy),
    "csv from its fifth second": (later, lambda p, t: eddy(p, t + 5.0)),
    "netcdf": (netcdf, eddy),
    "python function": (function, eddy),
    "tidal": (tidal, tide),
    "power profile": (power, lambda p, t: np.array([0.4, -0.1, 0.0]) * (1 - p[2] / 5) ** (1 / 7)),
    "log profile": (
        log,
        lambda p, t: np.array([0.4, -0.1, 0.0]) * math.log((5 - p[2]) / 0.001) / math.log(5000.0),
    ),
    "layers": (layers, lambda p, t: np.array([0.3 - 0.1 * (p[2] - 3), 0.0, 0.0])),
    "two at once": (lambda f: csv(f) + tidal(f), lambda p, t: eddy(p, t) + tide(p, t)),
}


SLOW = ("csv from its fifth second", "two at once", "power profile")


@pytest.mark.parametrize("dynamics", ["<u:dynamics>neutral</u:dynamics>", ""])
@pytest.mark.parametrize(
    "said",
    [pytest.param(name, marks=pytest.mark.slow) if name in SLOW else name for name in SAID],
)
def test_what_floats_goes_where_the_water_goes(
    said: str, dynamics: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write, law = SAID[said]
    (tmp_path / "float.urdf").write_text(ROBOT)
    (tmp_path / "neutral.xml").write_text(SET)
    monkeypatch.syspath_prepend(str(tmp_path))
    scene = tmp_path / "scene.xml"
    scene.write_text(SCENE.format(current=write(tmp_path), dynamics=dynamics))
    simulation = open_scene(replace(read_scene(scene), ros_interfaces=()))
    simulation.advance(0.0)
    localized_from_world = simulation.world.model.scene.world_from_localized.inverse()
    dt, travelled, places = simulation.timestep, np.zeros(3), [START]
    for step in range(round(8.0 / dt)):
        travelled += law(places[-1], step * dt) * dt
        simulation.advance()
        world = simulation.world.bodies.find("float").world_from_body
        places.append((localized_from_world @ world).position)
    assert np.linalg.norm(travelled) > 0.5
    velocity = (places[-1] - places[-101]) / (100 * dt)
    expected = law(places[-51], simulation.time - 50 * dt)
    assert velocity == pytest.approx(expected, abs=0.01 * float(np.linalg.norm(expected)))
    # the simulated one starts from rest, and so a little late
    late = 0.1 * float(np.linalg.norm(law(START, 0.0))) if dynamics else 1e-3
    assert places[-1] - START == pytest.approx(travelled, abs=late)
