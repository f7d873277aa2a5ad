"""The scripts, jobs and images for clusters are valid, and run the shards of the whole campaign."""

from __future__ import annotations

import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from ruamel.yaml import YAML

from tests.support.blind_benchmark import write_blind_benchmark
from tests.support.short_benchmark import fingerprint
from uwsim.campaigns.container import LAUNCHER
from uwsim.cli.app import main

BENCH = ["--", "bench", "currents", "--repeat", "3", "--set", "a=$(x) 'b'"]
JOB_FIELDS = {
    *("completionMode", "completions", "parallelism", "backoffLimit", "backoffLimitPerIndex"),
    *("podFailurePolicy", "suspend", "template"),
}
POD_FIELDS = {"restartPolicy", "containers", "volumes"}
CONTAINER_FIELDS = {
    *("name", "image", "command", "workingDir", "env", "resources", "volumeMounts"),
}
"""Fields of JobSpec (batch/v1), PodSpec and Container of the Kubernetes API."""
FAKE_SBATCH = """#!/bin/bash
# Run the tasks of a job in turn, in this process, under the number 7.
script=$(mktemp); cat >"$script"; echo "$@" >>"$SBATCH_LOG"
option() { sed -n "s/^#SBATCH --$1=//p" "$script"; }
cd "$(eval echo "$(option chdir)")"
last=$(option array | sed 's/^1-//; s/%.*//')
for SLURM_ARRAY_TASK_ID in $(seq "${last:-1}"); do
    export SLURM_ARRAY_TASK_ID
    bash "$script" >>"$SBATCH_LOG" 2>&1 || exit 1
done
echo "7;cluster"
"""
FAKE_SRUN = """#!/bin/bash
while [[ $1 == --* ]]; do shift; done
exec "$@"
"""


