"""The page ranks submissions, states why others are excluded, and escapes their texts."""

from __future__ import annotations

import html
import os
import re
import shutil
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest
from matplotlib.colors import to_rgba

from uwsim.analysis.task.success_times import is_judged_at_end
from uwsim.cli import main
from uwsim.errors import ResultError, UnknownName
from uwsim.suites.entry import Seeds
from uwsim.suites.entry_files import entry_hash
from uwsim.suites.seeds import public_seeds
from uwsim.suites.site.board import Leaderboard
from uwsim.suites.site.collect import Conditions, collect_submissions
from uwsim.suites.site.figures import all_statuses, draw_endings, draw_times
from uwsim.suites.site.page import render
from uwsim.suites.site.rank_section import rank_sections, reference_section
from uwsim.suites.site.task_section import task_section
from uwsim.suites.site.trials import describe_row, frequent_reasons, notable_trials
from uwsim.suites.site.write import choose_replays, write_page
from uwsim.suites.submission import Card, load_submission, save_submission
from uwsim.suites.suite import Suite
from uwsim.suites.verification import Verification, save_verification


def change(entry: Path, **changes: object) -> None:
    save_submission(replace(load_submission(entry), **changes), entry)  # type: ignore[arg-type]


def accept(*entries: Path) -> None:
    """Write the verdict of a verifier who found no difference."""
    for entry in entries:
        sha256 = load_submission(entry).sha256
        verdict = Verification(
            submission=sha256, entry=entry_hash(entry), verdict="verified", trials={}
        )
        save_verification(verdict, entry)


@pytest.fixture
def entries(entries: Path, suite: Suite) -> Path:
    accept(entries / "position-p", entries / "nothing")
    return entries


@pytest.fixture
def conditions(suite: Suite) -> Conditions:
    return Conditions(suite=suite, seeds=public_seeds(suite, "validation", 3))


def copy(entry: Path, name: str) -> Path:
    return Path(shutil.copytree(entry, entry.parent / name))


def reasons(board: Leaderboard) -> dict[str, str]:
    return {entry.name: " ".join(entry.reasons) for entry in board.exclusions}


def test_submissions_are_ordered_by_success(entries: Path, conditions: Conditions) -> None:
    board = collect_submissions(entries, conditions)
    assert [candidate.name for candidate in board.candidates] == ["position-p", "nothing"]
    assert [task.name for task in board.tasks] == ["near-v1", "far-v1"]
    assert board.exclusions == ()


def page_text(entries: Path, conditions: Conditions) -> str:
    """Return the text of the page, without elements of HTML."""
    page = render(collect_submissions(entries, conditions), {})
    return " ".join(html.unescape(re.sub(r"<[^>]*>", " ", page.partition("<main>")[2])).split())


def test_a_submission_without_all_tasks_has_no_rank_over_all_and_one_in_its_task(
    entries: Path, conditions: Conditions
) -> None:
    entry = copy(entries / "position-p", "lazy")
    tasks = load_submission(entry).tasks
    change(entry, name="lazy", tasks={"near-v1": tasks["near-v1"]})
    accept(entry)
    board = collect_submissions(entries, conditions)
    assert [c.name for c in board.candidates] == ["position-p", "nothing", "lazy"]
    section = rank_sections(board)[0]
    groups = [[(r["name"], r["rank"], r["success"]) for r in g["rows"]] for g in section["groups"]]
    assert groups == [
        [("position-p", "1", "100.0"), ("nothing", "1", "75.0")],
        [("lazy", "–", "100.0")],
    ]
    near = task_section(board.tasks[0], board, {}, all_statuses(board.tasks))
    assert {row["name"]: row["rank"] for row in near["ranks"]}["lazy"] == "1"


def test_references_are_apart_and_compared_on_common_tasks(
    entries: Path, conditions: Conditions
) -> None:
    control = copy(entries / "nothing", "control")
    tasks = load_submission(control).tasks
    change(control, kind="control", name="control", tasks={"near-v1": tasks["near-v1"]})
    accept(control)
    board = collect_submissions(entries, conditions)
    groups = rank_sections(board)[0]["groups"]
    assert [[row["name"] for row in group["rows"]] for group in groups] == [
        ["position-p", "nothing"],
        ["control"],
    ]
    reference = reference_section(board)
    assert reference is not None
    cells = {row["name"]: row["cells"][0]["note"] for row in reference["rows"]}
    assert cells == {
        "position-p": "100 to 50 %, 1 task",
        "nothing": "50 to 50 %, 1 task",
        "control": "",
    }


