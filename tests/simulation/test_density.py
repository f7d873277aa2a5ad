"""The density of the water is the water's, whatever vehicles float in it."""

from __future__ import annotations

import re
from dataclasses import replace
from importlib import resources
from pathlib import Path

import pytest

from uwsim.errors import SceneError
from uwsim.model.dynamics import NameResolution, read_dynamics
from uwsim.model.resolved_scene import ResolvedScene
from uwsim.model.robots import read_robots
from uwsim.scene.ocean_state import OceanStateSpec, ProfileSpec
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.scene.vehicle import VehicleSpec

SCENE = Path(str(resources.files("uwsim"))) / "data" / "scenes" / "currents-scene.xml"
PROFILE = ProfileSpec(depth=(0.0, 10.0), density=(1000.0, 1025.0))


def two(ocean: OceanStateSpec, *, turned: bool = False) -> SceneSpec:
    scene = read_scene(SCENE).nominal_scene
    girona = replace(scene.vehicles[0], parts=())
    rexrov = VehicleSpec(name="rexrov", file="rexrov.urdf", dynamics="rexrov")
    vehicles = (rexrov, girona) if turned else (girona, rexrov)
    return replace(scene, vehicles=vehicles, ocean_state=ocean, ros_interfaces=())


def resolved(scene: SceneSpec) -> ResolvedScene:
    return ResolvedScene(scene=scene, robots=read_robots(scene, ()))


def densities(scene: SceneSpec) -> dict[str, float]:
    found = read_dynamics(resolved(scene))
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
    search = NameResolution(resolved(scene))
    girona = search.dynamics[0]
    own = NameResolution(resolved(two(OceanStateSpec(density=1000.0)))).dynamics[0]
    for heavy, light in zip(girona.bodies, own.bodies, strict=True):
        assert heavy.added_mass == pytest.approx([1.028 * x for x in light.added_mass])
        assert heavy.volume == light.volume
    warnings = [
        diagnostic.message for diagnostic in search.diagnostics if diagnostic.severity == "warning"
    ]
    assert any("trimmed for 1000" in one and "N lighter than" in one for one in warnings)


def test_a_profile_over_depth_is_the_water_and_the_lift_is_that_at_the_vehicles_depth() -> None:
    profile = ProfileSpec(depth=(0.0, 10.0), temperature=(20.0, 5.0), salinity=(0.0, 35.0))
    scene = two(OceanStateSpec(profile=profile))
    assert densities(scene)["rexrov"] == pytest.approx(998.2063, abs=1e-3)
    at_depth = profile.density_at(1.515)  # of the Girona 500
    volume = sum(body.volume for body in read_dynamics(resolved(scene))[0].bodies)
    lift = 9.81 * (at_depth - 1000.0) * volume
    said = [one.message for one in NameResolution(resolved(scene)).diagnostics]
    assert any(f"is {lift:.3g} N lighter than" in one for one in said)


@pytest.mark.parametrize(
    ("ocean", "said"),
    [
        (OceanStateSpec(density=1000.0, profile=PROFILE), "expected no other density"),
        (OceanStateSpec(profile=replace(PROFILE, depth=(5.0, 2.0))), "expected 2 or more, rising"),
        (OceanStateSpec(profile=replace(PROFILE, density=())), "expected one of <u:density> and"),
        (
            OceanStateSpec(profile=replace(PROFILE, density=(1.0e3,))),
            "<u:density> has 1 numbers; expected 2, one for each depth",
        ),
    ],
)
def test_a_profile_that_says_nothing_or_too_much_is_an_error(
    ocean: OceanStateSpec, said: str
) -> None:
    with pytest.raises(SceneError, match="<u:profile>: .*" + re.escape(said)):
        densities(two(ocean))
