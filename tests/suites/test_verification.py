"""Verification finds what an author may have changed."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from tests.support.small_suite import SUITE, run_suite, write_suite
from uwsim.base.files.input_files import compute_hash
from uwsim.cli import main
from uwsim.errors import BadSetting, ResultError
from uwsim.suites.seeds import draw_test_seeds
from uwsim.suites.submission import load_submission, save_submission
from uwsim.suites.suite import Suite, read_suite
from uwsim.suites.verification import verify_submission


def change_json(path: Path, change: Callable[[Any], None]) -> None:
    document = json.loads(path.read_text())
    change(document)
    path.write_text(json.dumps(document))


def claim_results(entry: Path) -> None:
    """List the present results in submission.json, as a careful cheat does."""
    submission = load_submission(entry)
    tasks = {
        name: replace(task, result=compute_hash(entry / name / "result.json"))
        for name, task in submission.tasks.items()
    }
    save_submission(replace(submission, tasks=tasks), entry)


def reasons_of(entry: Path, suite: Suite, sample: str = "x") -> str:
    verification = verify_submission(entry, suite, sample)
    assert verification.verdict == "differs"
    return "\n".join(verification.reasons)


def reasons_of_change(entry: Path, suite: Suite, **changes: Any) -> str:
    save_submission(replace(load_submission(entry), **changes), entry)
    return reasons_of(entry, suite)


def test_another_film_of_a_trial_is_found(entries: Path, suite: Suite) -> None:
    for task in ("near-v1", "far-v1"):
        first, *others = sorted((entries / "nothing" / task / "units").glob("*.motion"))
        for path in others:
            path.write_bytes(first.read_bytes())
    reasons = [verify_submission(entries / "nothing", suite, text).reasons for text in "ab"]
    assert "is not the motion of the replay" in str(reasons)


def test_test_seeds_are_those_of_the_organiser(
    small_suite: Path, suite: Suite, tmp_path: Path
) -> None:
    words = ["--algorithm", "near=nothing", "--split", "test", "--seeds", "1", "--short"]
    entry = run_suite(
        small_suite, tmp_path / "entry", *words, "--date", "2020-01-01", "--beacon", "luck"
    )
    assert verify_submission(entry, suite, "x").verdict == "not verified"
    verdicts = {
        text: verify_submission(entry, suite, "x", test_seeds=("2020-01-01", text)).verdict
        for text in ("luck", "chance")
    }
    assert verdicts == {"luck": "verified", "chance": "differs"}


def test_an_unchanged_entry_is_verified_with_a_trial_of_each_task(
    entries: Path, suite: Suite
) -> None:
    verification = verify_submission(entries / "position-p", suite, "a text")
    assert (verification.verdict, verification.reasons) == ("verified", ())
    assert {name: len(trials) for name, trials in verification.trials.items()} == {
        "near-v1": 1,
        "far-v1": 1,
    }
    assert verification.submission == load_submission(entries / "position-p").sha256


@pytest.mark.slow
def test_the_trials_follow_from_the_text_of_the_verifier(entries: Path, suite: Suite) -> None:
    drawn = {
        verify_submission(entries / "nothing", suite, text).trials["near-v1"] for text in "abcdefgh"
    }
    assert len(drawn) > 1
    assert verify_submission(entries / "nothing", suite, "a").trials == (
        verify_submission(entries / "nothing", suite, "a").trials
    )


def test_an_edited_row_is_found_without_a_replay(entries: Path, suite: Suite) -> None:
    path = entries / "nothing" / "near-v1" / "result.json"
    path.write_text(path.read_text().replace('"missed"', '"ok"'))
    assert "not the file that submission.json lists" in reasons_of(entries / "nothing", suite)
    claim_results(entries / "nothing")
    assert "rows are ok, not" in reasons_of(entries / "nothing", suite)


def test_a_row_that_is_edited_everywhere_is_found_by_its_replay(
    entries: Path, suite: Suite
) -> None:
    entry = entries / "nothing"
    for path in [*(entry / "near-v1" / "units").glob("*.jsonl"), entry / "near-v1" / "result.json"]:
        path.write_text(path.read_text().replace('"missed"', '"ok"'))
    claim_results(entry)
    submission = load_submission(entry)
    task = replace(submission.tasks["near-v1"], n_ok=6)
    save_submission(replace(submission, tasks={**submission.tasks, "near-v1": task}), entry)
    verdicts = [verify_submission(entry, suite, text).verdict for text in "abcd"]
    assert "differs" in verdicts


def test_a_removed_trial_is_found(entries: Path, suite: Suite) -> None:
    (entries / "nothing" / "far-v1" / "units" / "00003.jsonl").unlink()
    assert "of trials that all ended" in reasons_of(entries / "nothing", suite)


def test_another_benchmark_of_the_same_name_is_found(
    entries: Path, suite: Suite, tmp_path: Path
) -> None:
    other = write_suite(tmp_path / "other")
    path = other.parent / "near.xml"
    path.write_text(path.read_text().replace("0.4</success>", "9</success>"))
    path.write_text(path.read_text().replace("&lt; 0.4", "&lt; 9"))
    out = tmp_path / "easy"
    words = ["--algorithm", "near=nothing", "--seeds", "1", "--workers", "0"]
    assert main(["suite", "run", str(other), *words, "--out", str(out)]) == 0
    (out / "near-v1" / "inputs").mkdir()
    (out / "near-v1" / "inputs" / "near.xml").write_text(path.read_text())
    text = reasons_of(out, suite)
    assert "the task has other files than here" in text
    assert "near.xml" in text


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda s: replace(s, seeds=replace(s.seeds, first=1)), "its seeds are 1 to 3"),
        (lambda s: replace(s, seeds=replace(s.seeds, count=2)), "repeats is 3; expected 2"),
        (lambda s: replace(s, seeds=replace(s.seeds, split="training")), "has 100 to 102"),
        (lambda s: replace(s, track="a"), 'track is null; expected ["a", ["virtualCamera"]]'),
        (lambda s: replace(s, settings=("algorithm.latency_s=1",)), "settings is"),
        (lambda s: replace(s, settings=("seed=9",)), "the task itself is fixed"),
        (lambda s: replace(s, is_short=True), "levels is"),
        (
            lambda s: replace(
                s, tasks={n: replace(t, algorithm="frozen") for n, t in s.tasks.items()}
            ),
            "algorithm is",
        ),
        (lambda s: replace(s, tasks={"../near-v1": s.tasks["near-v1"]}), "../near-v1"),
    ],
)
def test_a_false_claim_is_found(
    entries: Path, suite: Suite, change: Callable[[Any], Any], message: str
) -> None:
    entry = entries / "nothing"
    save_submission(change(load_submission(entry)), entry)
    assert message in reasons_of(entry, suite)


def test_an_entry_of_another_version_is_not_verified(entries: Path, suite: Suite) -> None:
    entry = entries / "nothing"
    assert "is of uwsim" in reasons_of_change(entry, suite, version="0.1.0")
    for name in load_submission(entry).tasks:
        change_json(entry / name / "result.json", lambda d: d["run"].update(version="0.1.0"))
    claim_results(entry)
    verification = verify_submission(entry, suite, "x")
    assert verification.verdict == "not verified"
    assert "uwsim 0.1.0" in verification.reasons[0]


@pytest.mark.slow
def test_code_that_cannot_be_imported_here_is_not_verified(
    small_suite: Path, suite: Suite, tmp_path: Path
) -> None:
    """A module of the author's machine that is absent here makes no claim false."""
    program = tmp_path / "quiet.py"
    program.write_text("class Quiet:\n    def start(self, node):\n        pass\n")
    words = ("--algorithm", f"{program}:Quiet", "--tasks", "near", "--short")
    entry = run_suite(small_suite, tmp_path / "entry", *words)
    copied = entry / "code" / "quiet.py"
    copied.write_text("import absent_module\n" + copied.read_text())
    verification = verify_submission(entry, suite, "x")
    assert verification.verdict == "not verified"
    assert "absent_module" in " ".join(verification.reasons)


