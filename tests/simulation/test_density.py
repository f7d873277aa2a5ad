"""The density of the water is the water's, whatever vehicles float in it."""

from __future__ import annotations

from dataclasses import replace
from importlib import resources
from pathlib import Path

import pytest

from uwsim.errors import SceneError
from uwsim.scene.ocean_state import OceanStateSpec
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.simulation.bodies import read_robots
from uwsim.simulation.dynamics import Search, read_dynamics

SCENE = Path(str(resources.files("uwsim"))) / "data" / "scenes" / "currents-scene.xml"


def two(ocean: OceanStateSpec, *, turned: bool = False) -> SceneSpec:
    scene = read_scene(SCENE).nominal
    girona = replace(scene.vehicles[0], virtual_cameras=())
    rexrov = VehicleSpec(name="rexrov", file="rexrov.urdf", dynamics="rexrov")
    vehicles = (rexrov, girona) if turned else (girona, rexrov)
    return replace(scene, vehicles=vehicles, ocean_state=ocean, ros_interfaces=())


def densities(scene: SceneSpec) -> dict[str, float]:
    found = read_dynamics(scene, read_robots(scene, ()))
    return {scene.vehicles[i].name: one.density for i, one in found.items()}


def test_sets_for_different_waters_need_a_density() -> None:
    with pytest.raises(SceneError, match=r"'girona500' 1000 and 'rexrov' 1028 .*<u:density>"):
        densities(two(OceanStateSpec()))


@pytest.mark.parametrize("turned", [False, True])
def test_the_order_in_the_file_does_not_matter(turned: bool) -> None:
    scene = two(OceanStateSpec(density=1010.0), turned=turned)
    assert densities(scene) == {"girona500": 1010.0, "rexrov": 1010.0}


def test_temperature_and_salinity_give_a_density() -> None:
    scene = two(OceanStateSpec(temperature=5.0, salinity=35.0))
    assert densities(scene)["rexrov"] == pytest.approx(1027.67547, abs=1e-5)


def test_added_mass_and_drag_are_those_of_the_water_and_the_lift_is_reported() -> None:
    scene = two(OceanStateSpec(density=1028.0))
    search = Search(scene, read_robots(scene, ()), ())
    girona, own = search.dynamics[0], Search(
        two(OceanStateSpec(density=1000.0)), read_robots(scene, ()), ()
    ).dynamics[0]  # fmt: skip
    for heavy, light in zip(girona.bodies, own.bodies, strict=True):
        assert heavy.added_mass == pytest.approx([1.028 * x for x in light.added_mass])
        assert heavy.volume == light.volume
    warnings = [
        diagnostic.message for diagnostic in search.found if diagnostic.severity == "warning"
    ]
    assert any("trimmed in 1000" in one and "N lighter here" in one for one in warnings)
