"""Whole runs of a short benchmark: a black box, fog in three levels of 0.2 s, small images."""

import inspect
import json
import re
from pathlib import Path

import pytest

from tests.support import failing
from tests.support.short_benchmark import fingerprint, run, write_benchmark
from uwsim.analysis.comparison import compare, differences, read_entries, shared_column
from uwsim.errors import BadSetting, NeverStarted
from uwsim.results.result_file import load
from uwsim.simulation import describe_failure


@pytest.fixture
def benchmark(tmp_path: Path) -> Path:
    return write_benchmark(tmp_path, "0.2")


@pytest.fixture(scope="module")
def esm(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The result of esm with seed 1, to be read."""
    folder = tmp_path_factory.mktemp("esm")
    result = run(write_benchmark(folder, "0.2"), folder / "a")
    assert load(folder / "a") == result
    return folder / "a"


ALGORITHMS = "tests.runs.trial.algorithms"


def test_two_runs_with_one_seed_are_the_same_bytes(
    esm: Path, benchmark: Path, tmp_path: Path
) -> None:
    run(benchmark, tmp_path / "b")
    assert fingerprint(esm) == fingerprint(tmp_path / "b")
    assert {"result.json", "result.dat", "measure-corners.csv"} <= set(fingerprint(esm))


def test_another_seed_gives_other_images_and_other_scores(
    esm: Path, benchmark: Path, tmp_path: Path
) -> None:
    one, two = load(esm), run(benchmark, tmp_path / "b", seed=2)
    assert one.image_streams[0].sha256 != two.image_streams[0].sha256
    assert one.values("corners") != two.values("corners")


def test_the_same_seed_shows_every_algorithm_the_same_images(
    esm: Path, benchmark: Path, tmp_path: Path
) -> None:
    others = [run(benchmark, tmp_path / name, algorithm=name) for name in ("orb", "frozen")]
    results = [load(esm), *others]
    streams = {(r.image_streams[0].frames, r.image_streams[0].sha256) for r in results}
    assert len(streams) == 1
    assert results[0].image_streams[0].frames == 19  # at 0, 1/30, ... 0.6 s


def test_a_benchmark_has_a_row_for_each_level_with_all_cells(esm: Path) -> None:
    result = load(esm)
    assert result.values("fog") == (0.0, 0.4, 0.8)
    assert result.values("status") == ("ok", "ok", "ok")
    assert result.values("ended_at") == (0.2, 0.4, 0.6000000000000001)
    corners, total = result.numbers("corners"), result.numbers("total")
    assert all(c is not None and 0.0 < c < 1.0 for c in corners)
    assert total == tuple(2 * c for c in corners if c is not None)
    assert result.values("corners.n") == (6.0, 6.0, 6.0)


@pytest.mark.slow
def test_repeats_have_a_summary_and_pair_with_those_of_another_algorithm(
    benchmark: Path, tmp_path: Path
) -> None:
    for name in ("esm", "frozen"):
        run(benchmark, tmp_path / name, algorithm=name, repeat=2, levels=["fog=0.4"])
    lines = (tmp_path / "esm" / "summary.csv").read_text().splitlines()
    assert [line.split(",")[:4] for line in lines[1:3]] == [
        ["0.4", "total", "", "2"],
        ["0.4", "corners", "px", "2"],
    ]
    assert lines[1].endswith(",1 2")
    found = read_entries([tmp_path / "esm", tmp_path / "frozen"])
    assert differences(found) == ()
    (versus,) = compare(found, shared_column(found, None)).pairs
    assert [at.seeds for at in versus.levels] == [(1, 2)]
    assert versus.same_images == (2, 2)


@pytest.mark.slow
def test_a_level_alone_is_the_level_within_the_sweep(benchmark: Path, tmp_path: Path) -> None:
    sweep = run(benchmark, tmp_path / "a", mode="independent")
    alone = run(benchmark, tmp_path / "b", mode="independent", levels=["fog=0.8"])
    assert alone.values("fog") == (0.8,)
    assert alone.values("corners") == sweep.values("corners")[2:]
    assert sweep.values("ended_at") == (0.2, 0.2, 0.2)  # from the start of each level
    assert alone.values("ended_at") == (0.2,)
    assert alone.image_streams[0].sha256 == sweep.image_streams[2].sha256


def test_a_level_that_the_sweep_does_not_have_names_the_nearest(
    benchmark: Path, tmp_path: Path
) -> None:
    with pytest.raises(BadSetting, match=r"nearest is 0\.4"):
        run(benchmark, tmp_path / "a", levels=["fog=0.5"])


def test_an_algorithm_that_never_starts_the_benchmark_stops_it(
    benchmark: Path, tmp_path: Path
) -> None:
    with pytest.raises(NeverStarted, match="10 s of simulation time"):
        run(benchmark, tmp_path / "a", algorithm="tests.support.failing:NeverStarted")
    assert load(tmp_path / "a").rows == ()


def test_an_algorithm_that_raises_fails_its_rows_and_no_other_measure(
    benchmark: Path, tmp_path: Path
) -> None:
    result = run(benchmark, tmp_path / "a", algorithm="tests.support.failing:RaisedError")
    assert result.values("status") == ("algorithm error",) * 3
    assert result.values("corners") == (None,) * 3
    assert result.values("total") == (None,) * 3
    assert result.numbers("taskTime") == pytest.approx((0.2, 0.2, 0.2))
    line = inspect.getsource(failing).split("no focus")[0].count("\n") + 1
    raised = (
        "tests.support.failing:RaisedError raised at 0.1 s: "
        f"failing.py:{line}: ZeroDivisionError: no focus"
    )
    assert result.reason(0, "corners") == raised


def test_an_error_of_a_library_is_put_on_the_line_of_the_algorithm_that_called_it() -> None:
    try:
        failing.RaisedError().start(None)  # type: ignore[arg-type]
    except AttributeError as error:
        said = describe_failure(error, failing.RaisedError)
    assert re.fullmatch(r"failing\.py:\d+: AttributeError: 'NoneType' .*", said)
    try:
        json.loads("{")
    except ValueError as error:
        said = describe_failure(error, failing.RaisedError)
    assert re.match(r"decoder\.py:\d+: JSONDecodeError: ", said)


def test_an_algorithm_that_reports_its_failure_has_failed(benchmark: Path, tmp_path: Path) -> None:
    result = run(benchmark, tmp_path / "a", algorithm="tests.support.failing:ReportedFailure")
    assert result.values("status")[0] == "algorithm error"
    assert "no template" in str(result.reason(0, "corners"))


def test_silence_for_more_than_a_second_is_a_timeout(tmp_path: Path) -> None:
    result = run(
        write_benchmark(tmp_path, "1.2"),
        tmp_path / "a",
        algorithm="tests.support.failing:NoPublication",
        levels=["fog=0"],
        in_process=True,
    )
    assert result.values("status") == ("timeout",)
    assert "no estimate" in str(result.reason(0, "corners"))


def test_the_last_estimate_received_is_valid_in_the_original(tmp_path: Path) -> None:
    """However old it is: section 3 of the paper."""
    spoke = ["fog=0"]
    file = write_benchmark(tmp_path, "1.6")
    for compat, status in (([], "timeout"), (["last-norm"], "ok")):
        out = tmp_path / status
        result = run(
            file,
            out,
            algorithm=f"{ALGORITHMS}:SpeaksOnce",
            levels=spoke,
            compat=compat,
            in_process=True,
        )
        assert result.values("status") == (status,)
    assert result.numbers("corners") == pytest.approx([0.0], abs=1e-4)
    never = run(
        file,
        tmp_path / "never",
        algorithm="tests.support.failing:NoPublication",
        levels=spoke,
        compat=["last-norm"],
        in_process=True,
    )
    assert never.values("status") == ("timeout",)


def test_latency_shows_in_what_is_scored(benchmark: Path, tmp_path: Path) -> None:
    result = run(
        benchmark,
        tmp_path / "a",
        algorithm=f"{ALGORITHMS}:Counts",
        settings=["algorithm.latency_s=0.1"],
        levels=["fog=0"],
        in_process=True,
    )
    assert result.values("corners.n") == (3.0,)  # of the images at 1/30 ... 0.2 s, three by 0.2 s


def test_only_a_tracker_that_compares_by_zncc_has_a_predicted_loss(
    esm: Path, benchmark: Path, tmp_path: Path
) -> None:
    predicted = {"z", "f_star", "f_star_grey"}
    assert predicted <= set(load(esm).facts)
    frozen = run(benchmark, tmp_path / "a", algorithm="frozen", levels=["fog=0"])
    assert not predicted & set(frozen.facts)
    assert {"S", "sigma", "d"} <= set(frozen.facts)


def test_a_setting_of_the_scene_reaches_the_camera(benchmark: Path, tmp_path: Path) -> None:
    path = "vehicle[girona500].virtualCamera[bowtech1].std=0"
    quiet = run(benchmark, tmp_path / "a", settings=[path], levels=["fog=0"])
    assert json.loads((tmp_path / "a" / "result.json").read_text())["run"]["settings"]
    assert max(v for v in quiet.numbers("corners") if v is not None) < 0.01


def test_an_algorithm_that_calls_exit_fails_alone(benchmark: Path, tmp_path: Path) -> None:
    result = run(benchmark, tmp_path / "a", algorithm=f"{ALGORITHMS}:Leaves", levels=["fog=0"])
    assert result.values("status") == ("algorithm error",)
    assert "SystemExit" in str(result.reason(0, "corners"))


@pytest.mark.slow
def test_a_level_alone_ends_when_the_algorithm_has_failed(benchmark: Path, tmp_path: Path) -> None:
    result = run(benchmark, tmp_path / "a", algorithm=f"{ALGORITHMS}:Leaves", mode="independent")
    assert result.values("status") == ("algorithm error",) * 3
    assert max(result.numbers("taskTime")) < 0.15  # of 0.2 s


def test_what_an_algorithm_says_is_one_printable_line(benchmark: Path, tmp_path: Path) -> None:
    result = run(
        benchmark,
        tmp_path / "a",
        algorithm=f"{ALGORITHMS}:Shouts",
        levels=["fog=0"],
        in_process=True,
    )
    why = str(result.reason(0, "corners"))
    assert why.isprintable()
    assert r"\x1b[31mred\nnext" in why


def test_an_algorithm_that_cannot_be_made_is_named(benchmark: Path, tmp_path: Path) -> None:
    with pytest.raises(NeverStarted, match=r"Unmakeable.*cannot be made: TypeError"):
        run(benchmark, tmp_path / "a", algorithm=f"{ALGORITHMS}:Unmakeable")


@pytest.mark.parametrize("latency", ["-1", "soon"])
def test_a_latency_that_is_no_time_is_refused_before_anything_is_written(
    benchmark: Path, tmp_path: Path, latency: str
) -> None:
    with pytest.raises(BadSetting, match="latency_s"):
        run(benchmark, tmp_path / "a", settings=[f"algorithm.latency_s={latency}"])
    assert not (tmp_path / "a").exists()