def test_a_task_that_was_added_later_changes_no_verdict(
    entries: Path, small_suite: Path, tmp_path: Path
) -> None:
    later = write_suite(tmp_path / "later")
    task = re.search(r"  <task>.*?</task>\n", SUITE, re.DOTALL)
    assert task is not None
    later.write_text(SUITE.replace("</suite>", task[0].replace("near-v1", "new-v1") + "</suite>"))
    assert verify_submission(entries / "nothing", read_suite(later), "x").verdict == "verified"


def test_the_command_states_the_verdict_and_how_to_repeat_it(
    entries: Path, small_suite: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["suite", "verify", str(entries / "nothing"), "--suite", str(small_suite)]
    assert main([*words, "--workers", "0", "--sample", "t"]) == 0
    assert "verified, 2 trials run again" in capsys.readouterr().out
    document = json.loads((entries / "nothing" / "verification.json").read_text())
    assert (document["verdict"], document["sample"]) == ("verified", "t")
    path = entries / "nothing" / "near-v1" / "result.json"
    path.write_text(path.read_text().replace('"missed"', '"ok"'))
    assert main([*words, "--workers", "0"]) == 3


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "is no JSON"),
        ("[]", "expected an object"),
        ('{"format": "other"}', "among its keys"),
        (None, "no such file"),
    ],
)
def test_a_damaged_submission_has_an_error(tmp_path: Path, text: str | None, message: str) -> None:
    if text is not None:
        (tmp_path / "submission.json").write_text(text)
    with pytest.raises(ResultError, match=message):
        load_submission(tmp_path)


def test_test_seeds_follow_from_suite_date_and_text(suite: Suite, tmp_path: Path) -> None:
    seeds = draw_test_seeds(suite, "2027-01-01", "abc", 3)
    assert seeds == draw_test_seeds(suite, "2027-01-01", " abc ", 3)
    others = [
        draw_test_seeds(suite, "2027-01-02", "abc", 3),
        draw_test_seeds(suite, "2027-01-01", "abd", 3),
    ]
    assert len({seeds.first, *(other.first for other in others)}) == 3
    assert seeds.first >= 2**24
    with pytest.raises(BadSetting, match="expected a date"):
        draw_test_seeds(suite, "1.1.2027", "abc", 3)
    with pytest.raises(BadSetting, match="public text"):
        draw_test_seeds(suite, "2027-01-01", " ", 3)
