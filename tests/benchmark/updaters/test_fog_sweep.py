"""Fog in metres: lengths in the place of a density, and sweeps that run downward."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from tests.support.fakes import FakeWorld
from tests.support.short_trial import make_plan, rows_of
from uwsim.benchmark.reader import check_benchmark
from uwsim.benchmark.updaters import (
    SceneFogUpdaterSpec,
    bind_updaters,
    blend,
    levels,
    n_levels,
    ramp_level,
    swept_parameters,
)
from uwsim.bus import Node
from uwsim.cli import main
from uwsim.errors import BadSetting
from uwsim.rendering.water import Water, apply_water
from uwsim.results.result_file import load


def lengths(
    first: float, last: float, step: float, quantity: str = "attenuationLength"
) -> SceneFogUpdaterSpec:
    return SceneFogUpdaterSpec(
        initial_value=first, final_value=last, step=step, interval=0.1, quantity=quantity  # type: ignore[arg-type]
    )  # fmt: skip


@pytest.mark.parametrize(
    ("quantity", "left"), [("attenuationLength", 1.0 / math.e), ("visibilityRange", 0.02)]
)
def test_at_a_length_its_share_of_the_contrast_is_left_in_the_renderers_law(
    quantity: str, left: float
) -> None:
    spec = lengths(7.0, 7.0, -1.0, quantity)
    world = FakeWorld()
    spec.bind(world).apply(7.0)
    assert world.fog is not None
    dark = (0.0, 0.0, 0.0)
    water = Water(fog=world.fog, fog_colour=(0.1, 0.2, 0.3), colour=dark, attenuation=dark)
    patches = np.array([[0.8, 0.8, 0.8], [0.3, 0.3, 0.3]])
    seen = apply_water(patches, np.full(2, 7.0), np.zeros(2), water)
    assert (seen[0] - seen[1]) / 0.5 == pytest.approx(left)


def test_a_visibility_range_is_1_98_attenuation_lengths() -> None:
    one = lengths(1.0, 1.0, 1.0).density(1.0)
    other = lengths(1.0, 1.0, 1.0, "visibilityRange").density(1.0)
    assert other / one == pytest.approx(1.97788, abs=1e-5)


def test_a_sweep_of_lengths_runs_downward_and_its_last_value_is_played() -> None:
    assert lengths(10.0, 1.0, -1.0).values() == tuple(float(v) for v in range(10, 0, -1))
    fine = lengths(10.0, 1.0, -0.1).values()
    assert len(fine) == 91
    assert fine[-1] == pytest.approx(1.0)
    assert lengths(10.0, 1.5, -2.0).values() == (10.0, 8.0, 6.0, 4.0, 2.0)


def test_it_runs_upward_too_and_one_level_is_enough() -> None:
    assert lengths(1.0, 2.0, 0.5).values() == (1.0, 1.5, 2.0)
    assert lengths(3.0, 3.0, -1.0).values() == (3.0,)


def test_a_density_is_still_counted_as_the_original_counts() -> None:
    spec = SceneFogUpdaterSpec(initial_value=0.0, final_value=1.3, step=0.05, interval=2.0)
    assert (n_levels(spec), swept_parameters(spec), spec.parameter_unit) == (27, ("fog",), "1/m")
    assert spec.density(0.3) == 0.3


def test_too_many_lengths_are_refused() -> None:
    with pytest.raises(BadSetting, match="From 10 to 1 by steps of -1e-09 there are more than"):
        lengths(10.0, 1.0, -1e-9).values()


def test_an_independent_level_is_ramped_in_from_the_clear() -> None:
    spec = lengths(10.0, 2.0, -4.0)
    world = FakeWorld()
    updaters = bind_updaters(spec, world)
    ramp_level(updaters, blend(spec, levels(spec)[2], 0.5))
    assert world.fog == pytest.approx(1.0 / 6.0)


BENCHMARK = """<benchmark xmlns:u="urn:uwsim:1">
<measures> <time> <name>t</name> </time> </measures>
<startOn> <type>onInit</type> </startOn> <stopOn> <type>never</type> </stopOn>
<function>t</function>
<sceneUpdater>
<sceneFogUpdater {unit}>
  <initialValue>{first}</initialValue>
  <finalValue>{last}</finalValue>
  <step>{step}</step>
  <interval>{interval}</interval>
