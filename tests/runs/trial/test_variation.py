"""What a seed changes: drawn values in the bundled benchmarks, their results, their reports."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.support.fakes import FakeWorld
from tests.support.opened import open_scene
from tests.support.short_benchmark import run
from tests.support.short_trial import DATA
from uwsim.analysis.report import write_report
from uwsim.benchmark.ground_truth import CornersFromCamera, FaceCorners
from uwsim.benchmark.reader import check_benchmark, read_benchmark
from uwsim.benchmark.updater_settings import benchmark_of_seed, updater_draws
from uwsim.benchmark.updaters import CurrentForceUpdaterSpec
from uwsim.cli import main
from uwsim.errors import ResultError, SeveralErrors, UwsimError
from uwsim.results.result_file import dumps, load, loads
from uwsim.runs.planning.make_plan import make_plan
from uwsim.runs.planning.plan_request import PlanRequest
from uwsim.scene.reader import read_scene

BENCHMARKS = DATA / "benchmarks"


def plan_of(name: str, *settings: str, seed: int = 1, repeat: int = 3):  # type: ignore[no-untyped-def]
    return make_plan(PlanRequest(benchmark=name, seed=seed, repeat=repeat,
        settings=list(settings)))  # fmt: skip


@pytest.mark.parametrize(
    ("name", "kinds"),
    [
        ("visibility-moving", {"vehicle[girona500]", "object[blackbox]"}),
        ("currents", {"vehicle[girona500]", "object[blackbox]", "currentForceUpdater"}),
    ],
)
def test_a_seed_changes_more_than_noise(name: str, kinds: set[str]) -> None:
    plan = plan_of(name)
    one, two = plan.draws(1), plan.draws(2)
    assert {draw.path.partition(".")[0] for draw in one} == kinds
    assert any("weathering.pattern" in draw.path for draw in one)
    assert all(a.path == b.path and a.value != b.value for a, b in zip(one, two, strict=True))
    assert plan.draws(1) == one


def test_the_paper_s_benchmark_has_one_scene_for_all_seeds() -> None:
    assert plan_of("visibility").draws(1) == ()


def test_a_setting_fixes_what_would_vary() -> None:
    fixed = plan_of("currents", "currentForceUpdater.timeOffset=7", "vehicle.position=3 1.5 1.515")
    paths = {draw.path for draw in fixed.draws(1)}
    assert paths == {
        "object[blackbox].orientation.y", "object[blackbox].weathering.pattern"
    }  # fmt: skip
    for seed in (1, 2):
        updater = benchmark_of_seed(fixed.benchmark, seed).scene_updater
        assert isinstance(updater, CurrentForceUpdaterSpec)
        assert updater.time_offset == 7.0


def test_what_decides_the_levels_cannot_be_set_or_vary(tmp_path: Path) -> None:
    with pytest.raises(UwsimError, match="it determines the levels or their duration"):
        plan_of("currents", "currentForceUpdater.interval=5")
    text = (BENCHMARKS / "currents.xml").read_text()
    for path, said in (
        ("currentForceUpdater.finalValue", "it determines the levels or their duration"),
        ("currentForceUpdater.timeOfset", "there is no <timeOfset>. Did you mean 'timeOffset'?"),
        ("currentForceUpdater.target", "it is text; only a number can vary"),
        ("sceneFogUpdater.step", "the benchmark has no updater <sceneFogUpdater>"),
    ):
        file = tmp_path / "b.xml"
        file.write_text(text.replace("currentForceUpdater.timeOffset", path))
        [diagnostic] = [each for each in check_benchmark(file)[0] if each.severity == "error"]
        assert said in diagnostic.message
        assert "<u:uniform>" in file.read_text().split("\n")[(diagnostic.line or 0) - 1]


def test_a_nested_updater_is_found_by_its_element(tmp_path: Path) -> None:
    text = (BENCHMARKS / "currents.xml").read_text()
    outer = "<repeat> <iterations>2</iterations> <interval>1</interval> <sceneUpdater>"
    text = text.replace("<sceneUpdater>", f"<sceneUpdater> {outer}")
    text = text.replace("</sceneUpdater>", "</sceneUpdater> </repeat> </sceneUpdater>")
    file = tmp_path / "b.xml"
    file.write_text(text)
    spec = read_benchmark(file)
    [draw] = updater_draws(spec, 4)
    inner = benchmark_of_seed(spec, 4).scene_updater.child
    assert isinstance(inner, CurrentForceUpdaterSpec)
    assert inner.time_offset == draw.value
    assert draw == updater_draws(read_benchmark(BENCHMARKS / "currents.xml"), 4)[0]


def test_a_time_offset_is_where_swell_and_swing_begin() -> None:
    updater = read_benchmark(BENCHMARKS / "currents.xml").scene_updater
    assert isinstance(updater, CurrentForceUpdaterSpec)
    world = FakeWorld(vehicles=("girona500",))
    replace(updater, random=0.0, time_offset=7.5).bind(world).begin(0.2)
    assert world.current is not None
    flow = world.current.velocity(np.zeros((1, 3)), 0.0)[0]
    speed = 0.2 + 0.005 * math.sin(2 * math.pi * 7.5 / 4.0)
    assert flow[:2] == pytest.approx([-speed * math.sin(0.7), speed * math.cos(0.7)])


@pytest.mark.slow
def test_whatever_the_seed_the_target_is_seen_as_a_whole() -> None:
    scene = read_scene(DATA / "scenes" / "visibility-moving-scene.xml")
    for seed in range(40):
        simulation = open_scene(scene, seed=seed, is_blind=True)
        camera, body = (
            simulation.world.sensors.camera("bowtech1"),
            simulation.world.bodies.find("blackbox"),
        )
        truths = [FaceCorners(camera, body), CornersFromCamera(camera, body)]
        before = None
        for step in range(2000):  # prelude, ramp and level
            if step % 17 == 0:
                corners = np.array([truth.read() for truth in truths]).reshape(-1, 2)
                assert (corners > 5.0).all(), seed
                assert (corners < [315.0, 235.0]).all(), seed
                assert before is None or np.abs(corners - before).max() < 3.0, seed  # no renaming
                before = corners
            simulation.advance()
        simulation.close()


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The clear level of `visibility-moving`, three seeds, by the control."""
    out = tmp_path_factory.mktemp("moving") / "r"
    run(
        Path("visibility-moving"), out, algorithm="frozen", repeat=3, levels=["fog=0"],
        settings=["vehicle.virtualCamera.resw=64", "vehicle.virtualCamera.resh=48"],
    )  # fmt: skip
    return out