def test_without_submissions_the_references_have_ranks_in_each_task_alone(
    entries: Path, conditions: Conditions
) -> None:
    for name, kind in (("position-p", "baseline"), ("nothing", "control")):
        change(entries / name, kind=kind)
        accept(entries / name)
    board = collect_submissions(entries, conditions)
    (group,) = rank_sections(board)[0]["groups"]
    assert [(row["name"], row["rank"]) for row in group["rows"]] == [
        ("position-p", "–"),
        ("nothing", "–"),
    ]
    near = task_section(board.tasks[0], board, {}, all_statuses(board.tasks))
    assert [row["rank"] for row in near["ranks"]] == ["1", "1"]


def test_too_few_seeds_are_stated_and_have_no_places(entries: Path, conditions: Conditions) -> None:
    """Three seeds of one task; the two tasks together have six units, which are just enough."""
    text = page_text(entries, conditions)
    assert text.count("3 seeds cannot separate 2 submissions: 6 are needed. All are tied.") == 2
    row = rank_sections(collect_submissions(entries, conditions))[0]["groups"][0]["rows"][0]
    assert row["places"] == "–"


def test_a_page_of_the_short_form_states_that_it_is_a_trial(
    entries: Path, conditions: Conditions
) -> None:
    assert "Short form" not in page_text(entries, conditions)
    board = replace(collect_submissions(entries, conditions), is_short=True)
    text = render(board, {})
    assert "Short form: a trial, no leaderboard." in text
    assert "cannot separate" not in text


def test_the_reasons_of_failures_are_on_the_page(entries: Path, conditions: Conditions) -> None:
    assert re.search(r"\d far: offset_max > 0\.9; offset_max = |missed: not offset < 0\.4",
                     page_text(entries, conditions))  # fmt: skip
    result = collect_submissions(entries, conditions).candidates[1].results["near-v1"]
    reasons = dict(frequent_reasons(result))
    counts = Counter(result.values("status"))
    assert {s: sum(n for n, _ in kinds) for s, kinds in reasons.items()} == {
        s: n for s, n in counts.items() if s != "ok"
    }


def test_a_status_has_one_colour_in_all_tasks(entries: Path, conditions: Conditions) -> None:
    board = collect_submissions(entries, conditions)
    statuses = ["ok", "left", "missed", "far"]
    for task in board.tasks:
        axes = draw_endings(task, statuses).axes[0]
        handles, labels = axes.get_legend_handles_labels()
        colours = {n: h.patches[0].get_facecolor() for n, h in zip(labels, handles, strict=True)}
        assert colours["ok"] == to_rgba("#009E73")
        assert colours.get("missed", to_rgba("#E69F00")) == to_rgba("#E69F00")


def test_a_task_that_judges_at_its_end_has_no_times_to_success(
    entries: Path, conditions: Conditions
) -> None:
    task = collect_submissions(entries, conditions).tasks[0]
    assert all(is_judged_at_end(entry.result) for entry in task.entries)
    assert draw_times(task) is None


def test_the_suite_gives_the_descriptions(entries: Path, conditions: Conditions) -> None:
    page = render(collect_submissions(entries, conditions), {})
    assert "Two short tasks." in page
    assert "Stay near." in page


def test_the_same_submissions_give_the_same_bytes(
    entries: Path, conditions: Conditions, tmp_path: Path
) -> None:
    pages = [
        write_page(collect_submissions(entries, conditions), tmp_path / name, {}).read_bytes()
        for name in "ab"
    ]
    assert pages[0] == pages[1]


