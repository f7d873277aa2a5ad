"""``--set PATH=VALUE``."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

import pytest

from uwsim.errors import BadSetting
from uwsim.scene.object import ObjectSpec
from uwsim.scene.settings import apply_setting
from uwsim.scene.spec import SceneSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.schema import element
from uwsim.sensors.virtual_camera import VirtualCameraSpec

Triple = tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class LampSpec:
    name: str
    power: float = element(default=1.0, minimum=0)
    """How bright it is [W]."""
    colour: Triple = element(default=(1.0, 1.0, 1.0), parts="rgb")


@dataclass(frozen=True, kw_only=True)
class BellSpec:
    text: str = element(text=True, default="")


@dataclass(frozen=True, kw_only=True)
class HullSpec:
    length: float = 2.0
    is_wet: bool = True
    decks: int = 1
    buried: float = element(attribute=True, default=0.0)
    kind: Literal["steel", "wood"] = "steel"
    law: str | None = element(namespaced=True, default=None)


@dataclass(frozen=True, kw_only=True)
class BoatSpec:
    hull: HullSpec = element(default=HullSpec())
    keel: HullSpec | None = None
    lamps: tuple[LampSpec, ...] = element("lamp", default=())
    joint_values: tuple[float, ...] = element(item="joint", default=())
    fittings: tuple[object, ...] = element(choice={"lamp": LampSpec, "bell": BellSpec}, default=())


BOAT = BoatSpec(
    lamps=(LampSpec(name="bow"), LampSpec(name="stern")),
    fittings=(BellSpec(), LampSpec(name="mast")),
)


def with_set(*texts: str, boat: BoatSpec = BOAT) -> BoatSpec:
    for text in texts:
        path, _, value = text.partition("=")
        boat = apply_setting(boat, path, value)
    return boat


def test_a_value_is_set_and_everything_else_stays() -> None:
    boat = with_set("hull.length=3.5")
    assert boat.hull.length == 3.5
    assert boat.lamps == BOAT.lamps
    assert BOAT.hull.length == 2.0


@pytest.mark.parametrize(
    ("setting", "field", "value"),
    [
        ("hull.isWet=0", "is_wet", False),
        ("hull.decks=3", "decks", 3),
        ("hull.buried=0.25", "buried", 0.25),
        ("hull.kind=wood", "kind", "wood"),
        ("hull.u:law=physical", "law", "physical"),
        ("hull.law=physical", "law", "physical"),
        ("hull.length=M_PI_2", "length", 1.5707963267948966),
        ("hull.length= 1e-3 ", "length", 1e-3),
    ],
)
def test_every_kind_of_value_can_be_set(setting: str, field: str, value: object) -> None:
    assert getattr(with_set(setting).hull, field) == value


def test_a_name_in_brackets_chooses_among_equals() -> None:
    boat = with_set("lamp[stern].power=5")
    assert [lamp.power for lamp in boat.lamps] == [1.0, 5.0]


def test_the_name_may_be_left_out_where_there_is_only_one() -> None:
    boat = with_set("lamp.power=5", boat=BoatSpec(lamps=(LampSpec(name="bow"),)))
    assert boat.lamps[0].power == 5.0


def test_one_of_a_choice_is_found_by_its_element_and_name() -> None:
    boat = with_set("fittings.lamp[mast].power=7", "fittings.bell.text=dong")
    assert boat.fittings == (BellSpec(text="dong"), LampSpec(name="mast", power=7.0))


def test_three_numbers_are_set_together_or_by_letter() -> None:
    assert with_set("lamp[bow].colour=0.1, 0.2 0.3").lamps[0].colour == (0.1, 0.2, 0.3)
    assert with_set("lamp[bow].colour.g=0.2").lamps[0].colour == (1.0, 0.2, 1.0)


def test_a_list_is_set_as_a_whole() -> None:
    assert with_set("jointValues=0 0 2.2 -M_PI").joint_values[2:] == (2.2, -3.141592653589793)


def test_settings_are_applied_in_order() -> None:
    assert with_set("hull.length=3", "hull.length=4").hull.length == 4.0


@pytest.mark.parametrize(
    ("setting", "said"),
    [
        ("hull.lenght=3", "there is no <lenght>. Did you mean 'length'?"),
        ("hull=3", "<hull> is not a value; its parts are length, isWet, decks"),
        ("hull[a].length=3", "<hull> occurs once"),
        ("hull.length=long", "<length> is 'long'; expected a number"),
        ("hull.length.x=1", "<length> is a value"),
        ("hull.length=nan", "expected a number"),
        ("hull.length=", "<length>"),
        ("hull.isWet=yes", "expected 0 or 1"),
        ("hull.kind=stel", "Did you mean 'steel'?"),
        ("keel.length=3", "the file has no <keel> here"),
        ("lamp.power=3", "the file has 2 <lamp>; choose one: lamp[bow], lamp[stern]."),
        ("lamp[sten].power=3", "Did you mean 'stern'?"),
        ("lamp[bow]=3", "<lamp> is not a value"),
        ("lamp[bow].power=-3", "expected a number >= 0 [W]"),
        ("lamp[bow].colour=1 2", "needs 3 numbers"),
        ("lamp[bow].colour.z=1", "<colour> has <r>, <g>, <b>"),
        ("fittings.horn.power=3", "No element of <fittings> is called 'horn'"),
        ("fittings=3", "cannot be set from here"),
        ("hull..length=3", "not a path"),
        ("hull.length.=3", "not a path"),
        ("=3", "not a path"),
    ],
)
def test_a_setting_that_leads_nowhere_says_what_would_be_right(setting: str, said: str) -> None:
    with pytest.raises(BadSetting) as caught:
        with_set(setting)
    assert said in str(caught.value)


@pytest.mark.parametrize(
    ("setting", "said"),
    [
        ("oceanState.fog.density=-1", "expected a number >= 0 and <= 1e+06 [1/m]"),
        ("vehicle.virtualCamera.std=1e308", "expected a number >= 0 and <= 10"),
        ("object.position=1e300 0 0", "expected a number >= -1e+06 and <= 1e+06 [m]"),
        ("object.scaleFactor=0 1 1", "expected a number >= 1e-06 and <= 1e+06"),
        ("vehicle.orientation=1e300 0 0", "no quantity is beyond 1e+09"),
    ],
)
def test_extreme_numbers_are_refused_on_the_command_line_too(setting: str, said: str) -> None:
    scene = SceneSpec(
        vehicles=(
            VehicleSpec(
                name="v",
                file="v.urdf",
                parts=(VirtualCameraSpec(name="c", relative_to="base"),),
            ),
        ),
        objects=(ObjectSpec(name="o", file="o.obj"),),
    )
    path, _, value = setting.partition("=")
    with pytest.raises(BadSetting, match=re.escape(said)):
        apply_setting(scene, path, value)