</sceneFogUpdater>
</sceneUpdater> </benchmark>"""
LENGTH = 'u:unit="attenuationLength"'


@pytest.mark.parametrize(
    ("unit", "first", "last", "step", "interval", "line", "said"),
    [
        ("", 1.0, 0.0, -0.1, 1, 9, "<step> is '-0.1'; expected a number > 0 [1/m]: fog density "
         'increases. A sweep of lengths may decrease: u:unit="attenuationLength" [m]'),
        ("", 1.0, 0.0, 0.1, 1, 8, "<finalValue> 0 is below <initialValue> 1: no level."),
        ("", 0.0, 1.0, 0.0, 1, 9, "<step> is '0'; expected a number > 0"),
        ("", 0.0, 1.0, 0.1, 0, 10, "<interval> is '0'; expected a number > 0 [s]"),
        (LENGTH, 10, 1, -1, 0, 10, "<interval> is '0'; expected a number > 0 [s]"),
        (LENGTH, 10, 1, 1, 1, 9, "<step> 1 points away from <finalValue> 1, as <initialValue> is "
         "10: change its sign"),
        (LENGTH, 1, 10, -1, 1, 9, "<step> -1 points away from <finalValue> 10"),
        (LENGTH, 10, 1, 0, 1, 9, "<step> is 0; expected a length above or below 0 [m]"),
        (LENGTH, 10, 0, -1, 1, 8, "<finalValue> is 0; expected a length > 0 [m]"),
        (LENGTH, 0, 1, 1, 1, 7, "<initialValue> is 0; expected a length > 0 [m]"),
        (LENGTH, 10, 1, -1e-9, 1, 6, "more than 100000 levels"),
        ('u:unit="attenuationLenght"', 10, 1, -1, 1, 6, "Did you mean 'attenuationLength'"),
        ('u:unit="m"', 10, 1, -1, 1, 6, "expected one of 'density', 'attenuationLength'"),
    ],
)  # fmt: skip
def test_what_leads_nowhere_is_an_error_with_its_line_and_advice(
    tmp_path: Path, unit: str, first: float, last: float, step: float, interval: float,
    line: int, said: str,
) -> None:  # fmt: skip
    file = tmp_path / "b.xml"
    values = {"first": first, "last": last, "step": step, "interval": interval}
    file.write_text(BENCHMARK.format(unit=unit, **values))
    found = [(diagnostic.line, diagnostic.message) for diagnostic in check_benchmark(file)[0]]
    assert any(line == where and said in message for where, message in found), found


OTHERS = {
    "sceneLightUpdater": "",
    "cameraNoiseUpdater": "",
    "currentForceUpdater": """
  <sphericalDirection> <theta>0</theta> <phi>0</phi> </sphericalDirection>
  <forceVariation>0</forceVariation> <forcePeriod>4</forcePeriod>
  <directionVariation> <theta>0</theta> <phi>0</phi> </directionVariation>
  <directionPeriod> <theta>4</theta> <phi>30</phi> </directionPeriod>
  <random>0</random> <target>girona500</target>""",
}


@pytest.mark.parametrize("element", OTHERS)
def test_only_lengths_run_downward(tmp_path: Path, element: str) -> None:
    values = {"unit": "", "first": 0.5, "last": 0.1, "step": -0.1, "interval": 1}
    other = BENCHMARK.replace("sceneFogUpdater", element)
    other = other.replace("<interval>", OTHERS[element] + "<interval>")
    file = tmp_path / "b.xml"
    file.write_text(other.format(**values))
    ((line, message),) = [(f.line, f.message) for f in check_benchmark(file)[0]]
    assert line == 9
    assert "<step> is '-0.1'; expected a number > 0" in message
    file.write_text(other.format(**(values | {"step": 0.1})))
    ((line, message),) = [(f.line, f.message) for f in check_benchmark(file)[0]]
    assert line == 8
    assert "<finalValue> 0.1 is below <initialValue> 0.5: no level" in message


class Idle:
    """Does nothing at all."""

    def start(self, node: Node) -> None:
        pass


UPDATER = """<sceneFogUpdater u:unit="attenuationLength">
<initialValue>10</initialValue> <finalValue>1</finalValue> <step>-3</step>
<interval>0.1</interval> </sceneFogUpdater>"""


def test_rows_carry_lengths_and_the_column_its_unit(tmp_path: Path) -> None:
    plan = make_plan(tmp_path, Idle, UPDATER)
    assert [row.values for row in rows_of(plan)] == [
        (("attenuationLength", value),) for value in (10.0, 7.0, 4.0, 1.0)
    ]
    assert str(plan.levels()[3]) == "attenuationLength=1"


@pytest.mark.slow
def test_the_result_has_a_column_in_metres_by_which_levels_are_chosen(tmp_path: Path) -> None:
    make_plan(tmp_path, Idle, UPDATER)
    file, out = tmp_path / "benchmark.xml", tmp_path / "out"
    options = ["--scene", "visibility-scene", "--algorithm", "frozen", "--out", str(out)]
    assert main(["bench", str(file), *options, "--level", "attenuationLength=4"]) == 0
    result = load(out)
    column = result.columns[0]
    assert (column.name, column.kind, column.unit) == ("attenuationLength", "level", "m")
    assert column.label == "attenuationLength [m]"
    assert result.values("attenuationLength") == (4.0,)