def test_texts_of_submissions_are_escaped_and_load_nothing(
    entries: Path, conditions: Conditions
) -> None:
    attack = '<script>alert("x")</script>'
    for link, is_shown in (("javascript:alert(1)", False), ("https://example.org/a", True)):
        change(
            entries / "nothing",
            name=f"{attack}$x$",
            card=Card(author=attack, description=attack, link=link),
        )
        accept(entries / "nothing")
        page = render(collect_submissions(entries, conditions), {})
        assert "<script" not in page
        assert (f'href="{link}"' in page) == is_shown
    sources = re.findall(r'(?:src|href)="([^"]*)"', page)
    assert all(s.startswith(("data:image/png", "#", "https://example.org/a")) for s in sources)
    assert "default-src 'none'" in page
    assert all(f'alt="{start}' in page for start in ("Heat maps", "Stacked bars"))


def test_an_entry_with_edited_rows_is_excluded(entries: Path, conditions: Conditions) -> None:
    path = copy(entries / "nothing", "edited") / "near-v1" / "result.json"
    path.write_text(path.read_text().replace('"missed"', '"ok"'))
    assert (
        "is not the file that submission.json lists"
        in reasons(collect_submissions(entries, conditions))["edited"]
    )


def test_an_entry_that_differs_from_its_replay_is_excluded_until_it_is_changed(
    entries: Path, conditions: Conditions
) -> None:
    entry = entries / "nothing"
    verdict = Verification(
        submission=load_submission(entry).sha256,
        verdict="differs",
        reasons=("near-v1: trial 0: other bytes.",),
        trials={},
    )
    save_verification(verdict, entry)
    assert "other bytes" in reasons(collect_submissions(entries, conditions))["nothing"]
    change(entry, name="other")
    board = collect_submissions(entries, conditions)
    assert {c.name: c.verdict for c in board.candidates} == {
        "position-p": "verified",
        "other (not verified)": "not verified",
    }


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"suite": "other"}, "it has the suite other"),
        ({"is_short": True}, "one level a task; this page compares"),
        ({"tasks": {}}, "it has no task"),
        ({"track": "a"}, "track is null in its result"),
        ({"version": "0.5.1"}, "version is"),
        ({"kind": "baseline"}, "'nothing' is no baseline of the suite; the suite has position-p"),
        ({"kind": "expert"}, "near-v1: 'nothing' is no expert"),
        ({"seeds": Seeds(split="training", first=100, count=3)}, "seeds 100 to 102 (training)"),
        ({"name": "a\u202eb"}, "change the direction of writing"),
        ({"name": "a" * 5000}, "5000 letters"),
        ({"card": Card(author="a\x1b[2J")}, "cannot be printed"),
    ],
)
def test_an_entry_of_another_kind_is_excluded(
    entries: Path, conditions: Conditions, changes: dict[str, object], message: str
) -> None:
    change(entries / "nothing", **changes)
    assert message in reasons(collect_submissions(entries, conditions))["nothing"]


def test_an_entry_of_other_files_is_excluded(entries: Path, conditions: Conditions) -> None:
    tasks = load_submission(entries / "nothing").tasks
    near = replace(tasks["near-v1"], task_hash="sha256:0")
    change(entries / "nothing", tasks={**tasks, "near-v1": near})
    assert (
        "the hash of the task is not that of its result"
        in reasons(collect_submissions(entries, conditions))["nothing"]
    )


def test_equal_names_are_distinguished_by_their_folders(
    entries: Path, conditions: Conditions
) -> None:
    change(entries / "nothing", name="position-p")
    accept(entries / "nothing")
    names = [candidate.name for candidate in collect_submissions(entries, conditions).candidates]
    assert names == ["position-p (position-p)", "position-p (nothing)"]


def test_a_folder_without_submissions_has_an_error(tmp_path: Path, conditions: Conditions) -> None:
    with pytest.raises(ResultError, match=r"no folder in it has a valid submission\.json"):
        collect_submissions(tmp_path, conditions)