def test_the_control_scores_otherwise_under_each_seed(played: Path) -> None:
    totals = load(played).numbers("total")
    assert len(set(totals)) == 3


def test_a_result_says_what_was_drawn(played: Path) -> None:
    result = load(played)
    draws = {each.path: each for each in result.variations}
    x = draws["vehicle[girona500].position.x"]
    assert (x.unit, x.drawn_from) == ("m", "uniform 1.95 to 2.05")
    assert [seed for seed, _ in x.values] == [1, 2, 3]
    assert all(1.95 <= value <= 2.05 for _, value in x.values)
    floor = result.fact("floor_cornersFace")
    assert floor is not None
    assert floor[0] < 1e-6  # a perfect tracker scores 0
    written = json.loads((played / "result.json").read_text())["variations"]
    assert written[0]["values"][0] == [1, x.values[0][1]]
    assert loads(dumps(result)) == result


def test_a_result_without_variations_is_written_as_ever_and_read(played: Path) -> None:
    result = replace(load(played), variations=())
    text = dumps(result)
    assert '"variations"' not in text
    assert loads(text) == result


def test_damaged_draws_are_refused(played: Path) -> None:
    text = (played / "result.json").read_text()
    for wrong in ("[1, null]", '[1, "a"]', "[1]", '["1", 2.0]', "[1, 2, 3]"):
        found = json.loads(text)
        found["variations"][0]["values"][0] = json.loads(wrong)
        with pytest.raises(ResultError, match=r"variations\[0\]"):
            loads(json.dumps(found))


def test_the_report_says_what_the_seed_changes(played: Path) -> None:
    page = write_report(played).read_text()
    assert "What the seed changes" in page
    assert "vehicle[girona500].sway[x].phase" in page
    assert "uniform 1.95 to 2.05 m" in page


@pytest.mark.slow
def test_render_shows_the_scene_of_the_seed(tmp_path: Path) -> None:
    images = []
    for seed, *others in ((1,), (2,), (1, "--set", "object[blackbox].position.x=2.4")):
        out = tmp_path / "view.png"
        words = ["--camera", "bowtech1", "-o", str(out), "--segmentation", "--seed", str(seed)]
        small = ["--set", "vehicle.virtualCamera.std=0"]
        assert main(["render", "visibility-moving-scene", *words, *small, *map(str, others)]) == 0
        images.append((tmp_path / "view-ids.png").read_bytes())
    assert len(set(images)) == 3


def test_a_misspelt_setting_of_an_updater_names_the_right_one() -> None:
    with pytest.raises((UwsimError, SeveralErrors), match="Did you mean 'timeOffset'"):
        plan_of("currents", "currentForceUpdater.timeOfset=7")
