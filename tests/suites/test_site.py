"""The page ranks submissions, states why others are excluded, and escapes their texts."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from uwsim.cli import main
from uwsim.errors import ResultError
from uwsim.suites.site.collect import Leaderboard, collect_submissions
from uwsim.suites.site.page import render
from uwsim.suites.site.trials import describe_row, notable_trials
from uwsim.suites.site.write import choose_replays, write_page
from uwsim.suites.submission import Card, load_submission, save_submission
from uwsim.suites.suite import Suite
from uwsim.suites.verification import Verification, save_verification


def change(entry: Path, **changes: object) -> None:
    save_submission(replace(load_submission(entry), **changes), entry)  # type: ignore[arg-type]


def copy(entry: Path, name: str) -> Path:
    return Path(shutil.copytree(entry, entry.parent / name))


def reasons(board: Leaderboard) -> dict[str, str]:
    return {entry.name: " ".join(entry.reasons) for entry in board.exclusions}


def test_submissions_are_ordered_by_success(entries: Path) -> None:
    board = collect_submissions(entries)
    assert [candidate.name for candidate in board.candidates] == ["position-p", "nothing"]
    assert [task.name for task in board.tasks] == ["near-v1", "far-v1"]
    assert board.exclusions == ()


def test_a_task_that_was_not_run_counts_as_no_success(entries: Path) -> None:
    entry = copy(entries / "position-p", "lazy")
    tasks = load_submission(entry).tasks
    change(entry, name="lazy", tasks={"near-v1": tasks["near-v1"]})
    page = render(collect_submissions(entries), {})
    success = {
        name: float(value)
        for name, value in re.findall(
            r'<a href="#submission-\d">([\w-]+)</a>.*?<td>([\d.]+)</td>', page
        )
    }
    assert success == {"position-p": 100.0, "nothing": pytest.approx(75.0), "lazy": 50.0}


def test_the_suite_gives_the_descriptions(entries: Path, small_suite: Path) -> None:
    page = render(collect_submissions(entries, str(small_suite)), {})
    assert "Two short tasks." in page
    assert "Stay near." in page
    assert "Stay near." not in render(collect_submissions(entries), {})


def test_the_same_submissions_give_the_same_bytes(entries: Path, tmp_path: Path) -> None:
    pages = [
        write_page(collect_submissions(entries), tmp_path / name, {}).read_bytes() for name in "ab"
    ]
    assert pages[0] == pages[1]


def test_texts_of_submissions_are_escaped_and_load_nothing(entries: Path) -> None:
    attack = '<script>alert("x")</script>'
    for link, is_shown in (("javascript:alert(1)", False), ("https://example.org/a", True)):
        change(
            entries / "nothing",
            name=f"{attack}$x$",
            card=Card(author=attack, description=attack, link=link),
        )
        page = render(collect_submissions(entries), {})
        assert "<script" not in page
        assert (f'href="{link}"' in page) == is_shown
    sources = re.findall(r'(?:src|href)="([^"]*)"', page)
    assert all(s.startswith(("data:image/png", "#", "https://example.org/a")) for s in sources)
    assert "default-src 'none'" in page
    assert all(f'alt="{start}' in page for start in ("Heat maps", "Stacked bars"))


def test_an_entry_with_edited_rows_is_excluded(entries: Path) -> None:
    path = copy(entries / "nothing", "edited") / "near-v1" / "result.json"
    path.write_text(path.read_text().replace('"missed"', '"ok"'))
    assert (
        "is not the file that submission.json lists"
        in reasons(collect_submissions(entries))["edited"]
    )


def test_an_entry_that_differs_from_its_replay_is_excluded_until_it_is_changed(
    entries: Path,
) -> None:
    entry = entries / "nothing"
    verdict = Verification(
        submission=load_submission(entry).sha256,
        verdict="differs",
        reasons=("near-v1: trial 0: other bytes.",),
        trials={},
    )
    save_verification(verdict, entry)
    assert "other bytes" in reasons(collect_submissions(entries))["nothing"]
    change(entry, name="other")
    board = collect_submissions(entries)
    assert {c.name: c.verdict for c in board.candidates} == {
        "position-p": "not verified",
        "other": "not verified",
    }


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"suite": "other"}, "it has the suite other"),
        ({"is_short": True}, "one level a task; this page compares"),
        ({"tasks": {}}, "it has no task"),
    ],
)
def test_an_entry_of_another_kind_is_excluded(
    entries: Path, changes: dict[str, object], message: str
) -> None:
    change(entries / "position-p", kind="baseline")
    change(entries / "nothing", **changes)
    assert message in reasons(collect_submissions(entries))["nothing"]


def test_an_entry_of_other_files_is_excluded(entries: Path) -> None:
    change(entries / "position-p", kind="baseline")
    tasks = load_submission(entries / "nothing").tasks
    near = replace(tasks["near-v1"], task_hash="sha256:0")
    change(entries / "nothing", tasks={**tasks, "near-v1": near})
    assert "near-v1: has other files" in reasons(collect_submissions(entries))["nothing"]


def test_equal_names_are_distinguished_by_their_folders(entries: Path) -> None:
    change(entries / "nothing", name="position-p")
    names = [candidate.name for candidate in collect_submissions(entries).candidates]
    assert names == ["position-p (position-p)", "position-p (nothing)"]


def test_a_folder_without_submissions_has_an_error(tmp_path: Path) -> None:
    with pytest.raises(ResultError, match=r"no folder in it has a valid submission\.json"):
        collect_submissions(tmp_path)


def test_the_worst_trial_is_a_failure_with_the_greatest_error(entries: Path) -> None:
    board = collect_submissions(entries)
    result = board.candidates[1].results["near-v1"]
    rows = notable_trials(result)
    statuses, totals = result.values("status"), result.numbers("total")
    failures = [row for row, status in enumerate(statuses) if status != "ok"]
    assert rows["worst"] == max(failures, key=lambda row: totals[row] or 0.0)
    assert describe_row(result, rows["worst"]).endswith("missed")
    assert choose_replays(board, "best") == [(0, 0), (1, 0)]
    assert len(choose_replays(board, "all")) == 4


@pytest.mark.slow
def test_the_command_writes_replays_of_the_best(
    entries: Path, tmp_path: Path, suite: Suite, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "page"
    assert main(["suite", "site", str(entries), "-o", str(out)]) == 0
    assert "2 submissions ranked" in capsys.readouterr().out
    page = (out / "index.html").read_text()
    links = re.findall(r'href="(replays/[^"]*)"', page)
    assert len(links) == 4
    assert all((out / link).is_file() for link in links)
    assert main(["suite", "site", str(entries), "-o", str(out)]) == 2
    words = ["-o", str(out), "--replays", "none", "--overwrite"]
    assert main(["suite", "site", str(entries), *words]) == 0
    assert not (out / "replays").exists()