def test_only_what_is_verified_has_a_rank(entries: Path, conditions: Conditions) -> None:
    (entries / "position-p" / "verification.json").unlink()
    motion = next((entries / "nothing" / "near-v1" / "units").glob("*.motion"))
    other = copy(entries / "nothing", "other")
    (other / motion.relative_to(entries / "nothing")).write_bytes(b"another film")
    board = collect_submissions(entries, conditions)
    assert {c.name: c.verdict for c in board.candidates} == {
        "nothing": "verified",
        "position-p (not verified)": "not verified",
        "nothing (not verified)": "changed since verification",
    }
    groups = rank_sections(board)[0]["groups"]
    assert [[(row["name"], row["rank"]) for row in group["rows"]] for group in groups] == [
        [("nothing", "1")],
        [("position-p (not verified)", "–"), ("nothing (not verified)", "–")],
    ]
    assert "changed since verification" in page_text(entries, conditions)


def test_a_task_that_the_suite_lacks_is_refused(entries: Path, conditions: Conditions) -> None:
    entry = entries / "nothing"
    tasks = load_submission(entry).tasks
    shutil.copytree(entry / "near-v1", entry / "new-v1")
    change(entry, tasks={**tasks, "new-v1": tasks["near-v1"]})
    assert (
        "No task is called 'new-v1'" in reasons(collect_submissions(entries, conditions))["nothing"]
    )


def test_a_bad_folder_is_one_line_and_never_the_end(entries: Path, conditions: Conditions) -> None:
    for name in ("pipe", "device", "folder"):
        copy(entries / "nothing", name)
    for name in ("pipe", "device"):
        (entries / name / "submission.json").unlink()
    os.mkfifo(entries / "pipe" / "submission.json")
    (entries / "device" / "submission.json").symlink_to("/dev/zero")
    (entries / "folder" / "verification.json").unlink()
    (entries / "folder" / "verification.json").mkdir()
    bad_bytes = os.fsencode(entries) + b"/bad\xff"
    os.mkdir(bad_bytes)
    shutil.copyfile(entries / "nothing" / "submission.json", bad_bytes + b"/submission.json")
    board = collect_submissions(entries, conditions)
    assert [c.name for c in board.candidates] == ["position-p", "nothing"]
    texts = reasons(board)
    assert "no plain file" in texts["pipe"]
    assert "no plain file" in texts["device"]
    assert "is a folder" in texts["folder"]
    assert len(texts) == 4
    render(board, {}).encode()


def test_a_bad_folder_does_not_keep_others_from_being_verified(
    entries: Path, small_suite: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bad = entries / "bad"
    bad.mkdir()
    os.mkfifo(bad / "submission.json")
    words = [str(bad), str(entries / "nothing"), "--suite", str(small_suite), "--workers", "0"]
    assert main(["suite", "verify", *words]) == 3
    text = capsys.readouterr().out
    assert "no plain file" in text
    assert "nothing: verified, 2 trials run again" in text


def test_the_worst_trial_is_a_failure_with_the_greatest_error(
    entries: Path, conditions: Conditions
) -> None:
    board = collect_submissions(entries, conditions)
    result = board.candidates[1].results["near-v1"]
    rows = notable_trials(result)
    statuses, totals = result.values("status"), result.numbers("total")
    failures = [row for row, status in enumerate(statuses) if status != "ok"]
    assert rows["worst"] == max(failures, key=lambda row: totals[row] or 0.0)
    assert describe_row(result, rows["worst"]).endswith("missed")
    assert choose_replays(board, "best") == [(0, 0), (1, 0)]
    assert len(choose_replays(board, "all")) == 4
    assert choose_replays(board, "nothing") == [(0, 1), (1, 1)]
    with pytest.raises(UnknownName, match="Did you mean 'nothing'"):
        choose_replays(board, "nothin")


@pytest.mark.slow
def test_the_command_writes_replays_of_the_best(
    entries: Path, tmp_path: Path, suite: Suite, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "page"
    options = ["--suite", str(suite.path), "--seeds", "3"]
    assert main(["suite", "site", str(entries), "-o", str(out), *options]) == 0
    assert "2 submissions compared" in capsys.readouterr().out
    page = (out / "index.html").read_text()
    links = re.findall(r'href="(replays/[^"]*)"', page)
    assert len(links) == 4
    assert all((out / link).is_file() for link in links)
    assert main(["suite", "site", str(entries), "-o", str(out), *options]) == 2
    words = ["-o", str(out), "--replays", "none", "--overwrite", *options]
    assert main(["suite", "site", str(entries), *words]) == 0
    assert not (out / "replays").exists()
