"""Small robots and scenes around them, written to a folder."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from tests.support.opened import open_scene
from uwsim.scene.ocean_state import FogSpec, OceanStateSpec
from uwsim.scene.sim_params import SimParamsSpec
from uwsim.scene.spec import SceneSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.simulation import Simulation

CLEAR = OceanStateSpec(fog=FogSpec(density=0.0), attenuation=(0.0, 0.0, 0.0), color=(0.0, 0.0, 0.0))
BOX = '<geometry><box size="{} {} {}"/></geometry>'


def shape(
    what: str = "visual",
    size: tuple[float, float, float] = (0.2, 0.2, 0.2),
    *,
    xyz: str = "0 0 0",
    rpy: str = "0 0 0",
    colour: str = "",
) -> str:
    """A ``<visual>`` or ``<collision>`` that is a box."""
    material = f'<material name=""><color rgba="{colour}"/></material>' if colour else ""
    origin = f'<origin xyz="{xyz}" rpy="{rpy}"/>'
    return f"<{what}>{origin}{BOX.format(*size)}{material}</{what}>"


def write_robot(folder: Path, inside: str, name: str = "robot.urdf") -> Path:
    file = folder / name
    file.write_text(f'<robot name="r">{inside}</robot>')
    return file


def joint(
    name: str, ends: str, *, kind: str = "fixed", xyz: str = "0 0 0", rpy: str = "0 0 0",
    axis: str = "0 0 1",
) -> str:  # fmt: skip
    parent, child = ends.split()
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/></joint>'
    )


def scene_of(vehicle: VehicleSpec, **given: object) -> SceneSpec:
    """A scene with one vehicle in clear water, z up, L being W."""
    scene = SceneSpec(vehicles=(vehicle,), ocean_state=CLEAR, sim_params=SimParamsSpec())
    return replace(scene, **given)  # type: ignore[arg-type]


def begin(scene: SceneSpec, **given: object) -> Simulation:
    simulation = open_scene(scene, **given)  # type: ignore[arg-type]
    simulation.advance(0.0)
    return simulation
