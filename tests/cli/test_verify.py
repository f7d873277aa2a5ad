"""``uwsim verify``: a result is what its inputs give, or it is said where not."""

from __future__ import annotations

import json
import re
import shlex
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from tests.support.short_benchmark import write_benchmark
from uwsim.assets.bundled import bundled_files
from uwsim.base.files.image_record import remove_record
from uwsim.cli import main
from uwsim.results.leaves import leaves
from uwsim.results.provenance import save_provenance
from uwsim.results.result_file import load
from uwsim.runs.executors.executor import run_all
from uwsim.runs.planning.make_plan import make_plan
from uwsim.runs.planning.plan_request import PlanRequest
from uwsim.runs.prepare import hash_inputs
from uwsim.runs.run import Run
from uwsim.simulation import Simulation
from uwsim.verify.derived import contradictions
from uwsim.verify.differences import row_differences, text_difference
from uwsim.verify.verify import Verification, choose_trials

BENCHMARK = """<benchmark xmlns:u="urn:uwsim:1" u:scene="tank.xml" u:algorithm="esm"
    u:mode="independent">
  <measures>
    <euclideanNorm u:value="mean">
      <name>corners</name>
      <groundTruth type="cornersFromCamera">
        <camera>bowtech1</camera> <target>blackbox</target> <publishOn>autoInit</publishOn>
      </groundTruth>
      <target>cornersTopic</target> <log>0.05</log>
    </euclideanNorm>
  </measures>
  <startOn> <type>service</type> <target>startBench</target> </startOn>
  <stopOn> <type>never</type> </stopOn>
  <function>corners</function>
  <sceneUpdater>
    <sceneFogUpdater>
      <initialValue>0</initialValue> <finalValue>0.5</finalValue> <step>0.4</step>
      <interval>0.2</interval>
    </sceneFogUpdater>
  </sceneUpdater>
</benchmark>
"""


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a benchmark, its scene, and the result of two trials."""
    folder = tmp_path_factory.mktemp("played")
    (folder / "b.xml").write_text(BENCHMARK)
    scene = bundled_files("scenes")["visibility-scene"].read_text()
    (folder / "tank.xml").write_text(scene.replace("<rate>30</rate>", "<rate>10</rate>"))
    plan = make_plan(
        PlanRequest(
            benchmark=str(folder / "b.xml"),
            seed=3,
            repeat=1,
            settings=["algorithm.zncc_threshold=0.4"],
        )
    )
    inputs, renderer = hash_inputs(plan)
    run_all([Run(plan=plan, out=folder / "out", inputs=inputs, renderer=renderer)])
    return folder


@pytest.fixture
def folder(played: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of it to do harm to."""
    shutil.copytree(played, tmp_path / "copy")
    monkeypatch.chdir(tmp_path / "copy")
    return tmp_path / "copy"


def change(folder: Path, harm: Callable[[list[dict[str, Any]]], object], unit: int = 1) -> None:
    """Change the stored unit: a list of its lines."""
    path = folder / "out" / "units" / f"{unit:05d}.jsonl"
    lines = [json.loads(line) for line in path.read_text().splitlines()]
    harm(lines)
    path.write_text("".join(json.dumps(line) + "\n" for line in lines))


def verify(capsys: pytest.CaptureFixture[str], *options: str) -> tuple[int, str]:
    status = main(["verify", "out", *options])
    captured = capsys.readouterr()
    return status, captured.out + captured.err


