"""Currents in a scene file: read, written back, added up."""

from __future__ import annotations

import inspect
import re
import sys
from pathlib import Path

import numpy as np
import pytest

from uwsim.base.rng import stream
from uwsim.checks import check_file
from uwsim.currents import (
    CURRENTS,
    Constant,
    ConstantSpec,
    GaussMarkovSpec,
    SceneContext,
    TotalCurrent,
    UwsimSinusoidSpec,
    bind_currents,
)
from uwsim.errors import SceneError
from uwsim.scene.reader import read_scene
from uwsim.schema import fields_of
from uwsim.world import Flow

POINTS = np.array([[0.0, 0.0, 1.0], [5.0, 2.0, 3.0]])


def scene(folder: Path, inside: str) -> Path:
    path = folder / "scene.xml"
    path.write_text(
        '<UWSimScene xmlns:u="urn:uwsim:1"><oceanState><u:current>'
        f"{inside}</u:current></oceanState></UWSimScene>"
    )
    return path


def context(seed: int = 0) -> SceneContext:
    return SceneContext(stream=lambda name: stream(seed, name))


def test_a_scene_may_hold_several_currents_in_any_order(tmp_path: Path) -> None:
    path = scene(
        tmp_path,
        "<u:uwsimSinusoid><u:speed>0.2</u:speed></u:uwsimSinusoid>"
        "<u:constant><u:velocity><x>1</x><y>0</y><z>0</z></u:velocity></u:constant>",
    )
    assert read_scene(path).ocean_state.currents == (
        UwsimSinusoidSpec(speed=0.2),
        ConstantSpec(velocity=(1.0, 0.0, 0.0)),
    )
    assert "comes after" not in str(check_file(path, is_strict=True))


def test_a_misspelt_current_is_an_error_that_names_the_right_one(tmp_path: Path) -> None:
    path = scene(tmp_path, "<u:gausMarkov/>")
    with pytest.raises(SceneError, match="Did you mean u:gaussMarkov"):
        read_scene(path)


def test_a_scene_without_currents_has_still_water(tmp_path: Path) -> None:
    total = bind_currents(read_scene(scene(tmp_path, "")).ocean_state.currents, context())
    assert (total.velocity(POINTS, 3.0) == 0.0).all()
    assert (total.acceleration(POINTS, 3.0) == 0.0).all()


def test_velocities_and_accelerations_of_several_add_up() -> None:
    specs = (ConstantSpec(velocity=(0.1, 0.0, 0.0)), ConstantSpec(velocity=(0.0, 0.2, 0.0)))
    assert bind_currents(specs, context()).velocity(POINTS, 0.0).tolist() == [[0.1, 0.2, 0.0]] * 2
    swelling = UwsimSinusoidSpec(speed=0.0, speed_variation=1.0, speed_period=4.0).bind(context())
    both = TotalCurrent([swelling, swelling])
    assert both.acceleration(POINTS, 0.0) == pytest.approx(2 * swelling.acceleration(POINTS, 0.0))


def test_two_currents_of_a_kind_do_not_share_their_chance() -> None:
    spec = GaussMarkovSpec(deviation=(0.1, 0.1, 0.1), mu=0.1)
    one = bind_currents((spec,), context()).velocity(POINTS, 5.0)
    two = bind_currents((spec, spec), context()).velocity(POINTS, 5.0)
    assert two != pytest.approx(2.0 * one)
    assert bind_currents((spec, spec), context()).velocity(POINTS, 5.0).tolist() == two.tolist()


def test_every_current_is_a_flow_and_hands_out_its_own_array() -> None:
    flow: Flow = Constant((0.1, 0.0, 0.0))
    flow.velocity(POINTS, 0.0)[:] = 7.0
    assert flow.velocity(POINTS, 0.0)[0].tolist() == [0.1, 0.0, 0.0]


@pytest.mark.parametrize("spec", CURRENTS.values(), ids=lambda spec: spec.__name__)
def test_every_field_of_a_current_is_an_extension_and_says_what_it_is(spec: type) -> None:
    assert [
        field.name for field in fields_of(spec) if not field.xml.namespaced or not field.doc
    ] == []


PAGE = Path(__file__).parents[2] / "docs" / "currents.md"
BLOCKS = re.findall(r"```xml\n(.*?)```", PAGE.read_text(), re.DOTALL)


@pytest.mark.parametrize("block", [block for block in BLOCKS if "<oceanState>" in block])
def test_the_scenes_of_the_page_can_be_read(block: str, tmp_path: Path) -> None:
    path = tmp_path / "scene.xml"
    path.write_text(f'<UWSimScene xmlns:u="urn:uwsim:1">{block}</UWSimScene>')
    assert read_scene(path).ocean_state.currents != ()


def test_the_page_names_every_current() -> None:
    page = PAGE.read_text()
    assert [name for name in CURRENTS if f"| `u:{name}` |" not in page] == []


@pytest.mark.parametrize("name", CURRENTS)
def test_the_example_of_every_current_is_one(name: str, tmp_path: Path) -> None:
    doc = sys.modules[CURRENTS[name].__module__].__doc__ or ""
    block = re.search(r"code-block:: xml\n\n((?:    .*\n|\n)+)", doc)
    assert block is not None
    specs = read_scene(scene(tmp_path, inspect.cleandoc(block[1]))).ocean_state.currents
    assert CURRENTS[name] in {type(spec) for spec in specs}


@pytest.mark.parametrize(
    ("inside", "said"),
    [
        (
            "<u:gaussMarkov> <u:deviation><x>-0.1</x><y>0</y><z>0</z></u:deviation>"
            "<u:mu>1</u:mu></u:gaussMarkov>",
            "<x> of <u:deviation> is '-0.1'; expected a number >= 0 and <= 100",
        ),
        (
            "<u:gaussMarkov> <u:deviation><x>1</x><y>0</y><z>0</z></u:deviation>"
            "<u:mu>1</u:mu><u:step>1e-9</u:step></u:gaussMarkov>",
            "<u:step> is '1e-9'; expected a number >= 0.001",
        ),
        (
            "<u:constant><u:velocity><x>0</x><y>1e8</y><z>0</z></u:velocity></u:constant>",
            "<y> of <u:velocity> is '1e8'; expected a number >= -100 and <= 100 [m/s]",
        ),
        ("<u:uwsimSinusoid><u:speed>101</u:speed></u:uwsimSinusoid>", "<u:speed> is '101'"),
        (
            "<u:uwsimSinusoid><u:speed>1</u:speed><u:speedPeriod>1e-9</u:speedPeriod>"
            "</u:uwsimSinusoid>",
            "<u:speedPeriod> is '1e-9'; expected a number >= 0.01 [s]",
        ),
        (
            "<u:layers><u:layer><u:depth>0</u:depth><u:velocity><x>0</x><y>0</y><z>-200</z>"
            "</u:velocity></u:layer></u:layers>",
            "<z> of <u:velocity> is '-200'",
        ),
        (
            "<u:tidal><u:constituent><u:name>M2</u:name><u:semiMajor>400</u:semiMajor>"
            "</u:constituent></u:tidal>",
            "<u:semiMajor> is '400'; expected a number >= 0 and <= 100 [m/s]",
        ),
    ],
)
def test_water_that_cannot_move_so_is_refused(inside: str, said: str, tmp_path: Path) -> None:
    (diagnostic,) = [
        each for each in check_file(scene(tmp_path, inside)) if each.severity == "error"
    ]
    assert said in diagnostic.message
