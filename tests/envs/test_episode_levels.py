"""The levels that episodes are drawn from, ``<episodeLevels>``."""

from __future__ import annotations

from pathlib import Path

import pytest

import uwsim
from uwsim.benchmark.environment import EpisodeLevelsSpec, drawn_values
from uwsim.envs.compiled.draws import EpisodeDraws
from uwsim.envs.levels import draw_level
from uwsim.envs.task import EnvironmentOptions, make_task
from uwsim.errors import BadSetting, BenchmarkError
from uwsim.runs.planning.plan import Plan

BENCHMARKS = Path(uwsim.__file__).parent / "data/benchmarks"
LEVELS = "<episodeLevels> <name>current</name> <values>0 0.1 0.2 0.3</values> </episodeLevels>"
SEEDS = range(40)


def plan_of(benchmark: str | Path) -> Plan:
    return make_task(benchmark, EnvironmentOptions(), settings={}, data_path=())


def currents(plan: Plan) -> list[float]:
    """Return the current of each seed, which the engine and rows draw alike."""
    levels = [dict(draw_level(plan.benchmark, seed, {}).values)["current"] for seed in SEEDS]
    if plan.scene.vehicles[0].name == "bluerov2":
        assert EpisodeDraws(plan, 0).draw(SEEDS, {}).levels["current"].tolist() == levels
    return levels


@pytest.mark.parametrize(
    ("benchmark", "greatest", "former_sweep"),
    [
        ("station-keeping", 0.3, ("0.85", "0.35")),
        ("circle", 0.2, ("0.65", "0.25")),
        ("helix", 0.2, ("0.65", "0.25")),
        ("lemniscate", 0.2, ("0.65", "0.25")),
        ("docking", 0.2, ("0.55", "0.25")),
        ("reach", 0.4, ("1", "0.4")),
    ],
)
def test_an_episode_has_the_level_of_the_sweep_that_policies_were_trained_in(
    benchmark: str, greatest: float, former_sweep: tuple[str, str], tmp_path: Path
) -> None:
    values = currents(plan_of(benchmark))
    assert max(values) == pytest.approx(greatest)
    text = (BENCHMARKS / f"{benchmark}.xml").read_text()
    before, _, after = text.partition("    <episodeLevels>")
    old, new = (f"<finalValue>{value}</finalValue>" for value in former_sweep)
    assert before.count(old) == 1
    path = tmp_path / "former.xml"
    before = before.replace(old, new).replace("<step>0.05</step>", "<step>0.1</step>")
    path.write_text(before + after.partition("</episodeLevels>\n")[2])
    assert currents(plan_of(path)) == values


def test_a_reset_may_ask_for_a_level_beyond() -> None:
    plan = plan_of("station-keeping")
    assert draw_level(plan.benchmark, 1, {"current": 0.8}).values == (("current", 0.8),)


def test_the_levels_of_several_vehicles_are_those_of_any_of_them() -> None:
    updater = plan_of("station-keeping").benchmark.scene_updater
    low, high = (EpisodeLevelsSpec(name="current", values=(x, x + 0.1)) for x in (0.0, 0.3))
    assert drawn_values(updater, [low, high])["current"] == pytest.approx((0.0, 0.1, 0.3, 0.4))
    assert len(drawn_values(updater, [])["current"]) == 17


@pytest.mark.parametrize(
    ("new_levels", "message"),
    [
        (LEVELS.replace("current", "curent"), r"names 'curent'\. Did you mean 'current'"),
        (LEVELS.replace("0.2", "0.26"), r"0\.26 is not a level of 'current'; the nearest is 0\.25"),
        (LEVELS.replace("0.3", "x"), "<values>"),
        (LEVELS + LEVELS, "two <episodeLevels> have the name 'current'"),
    ],
)
def test_a_wrong_selection_is_named_with_its_line(
    new_levels: str, message: str, tmp_path: Path
) -> None:
    text = (BENCHMARKS / "station-keeping.xml").read_text()
    line = text.partition("<episodeLevels>")[0].count("\n") + 1
    path = tmp_path / "wrong.xml"
    path.write_text(text.replace(LEVELS, new_levels))
    with pytest.raises((BenchmarkError, BadSetting), match=rf"wrong\.xml:{line}: .*{message}"):
        plan_of(path)