@pytest.fixture
def programs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Put a folder in place of the search path, without Slurm, and run in another."""
    folder, work = tmp_path / "bin", tmp_path / "work"
    folder.mkdir()
    work.mkdir()
    write_program(
        folder / "uwsim", f'#!/bin/bash\nexec {shlex.quote(sys.executable)} -m uwsim "$@"\n'
    )
    for name in ("bash", "cat", "mktemp", "sed", "seq", "mkdir", "sh"):
        (folder / name).symlink_to(f"/bin/{name}")
    monkeypatch.setenv("PATH", str(folder))
    monkeypatch.chdir(work)
    return folder


def write_program(path: Path, text: str) -> None:
    path.write_text(text)
    path.chmod(0o755)


def printed(capsys: pytest.CaptureFixture[str], words: list[str]) -> str:
    assert main(words) == 0
    return capsys.readouterr().out


def run_bash(script: str, *words: str) -> subprocess.CompletedProcess[str]:
    command = ["bash", *words]
    return subprocess.run(command, input=script, capture_output=True, text=True, check=False)


def test_the_script_for_slurm_is_valid_and_keeps_the_words_of_the_call(
    programs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["slurm", "--tasks", "20", "--parallel", "5", "--time", "1-0", "--setup", "ml x"]
    script = printed(capsys, [*words, *BENCH, "--workers", "2", "--out", "/a b/x.result"])
    assert run_bash(script, "-n").stderr == ""
    options = [line.removeprefix("#SBATCH ") for line in script.splitlines() if "SBATCH" in line]
    for option in ("--array=1-20%5", "--requeue", "--cpus-per-task=2", "--time=1-0"):
        assert option in options
    assert "\nml x\nsrun " in script
    task = next(line for line in script.splitlines() if line.startswith("srun"))
    show = f"SLURM_ARRAY_TASK_ID=3; srun() {{ printf '%s\\n' \"$@\"; }}; {task}"
    shown = run_bash(show).stdout.splitlines()
    assert shown[shown.index("uwsim") :][:4] == ["uwsim", "bench", "--shard", "3/20"]
    assert shown[-6:] == ["--set", BENCH[-1], "--workers", "2", "--out", "/a b/x.result"]


@pytest.mark.parametrize(
    "call",
    [
        ["suite", "run", "intervention", "--algorithm", "position-pi", "--tasks", "station"],
        ["suite", "table", "intervention", "--seeds", "2"],
    ],
)
def test_the_shards_of_a_suite_are_merged_by_the_call_itself(
    programs: Path, capsys: pytest.CaptureFixture[str], call: list[str]
) -> None:
    words = [*call, "--out", "/shared/x"]
    script = printed(capsys, ["slurm", "--tasks", "9", "--", *words])
    task, merge = (line for line in script.splitlines() if line.startswith("srun"))
    shard = ["--shard", '"$SLURM_ARRAY_TASK_ID/9"']
    assert task.endswith(" ".join(["uwsim", *words[:2], *shard, *words[2:]]))
    assert merge.endswith(" ".join(["uwsim", *words]))
    assert "--job-name=uwsim-intervention\n" in script
    volume = ["--image", "u", "--volume-claim", "c", "--mount", "/shared"]
    manifest = printed(capsys, ["kubernetes", *volume, "--tasks", "9", "--", *words])
    assert f"exec {' '.join(['uwsim', *words])}" in manifest


def test_a_script_has_no_more_tasks_than_the_arrays_of_the_cluster(
    programs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["slurm", "--tasks", "5000", *BENCH, "--out", "/x"]
    assert main(words) == 0
    shown = capsys.readouterr()
    assert "--array=1-1000\n" in shown.out
    assert "/1000" in shown.out
    assert "MaxArraySize is 1001 (the default, as scontrol is not here)" in shown.err
    write_program(programs / "scontrol", "#!/bin/bash\necho 'MaxArraySize            = 4001'\n")
    assert main(words) == 0
    shown = capsys.readouterr()
    assert "--array=1-4000\n" in shown.out
    assert "MaxArraySize is 4001 (of this cluster)" in shown.err


def test_a_task_in_a_container_sees_the_folders_of_the_run(
    programs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    script = printed(capsys, ["slurm", "--container", "u.sif", *BENCH, "--out", "/shared/x"])
    here = Path.cwd()
    start = f"apptainer exec --bind {here} --bind /shared --pwd {here} {here}/u.sif uwsim"
    assert f"{start} bench --shard" in script
    assert f"{start} merge /shared/x" in script


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["slurm", "--", "bench", "currents", "--rpeat", "3"], "No such option: --rpeat"),
        (["slurm", *BENCH], "no --out: expected an absolute --out"),
        (["slurm", *BENCH, "--out", "x"], "--out x: expected an absolute --out"),
        (["slurm", *BENCH, "--out", "/x", "--shard", "1/2"], "--shard cannot be given"),
        (["slurm", *BENCH, "--out", "/x", "--resume"], "--resume cannot be given"),
        (["slurm", *BENCH, "--out", "/x", "--workers", "ray"], "--workers ray: expected a number"),
        (["slurm", "--", "check", "a.xml"], "check a.xml: expected -- bench BENCHMARK"),
        (["slurm", "--", "suite", "run", "intervention", "--out", "x"], "--out x: expected an abs"),
        (["slurm", "--", "suite", "verify", "/x"], "suite verify: expected -- bench BENCHMARK"),
        (["slurm", "--time", "5h", *BENCH, "--out", "/x"], "--time 5h: expected HOURS"),
        (["slurm", "--memory", "2", *BENCH, "--out", "/x"], "--memory 2: expected a number and"),
        (["slurm", "--partition", "a b", *BENCH, "--out", "/x"], "--partition a b: expected"),
        (["slurm", "--setup", "a\nb", *BENCH, "--out", "/x"], "--setup: expected commands of one"),
        (["slurm", *BENCH, "--out", "/x\ny"], "expected a path without control characters"),
        (["kubernetes", *BENCH, "--out", "/shared/x"], "Missing option"),
        (["container", "sif"], "'sif' is not one of"),
        (["container", "oci", "--wheel", "uwsim"], "--wheel uwsim: expected a file .whl"),
    ],
)
def test_a_call_that_tasks_cannot_run_is_refused_in_one_line(
    programs: Path, capsys: pytest.CaptureFixture[str], words: list[str], said: str
) -> None:
    assert main(words) == 2
    shown = capsys.readouterr()
    assert said in shown.err
    assert shown.out == ""


KUBERNETES = ["kubernetes", "--tasks", "20", "--image", "r/uwsim:1", "--volume-claim", "shared"]


def test_the_jobs_for_kubernetes_have_fields_of_its_api_and_run_each_shard(
    programs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = printed(capsys, [*KUBERNETES, *BENCH, "--out", "/campaign/x.result"])
    tasks, merge = YAML(typ="safe").load_all(text)
    for job in (tasks, merge):
        assert (job["apiVersion"], job["kind"]) == ("batch/v1", "Job")
        assert set(job["spec"]) <= JOB_FIELDS
        pod = job["spec"]["template"]["spec"]
        assert set(pod) == POD_FIELDS
        assert pod["restartPolicy"] == "Never"  # as limits for each index require
        assert set(pod["containers"][0]) == CONTAINER_FIELDS
        assert all(type(entry["value"]) is str for entry in pod["containers"][0]["env"])
    spec = tasks["spec"]
    assert (spec["completionMode"], spec["completions"]) == ("Indexed", 20)
    assert spec["backoffLimitPerIndex"] > 0
    assert merge["spec"]["suspend"] is True
    shown = run_command(tasks, "4")
    assert shown[:4] == ["uwsim", "bench", "--shard", "5/20"]
    assert shown[-4:] == ["--set", BENCH[-1], "--out", "/campaign/x.result"]
    assert run_command(merge, "0") == ["uwsim", "merge", "/campaign/x.result"]


def run_command(job: Any, index: str) -> list[str]:
    """Return the words that a container runs, after the expansion by Kubernetes."""
    shell, option, command = job["spec"]["template"]["spec"]["containers"][0]["command"]
    assert (shell, option) == ("/bin/sh", "-c")
    script = command.replace("$$", "$").removeprefix("exec ")
    setup = f"JOB_COMPLETION_INDEX={index}; uwsim() {{ printf '%s\\n' uwsim \"$@\"; }}; "
    return run_bash(setup + script).stdout.splitlines()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ([*KUBERNETES, *BENCH, "--out", "/x"], "expected a path below /campaign"),
        ([*KUBERNETES, "--mount", "x", *BENCH, "--out", "/x"], "--mount x: expected an absolute"),
        ([*KUBERNETES, "--tasks", "200000", *BENCH, "--out", "/campaign/x"], "at most 100000"),
    ],
)
def test_a_job_that_kubernetes_cannot_run_is_refused(
    programs: Path, capsys: pytest.CaptureFixture[str], words: list[str], said: str
) -> None:
    assert main(words) == 2
    assert said in capsys.readouterr().err


def test_both_images_are_built_by_the_same_commands(capsys: pytest.CaptureFixture[str]) -> None:
    extra = ["--extra", "export"]
    definition = printed(capsys, ["container", "apptainer", *extra])
    container_file = printed(capsys, ["container", "oci", *extra])
    build = definition.partition("%post\n")[2].partition("\n\n")[0].splitlines()
    run = container_file.partition("RUN ")[2].partition("\nENTRYPOINT")[0]
    assert [line.strip() for line in build] == run.split(" && \\\n    ")
    assert run_bash("\n".join(build), "-n").stderr == ""
    assert "[export]" in run
    (launcher,) = (line for line in build if "printf" in line)
    assert run_bash(launcher.partition(" > ")[0]).stdout == LAUNCHER


@pytest.mark.slow
def test_tasks_of_a_script_that_run_in_turn_leave_the_bytes_of_one_run(
    programs: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    write_blind_benchmark(Path.cwd(), levels=3)
    log, out = Path.cwd() / "log", Path.cwd() / "shared folder" / "x.result"
    monkeypatch.setenv("SBATCH_LOG", str(log))
    write_program(programs / "sbatch", FAKE_SBATCH)
    write_program(programs / "srun", FAKE_SRUN)
    bench = ["bench", "blind.xml", "--mode", "independent"]
    script = printed(capsys, ["slurm", "--tasks", "2", "--", *bench, "--out", str(out)])
    done = run_bash(script)
    assert done.stderr == "", log.read_text()
    assert done.stdout == f"array 7, merge 7, output in {out}.slurm\n"
    assert "--dependency=afterok:7 --kill-on-invalid-dep=yes" in log.read_text()
    assert main([*bench, "--out", "whole"]) == 0
    assert fingerprint(out) == fingerprint(Path("whole"))
    assert sorted(path.name for path in out.parent.iterdir()) == ["x.result", "x.result.slurm"]