def test_a_result_that_was_left_alone_is_the_same(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    status, said = verify(capsys)
    assert (status, said.splitlines()[-1]) == (
        0,
        "the same, byte for byte: all of 2 trials replayed, 2 levels",
    )
    assert "files: the same (b.xml, tank.xml and 11 more)" in said
    assert sorted(path.name for path in folder.iterdir()) == ["b.xml", "out", "tank.xml"]


@pytest.mark.parametrize(("key", "status"), [("meaning", 0), ("value", 3)])
def test_the_words_for_a_measure_may_change_and_its_statistic_may_not(
    folder: Path, key: str, status: int, capsys: pytest.CaptureFixture[str]
) -> None:
    path = folder / "out" / "measures.json"
    notes = json.loads(path.read_text())
    notes["corners"][key] = "another text"
    path.write_text(json.dumps(notes, indent=2, ensure_ascii=False) + "\n")
    exit_status, output = verify(capsys)
    assert exit_status == status
    assert ("measures.json" in output) == (status == 3)


def test_a_changed_cell_sample_and_fingerprint_are_each_named_with_their_place(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    def cell(lines: list[dict[str, Any]]) -> None:
        lines[1]["row"]["measures"]["corners"][0] += 1e-12

    def sample_and_mark(lines: list[dict[str, Any]]) -> None:
        for sample in lines[1]["row"]["logs"]["corners"][2:4]:
            sample[1] *= 1.000001
        marks = lines[-1]["end"]["trace"]["marks"]
        marks[5] = "00000000" + marks[5][8:]

    change(folder, cell, unit=0)
    change(folder, sample_and_mark, unit=1)
    status, said = verify(capsys)
    assert status == 3
    assert "trial 0 (seed 3), level fog=0: column corners: stored 0." in said
    assert "result.json: row 0, column corners: 0." in said
    assert said.count("log of corners, first at sample 2 (0.1 s): stored") == 1
    assert "measure-corners.csv: line 9, column total" in said
    assert (
        "trial 1 (seed 3): motion and images are the same up to step 320 (0.64 s), "
        "no more at step 384 (0.768 s); first differs: girona500/base_link" in said
    )
    assert "It begins in the physics: girona500/base_link moved otherwise." in said


def test_a_body_that_moves_otherwise_in_the_replay_is_named_with_its_steps(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    advance = Simulation.advance

    def drifting(self: Simulation, seconds: float | None = None) -> None:
        if self.step == 700:
            arm = self.world.vehicles.find("girona500")
            joints = arm.joints
            joints[1] += 1e-9
            arm.set_joints(joints)
        advance(self, seconds)

    monkeypatch.setattr(Simulation, "advance", drifting)
    status, said = verify(capsys, "--sample", "1")
    assert status == 3
    assert said.count("up to step 640 (1.28 s), no more at step 704 (1.408 s)") == 1
    assert "first differs: girona500/part2\n" in said


def test_a_result_json_that_says_other_than_its_units_is_found_without_a_replay(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = folder / "out" / "result.json"
    text = path.read_text()
    path.write_text(text.replace('"ok"', '"lost"', 1))
    status, said = verify(capsys, "--sample", "1")
    assert status == 3
    assert 'result.json: row 0, column status: "lost" there, "ok" by units/' in said
    assert "Every replayed trial gave its stored values; other parts of the result differ" in said
    assert "1 of 2 trials replayed" in said


@pytest.mark.parametrize(
    ("where", "now", "said"),
    [
        (("run", "version"), "9.9", 'run version: "9.9" there, "'),
        (("run", "physics"), "mujoco 1", 'run physics: "mujoco 1" there, "mujoco '),
        (("run", "mode"), "sequential", 'run mode: "sequential" there, "independent"'),
        (("run", "parameters"), {}, "run parameters: {} there, "),
        (("run", "kp"), 1, "run kp: 1 there, nothing by"),
        (("inputs", "scene"), ["other.xml", "sha256:0"], 'inputs scene 0: "other.xml" there'),
        (("seed",), 4, "seed: 4 there, 3 by"),
        (("levels",), [[0.1]], "levels 0 0: 0.1 there, 0.4 by"),
        (("note",), "new", 'note: "new" there, nothing by'),
    ],
)
def test_every_altered_value_in_the_head_of_a_unit_is_named(
    folder: Path, capsys: pytest.CaptureFixture[str], where: tuple[str, ...], now: Any, said: str
) -> None:
    def alter(lines: list[dict[str, Any]]) -> None:
        part = lines[0]["unit"]
        for key in where[:-1]:
            part = part[key]
        part[where[-1]] = now

    change(folder, alter, unit=1)
    status, text = verify(capsys, "--sample", "1")
    assert status == 3
    assert f"units/00001.jsonl: {said}" in text
    assert text.count("units/00001.jsonl: ") == 1


@pytest.mark.slow
def test_where_no_result_is_the_error_says_what_is_there_and_how_to_go_on(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    def said(*words: str) -> str:
        assert main([*words]) == 2
        [line] = capsys.readouterr().err.splitlines()
        return line

    (folder / "out" / "result.json").unlink()
    resume = (
        "uwsim: out: no result here yet: its run was interrupted. Resume with: uwsim bench b.xml "
        "--algorithm esm --seed 3 --mode independent --set algorithm.zncc_threshold=0.4 "
        "--out out --resume."
    )
    assert said("report", "out") == resume
    assert said("verify", "out") == resume
    assert said("compare", "out", "other") == resume
    call = resume.removesuffix(".").partition("uwsim bench")[2]
    assert main(["bench", *shlex.split(call)]) == 0
    assert verify(capsys, "--sample", "1")[0] == 0

    (folder / "both").mkdir()
    for name in ("esm", "frozen"):
        shutil.copytree(folder / "out", folder / "both" / name)
    both = "both: holds 2 results (esm, frozen); name one, as both/esm."
    assert said("report", "both") == said("verify", "both") == f"uwsim: {both}"
    for name in ("esm", "frozen"):
        (folder / "both" / name / "result.json").unlink()
        (folder / "both" / name / "provenance.json").unlink()  # a program has played
    assert "--algorithm esm --algorithm esm --seed 3" in said("report", "both")
    begun = ["--overwrite", "--scene", "tank.xml", "--data-path", "my models", "--out", "out"]
    save_provenance({"command": ["bench", "b.xml", *begun]}, folder / "both" / "esm")
    go_on = "--scene tank.xml --data-path 'my models' --out both --resume."  # where it is now
    assert said("report", "both").endswith(f"Resume with: uwsim bench b.xml {go_on}")
    (folder / "empty").mkdir()
    assert said("report", "empty") == "uwsim: empty: no result here (no result.json)."
    assert said("report", "nix") == (
        "uwsim: nix: no result here (there is no such file or directory)."
    )


@pytest.mark.parametrize("there", [0, 2])
def test_a_row_too_many_or_too_few_is_a_difference(
    folder: Path, capsys: pytest.CaptureFixture[str], there: int
) -> None:
    change(folder, lambda lines: lines.__setitem__(slice(1, -1), lines[1:-1] * there))
    status, said = verify(capsys)
    assert status == 3
    assert f"trial 1 (seed 3): {there} rows; expected 1, one for each level of the trial" in said


def test_a_journal_too_many_is_a_difference(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    units = folder / "out" / "units"
    (units / "00007.jsonl").write_text((units / "00000.jsonl").read_text())
    status, said = verify(capsys)
    assert status == 3
    assert "units/00007.jsonl: this run has no such trial" in said


@pytest.mark.parametrize("is_older", [True, False])
def test_pictures_of_older_versions_have_no_record(
    folder: Path, capsys: pytest.CaptureFixture[str], *, is_older: bool
) -> None:
    path = next((folder / "out" / "pictures").glob("*.png"))
    image = path.read_bytes()
    plain_image = remove_record(image)
    assert plain_image != image
    path.write_bytes(plain_image if is_older else image[:-20] + image[-19:])
    status, said = verify(capsys)
    assert (status, f"pictures/{path.name}: differs" in said) == (
        (0, False) if is_older else (3, True)
    )


def result_json_alone(folder: Path) -> Path:
    """Take away what the result is collected from; return its file."""
    for name in ("units", "pictures"):
        shutil.rmtree(folder / "out" / name)
    return folder / "out" / "result.json"


def test_of_result_json_alone_a_row_too_many_is_a_difference(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = result_json_alone(folder)
    document = json.loads(path.read_text())
    document["rows"].append(document["rows"][-1])
    path.write_text(json.dumps(document))
    status, said = verify(capsys)
    assert status == 3
    assert "result.json: 3 rows; expected 2, one for each level" in said


def test_result_json_alone_can_be_verified_by_its_rows(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = result_json_alone(folder)
    path.write_text(path.read_text().replace('"ok"', '"lost"', 1))
    status, said = verify(capsys)
    assert status == 3
    assert "not compared: units/" in said
    assert said.count("result.json: ") == 2
    assert " there, None by 'corners' of the row's values" in said
    assert "result.json: row 0, column status: stored 'lost', replayed 'ok'" in said


def test_a_changed_scene_is_refused_and_the_right_one_may_be_called_otherwise(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = folder / "tank.xml"
    scene_text = scene.read_text()
    scene.write_text(scene_text + "\n")
    status, said = verify(capsys)
    assert status == 2
    assert len(said.splitlines()) == 1
    assert said.startswith("uwsim: The scene is not the one that was run, tank.xml (sha256:")
    assert f"{scene} (sha256:" in said
    scene.rename(folder / "elsewhere.xml").write_text(scene_text)
    for path in [folder / "out" / "result.json", *(folder / "out" / "units").glob("*.jsonl")]:
        path.write_text(re.sub(r'("renderer": ?")', r"\1NVIDIA ", path.read_text()))
    (folder / "out" / "provenance.json").write_text('{"cpu": "abacus"}')
    status, said = verify(capsys, "--scene", "elsewhere.xml", "--sample", "1")
    assert status == 0
    assert "renderer: made with NVIDIA " in said
    assert "guaranteed is the motion of all that no image steers" in said
    assert "processor: made with abacus, replayed with" in said


def test_a_benchmark_that_is_nowhere_is_asked_for(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "b.xml").unlink()
    status, said = verify(capsys)
    assert status == 2
    assert "is not found; name it with --benchmark" in said


@pytest.mark.parametrize(
    ("was", "now", "wrong"),
    [
        ('"seed": 3', '"seed": "x"', "run.seed is 'x'; expected a whole number from 0"),
        ('"algorithm": "esm"', '"algorithm": "esn"', "No algorithm is called 'esn'"),
        ('"benchmark": [', '"benchmark": ["b", ', "inputs.benchmark is ["),
        ('"ARM5E_part0": "sha256:', '"ARM5E_part0": "sha256:0', "made with other files: robot"),
    ],
)
def test_a_result_that_cannot_be_replayed_says_why(
    folder: Path, capsys: pytest.CaptureFixture[str], was: str, now: str, wrong: str
) -> None:
    path = folder / "out" / "result.json"
    text = path.read_text().replace("robot/ARM5E/ARM5E_part0", "ARM5E_part0")
    assert was in text
    text = text.replace(was, now, 1).replace("ARM5E_part0", "robot/ARM5E/ARM5E_part0")
    path.write_text(text)
    status, said = verify(capsys)
    assert status == 2
    assert wrong in said
    assert len(said.splitlines()) == 1


def test_which_units_are_replayed_is_drawn_anew_and_can_be_drawn_again(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn = iter([7, 4_000_000_000])
    monkeypatch.setattr("secrets.randbelow", lambda n: next(drawn))
    monkeypatch.setattr("uwsim.verify.verify.verify", lambda *_, **__: Verification())
    for number in (7, 4_000_000_000):
        _, said = verify(capsys, "--sample", "1")
        line = "sample: 1 of 2 trials, at random; the same again: uwsim verify "
        assert line in said
        assert f" --sample 1 --sample-seed {number}\n" in said
    assert "--sample-seed 12\n" in verify(capsys, "--sample", "1", "--sample-seed", "12")[1]
    assert "sample" not in verify(capsys, "--all", "--sample-seed", "12")[1]


@pytest.mark.parametrize(
    ("column", "said"),
    [
        ("total", "row 1, column total: 9.5 there, {total!r} by 'corners' of the row's values"),
        ("corners.mean", "row 1, column corners: {total!r} there, 9.5 by corners.mean, which it"),
        ("status", "row 1, column total: {total!r} there, None by 'corners' of the"),
    ],
)
def test_a_forged_total_or_value_is_found_though_units_and_result_agree(
    folder: Path, column: str, said: str
) -> None:
    result = load(folder / "out")
    plan = make_plan(PlanRequest(benchmark="b.xml", seed=3, repeat=1))
    assert list(contradictions(result, plan.benchmark)) == []
    row = list(result.rows[1])
    row[result.index(column)] = "lost" if column == "status" else 9.5
    forged = replace(result, rows=(result.rows[0], tuple(row)))
    found = [str(each) for each in contradictions(forged, plan.benchmark)]
    total = result.values("total")[1]
    assert [each.startswith(f"result.json: {said.format(total=total)}") for each in found] == [True]


def test_a_sample_is_chosen_by_its_seed_and_keeps_the_order() -> None:
    trials: list[Any] = list(range(50))
    samples = {choose_trials(trials, 3, seed) for seed in range(20)}
    assert len(samples) > 15
    assert all(list(sample) == sorted(set(sample)) for sample in samples)
    assert choose_trials(trials, 3, 4) == choose_trials(trials, 3, 4)
    assert choose_trials(trials, None, 0) == choose_trials(trials, 60, 0) == tuple(trials)


def test_leaves_are_compared_as_text() -> None:
    assert leaves({"a": [0.0, {"b": None}], "c": []}) == {
        ("a", 0): "0.0", ("a", 1, "b"): "null", ("c",): "[]",
    }  # fmt: skip
    assert row_differences({"total": 0.0}, {"total": -0.0}) == [
        "column total: stored 0.0, replayed -0.0"
    ]
    assert row_differences({"logs": 7}, {"logs": {"a": [[0.0, 1.0]]}}) != []


def test_tables_are_compared_by_line_and_column() -> None:
    assert text_difference("a,b\n1,2\n", "a,b\n1,2\n") is None
    assert (
        text_difference("a,b\n1,2\n", "a,b\n1,3\n") == "line 2, column b: '2' there, '3' expected"
    )
    assert text_difference("a,b\n1,2\n", "a,b\n") == "line 2: '1,2' there, '' expected"
    assert text_difference("a,b", "a,b\n") == "1 lines there, 2 expected"


@pytest.mark.parametrize("harm", ["gone", "junk"])
def test_a_unit_that_is_gone_or_junk_is_named_and_nothing_is_held_against_the_other(
    folder: Path, capsys: pytest.CaptureFixture[str], harm: str
) -> None:
    file = folder / "out" / "units" / "00000.jsonl"
    file.unlink() if harm == "gone" else file.write_bytes(b"\xff\x00 no unit\n")
    what = "is absent" if harm == "gone" else "0 rows can be read"
    status, said = verify(capsys)
    assert status == 3
    assert said.splitlines()[2:] == [
        f"units/00000.jsonl: trial 0 (seed 3): {what}; result.json has 1 of it",
        "not compared: result.json and the files next to it: units/ is incomplete",
        "DIFFERS: all of 1 trial replayed, 1 level. Every replayed trial gave its stored values; "
        "other parts of the result differ.",
    ]


@pytest.mark.parametrize("at", [20, 200, -30])
def test_a_motion_track_that_is_damaged_is_named(
    folder: Path, capsys: pytest.CaptureFixture[str], at: int
) -> None:
    file = folder / "out" / "units" / "00001.motion"
    data = bytearray(file.read_bytes())
    data[at] ^= 0xFF
    file.write_bytes(data)
    status, said = verify(capsys, "--sample", "1")
    assert status == 3
    assert "units/00001.motion: is no motion track" in said


def test_a_motion_track_that_is_gone_is_not_compared(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "out" / "units" / "00001.motion").unlink()
    status, said = verify(capsys, "--sample", "1")
    assert status == 0
    assert "not compared: units/00001.motion: is absent" in said


@pytest.mark.slow
def test_what_was_typed_in_a_folder_above_is_found_there(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "own" / "scenes").mkdir(parents=True)
    text = (folder / "b.xml").read_text().replace('"tank.xml"', '"scenes/tank.xml"')
    (folder / "b.xml").unlink()
    (folder / "own" / "b.xml").write_text(text)
    (folder / "tank.xml").rename(folder / "own" / "scenes" / "tank.xml")
    assert main(["bench", "own/b.xml", "--out", "o/m"]) == 0
    capsys.readouterr()
    said = (folder / "o" / "m" / "result.json").read_text()
    assert "own/" not in said
    assert "uwsim bench own/b.xml" in (folder / "o" / "m" / "report.html").read_text()
    assert main(["verify", "o/m"]) == 0
    monkeypatch.chdir(folder / "o" / "m")
    assert main(["verify", "."]) == 0
    (folder / "o" / "m" / "result.json").unlink()
    monkeypatch.chdir(folder)
    assert main(["report", "o/m"]) == 2
    assert "uwsim bench own/b.xml --out o/m --resume" in capsys.readouterr().err
    assert main(["bench", "own/b.xml", "--out", "o/m", "--resume"]) == 0
    assert (folder / "o" / "m" / "result.json").read_text() == said


@pytest.mark.slow
def test_an_algorithm_of_a_file_runs_in_workers_and_is_found_again_where_it_was(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    program = tmp_path / "hold.py"
    program.write_text(
        "from uwsim.algorithms import FrozenTracker\n\n\nclass Hold(FrozenTracker):\n    pass\n"
    )
    call = ["bench", str(write_benchmark(tmp_path, "0.2")), "--algorithm", f"{program}:Hold"]
    assert main([*call, "--out", str(tmp_path / "out")]) == 0
    assert main(["verify", str(tmp_path / "out")]) == 0
    assert "the same, byte for byte" in capsys.readouterr().out
    program.write_text(program.read_text() + "# changed\n")
    assert main(["verify", str(tmp_path / "out")]) == 2
    assert "The result was made with the plugin hold.py" in capsys.readouterr().err
