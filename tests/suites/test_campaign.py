"""An entry runs all tasks; run again or in shards, it has the same bytes."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path

import pytest

from tests.support.short_benchmark import fingerprint
from tests.support.small_suite import run_suite
from uwsim.cli import main
from uwsim.results.result_file import load
from uwsim.suites.submission import load_submission
from uwsim.suites.suite import Suite

TASKS = ("near-v1", "far-v1")
READS_TRUTH = """
from uwsim.messages import Odometry

class ReadsTruth:
    def start(self, node):
        node.subscribe("/bluerov2/odom", Odometry, lambda message: None)
"""

MISSPELLS = """
from uwsim.messages import Odometry, TwistStamped

class Misspells:
    def start(self, node):
        node.publisher("/bluerov/twist", TwistStamped)
        node.subscribe("/bluerov2/odom", Odometry, lambda message: None)
"""


def prints(entry: Path) -> list[dict[str, str]]:
    return [fingerprint(entry / task) for task in TASKS]


def test_a_submission_lists_its_results_and_conditions(entries: Path, suite: Suite) -> None:
    submission = load_submission(entries / "nothing")
    assert (submission.suite, submission.suite_hash) == ("small", suite.sha256)
    assert (submission.seeds.split, submission.seeds.first, submission.seeds.count) == (
        "validation",
        0,
        3,
    )
    task = submission.tasks["near-v1"]
    assert (task.algorithm, task.n_trials) == ("nothing", 6)
    assert task.n_ok == load(entries / "nothing" / "near-v1").values("status").count("ok")
    assert 0 < task.n_ok < 6
    assert submission.cpu_s > 0.0
    assert submission.compute["class"] == "cpu"


def test_an_entry_that_is_run_again_keeps_its_rows_and_its_cpu_time(
    entries: Path, small_suite: Path
) -> None:
    entry = entries / "position-p"
    before = (entry / "submission.json").read_bytes(), prints(entry)
    (entry / "near-v1" / "result.json").unlink()
    run_suite(small_suite, entry, "--algorithm", "position-p", "--seeds", "3")
    assert ((entry / "submission.json").read_bytes(), prints(entry)) == before


def test_an_entry_with_other_seeds_is_not_mixed_with_it(
    entries: Path, small_suite: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["--algorithm", "position-p", "--seeds", "2", "--workers", "0"]
    entry = entries / "position-p"
    assert main(["suite", "run", str(small_suite), *words, "--out", str(entry)]) != 0
    assert "repeats" in capsys.readouterr().err


@pytest.mark.slow
def test_shards_of_an_entry_give_the_bytes_of_one_run(
    entries: Path, small_suite: Path, tmp_path: Path
) -> None:
    words = ("--algorithm", "position-p", "--seeds", "3")
    for shard in ("2/3", "1/3", "3/3"):
        run_suite(small_suite, tmp_path / "shared", *words, "--shard", shard)
        assert not (tmp_path / "shared" / "submission.json").exists()
    run_suite(small_suite, tmp_path / "shared", *words)
    assert prints(tmp_path / "shared") == prints(entries / "position-p")


def test_the_statuses_of_each_task_are_printed_without_an_interval_over_levels(
    entries: Path, small_suite: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run_suite(small_suite, entries / "nothing", "--algorithm", "nothing", "--seeds", "3")
    text = capsys.readouterr().out
    statuses = load(entries / "nothing" / "near-v1").values("status")
    n_ok = statuses.count("ok")
    row = next(line.split() for line in text.splitlines() if line.startswith("near-v1 "))
    assert row[:5] == ["near-v1", "nothing", "6", str(n_ok), f"{100 * n_ok / 6:.0f}"]
    assert Counter(statuses)["missed"] == 0 or f"{statuses.count('missed')} missed" in text
    assert "interval" not in text


def test_the_short_form_has_one_seed_and_the_middle_level(
    small_suite: Path, tmp_path: Path
) -> None:
    run_suite(small_suite, tmp_path / "short", "--algorithm", "near=nothing", "--short")
    result = load(tmp_path / "short" / "near-v1")
    assert result.numbers("current") == (0.4,)
    assert list(load_submission(tmp_path / "short").tasks) == ["near-v1"]


@pytest.mark.slow
def test_an_algorithm_that_reads_the_truth_fails_outside_of_its_track(
    small_suite: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    program = tmp_path / "reads_truth.py"
    program.write_text(READS_TRUTH)
    for track, statuses in (("a", ("algorithm error",)), ("c", ("missed",))):
        words = ("--algorithm", f"{program}:ReadsTruth", "--tasks", "near", "--short")
        status = 3 if track == "a" else 0
        out = run_suite(small_suite, tmp_path / track, *words, "--track", track, status=status)
        result = load(out / "near-v1")
        assert result.values("status") == statuses
        assert (out / "code" / "reads_truth.py").read_text() == READS_TRUTH
        assert result.run.algorithm == "reads_truth.py:ReadsTruth"
        if track == "a":
            text = "topic '/bluerov2/odom' (PATToROSOdom) is not in track 'a'"
            assert text in (result.reason(0, "total") or "")
            assert f"near-v1: 1 of 1 algorithm error: {result.reason(0, 'total')}" in (
                capsys.readouterr().out
            )
            assert result.run.track == ("a", ("virtualCamera",))


@pytest.mark.slow
def test_a_misspelt_topic_of_a_users_algorithm_is_a_warning(
    small_suite: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    program = tmp_path / "misspells.py"
    program.write_text(MISSPELLS)
    words = ("--algorithm", f"{program}:Misspells", "--tasks", "near", "--short")
    run_suite(small_suite, tmp_path / "out", *words)
    warnings = [line for line in capsys.readouterr().err.splitlines() if "warning" in line]
    assert len(warnings) == 1
    assert "it publishes on '/bluerov/twist', but it has no subscriber." in warnings[0]
    assert warnings[0].endswith("Did you mean 'bluerov2/twist'?")


@pytest.mark.slow
def test_a_policy_that_observes_the_state_fails_in_a_track_of_sensors(
    small_suite: Path, tmp_path: Path
) -> None:
    words = ("--algorithm", "near=position-p", "--short", "--track", "a")
    result = load(run_suite(small_suite, tmp_path / "a", *words, status=3) / "near-v1")
    assert "'observation' (of the simulation itself) is not in track 'a'" in (
        result.reason(0, "total") or ""
    )


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("--algorithm nobody", "nobody"),
        ("--algorithm p --track d", "d"),
        ("--algorithm p --tasks nea", "near-v1"),
        ("--algorithm p --split tests", "test"),
        ("--algorithm p --split test", "add --date"),
        ("--algorithm p --date 2027-01-01", "leave out --date"),
        ("--algorithm p --seeds 5", "has 4 seeds"),
        ("--algorithm p --set oceanState.fog.density=0", "the task itself is fixed"),
        ("--algorithm none.py:None", "no such file"),
        ("", "expected NAME for all tasks"),
        ("--algorithm pilot", "add --view"),
        ("--algorithm p --shard 4/3", "NUMBER/COUNT"),
    ],
)
def test_a_wrong_option_has_an_error_of_one_line(
    small_suite: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], words: str, message: str
) -> None:
    out = tmp_path / "out"
    assert main(["suite", "run", str(small_suite), "--out", str(out), *words.split()]) == 2
    text = capsys.readouterr().err.strip()
    assert message in text
    assert len({line for line in text.splitlines() if "Traceback" in line}) == 0
    assert not (out / "submission.json").exists()


def test_the_list_of_a_suite_is_json_on_request(
    small_suite: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["suite", "list", str(small_suite), "--json"]) == 0
    (document,) = json.loads(capsys.readouterr().out)
    assert [task["name"] for task in document["tasks"]] == list(TASKS)
    assert document["tasks"][0]["failures"] == ["far", "missed"]


def test_a_task_with_other_files_than_its_hash_needs_a_new_version(
    small_suite: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    digest = "sha256:" + 64 * "0"
    text = small_suite.read_text().replace(
        "<control>nothing</control>\n  </task>", f"<hash>{digest}</hash>\n  </task>", 1
    )
    path = small_suite.parent / "recorded.xml"
    words = ["--algorithm", "near=nothing", "--short", "--workers", "0", "--out", str(tmp_path)]
    path.write_text(text)
    assert main(["suite", "run", str(path), *words]) == 2
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert "near-v1 has other files than its <hash> states" in line
    path.write_text(text.replace(digest, line.rpartition(", ")[2].rstrip(".")))
    assert main(["suite", "run", str(path), *words]) == 0
