"""The script that runs a campaign on Slurm: an array of tasks, and then a job that merges them.

Not modelled: nodes, GPUs, and reservations. Options of ``sbatch`` that are not written in the
script can be set by its environment variables (``SBATCH_RESERVATION``).
"""

from __future__ import annotations

import re
import shlex
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from ..errors import BadSetting
from .cluster_run import THREAD_VARIABLES, ClusterRun

DEFAULT_MAX_ARRAY_SIZE = 1001
"""The default of ``MaxArraySize``; the greatest index of a task is one less."""
TIME = re.compile(r"(\d{1,5}-\d{1,5}(:\d{1,5}){0,2}|\d{1,7}(:\d{1,5}){0,2})", re.ASCII)
"""The form of a time limit: minutes, MINUTES:SECONDS, HOURS:MINUTES:SECONDS, DAYS-HOURS..."""
PATIENCE_S = 10.0
"""The time in which ``scontrol`` must answer [s]."""


@dataclass(frozen=True, kw_only=True)
class SlurmJob:
    """A campaign on Slurm."""

    run: ClusterRun
    """The campaign."""
    time: str | None = None
    """The time limit of a task; None for that of the partition."""
    partition: str | None = None
    """The partition; None for the cluster's default."""
    account: str | None = None
    """The account; None for the user's default."""
    container: Path | None = None
    """The image in which uwsim is run by Apptainer; None without."""
    setup: tuple[str, ...] = ()
    """The shell commands that each task runs first, such as ``module load``."""

    def __post_init__(self) -> None:
        """Check the options that ``sbatch`` would misread; raise BadSetting."""
        if self.time is not None and not TIME.fullmatch(self.time):
            raise BadSetting(
                f"--time {self.time}: expected HOURS:MINUTES:SECONDS, minutes, or DAYS-HOURS."
            )
        for name, value in (("--partition", self.partition), ("--account", self.account)):
            if value is not None and not re.fullmatch(r"[\w.,+-]+", value):
                raise BadSetting(f"{name} {value}: expected a name of letters, digits and _.,+-")
        for command in self.setup:
            if re.search(r"[\r\n]", command):
                raise BadSetting("--setup: expected commands of one line each.")

    def limit_tasks(self, max_array_size: int) -> SlurmJob:
        """Return the job with at most as many tasks as an array may have, and larger shards."""
        n_tasks = min(self.run.n_tasks, max_array_size - 1)
        return replace(self, run=replace(self.run, n_tasks=n_tasks))

    def script(self) -> str:
        """Return the bash script that submits the array and the merge."""
        run = self.run
        limit = "" if run.n_parallel is None else f"%{run.n_parallel}"
        task = self._job(
            run.name,
            [f"--array=1-{run.n_tasks}{limit}", "--requeue", *self._output("%a")],
            run.shard_command("$SLURM_ARRAY_TASK_ID", self._uwsim()),
        )
        merge = self._job(
            f"{run.name}-merge", self._output("merge"), run.merge_command(self._uwsim())
        )
        logs = shlex.quote(str(self._logs))
        return "\n".join(
            [
                "#!/bin/bash",
                f"# {run.description}",
                f"# in {run.n_tasks} tasks of Slurm, and their merge. Submit with: bash FILE",
                "# Submitted again, it runs what is missing.",
                "set -euo pipefail",
                f"mkdir -p {logs}",
                "array=$(sbatch --parsable <<'UWSIM_TASK'",
                *task,
                "UWSIM_TASK",
                ")",
                "array=${array%%;*}",
                "merge=$(sbatch --parsable --dependency=afterok:$array "
                "--kill-on-invalid-dep=yes <<'UWSIM_MERGE'",
                *merge,
                "UWSIM_MERGE",
                ")",
                f'echo "array $array, merge ${{merge%%;*}}, output in" {logs}',
                "",
            ]
        )

    @property
    def _logs(self) -> Path:
        """The folder with the output of tasks, beside the result directory."""
        return self.run.out.with_name(f"{self.run.out.name}.slurm")

    def _output(self, name: str) -> list[str]:
        path = str(self._logs).replace("%", "%%")
        return ["--open-mode=append", f"--output={shlex.quote(f'{path}/{name}.log')}"]

    def _job(self, name: str, options: list[str], command: str) -> Iterator[str]:
        """Yield the lines of a batch script."""
        run = self.run
        limits = {"time": self.time, "partition": self.partition, "account": self.account}
        all_options = [
            f"--job-name={name}",
            *options,
            "--ntasks=1",
            f"--cpus-per-task={run.n_processors}",
            f"--mem={run.memory}",
            f"--chdir={shlex.quote(str(run.folder))}",
            *(f"--{option}={value}" for option, value in limits.items() if value is not None),
        ]
        yield "#!/bin/bash"
        yield from (f"#SBATCH {option}" for option in all_options)
        yield "set -eo pipefail"
        yield "export " + " ".join(f"{variable}={value}" for variable, value in THREAD_VARIABLES)
        yield from self.setup
        yield f"srun --ntasks=1 --cpus-per-task={run.n_processors} --cpu-bind=cores {command}"

    def _uwsim(self) -> list[str]:
        """Return the words that start uwsim in a task."""
        if self.container is None:
            return ["uwsim"]
        folders = dict.fromkeys([self.run.folder, self.run.out.parent, *self.run.data_path])
        binds = [word for folder in folders for word in ("--bind", str(folder))]
        folder, image = str(self.run.folder), str(self.container)
        return ["apptainer", "exec", *binds, "--pwd", folder, image, "uwsim"]


def read_max_array_size() -> int | None:
    """Return ``MaxArraySize`` of the cluster; None if ``scontrol`` does not report it."""
    try:
        process = subprocess.run(
            ["scontrol", "show", "config"],
            capture_output=True,
            text=True,
            timeout=PATIENCE_S,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired):
        return None
    match = re.search(r"^MaxArraySize\s*=\s*(\d+)", process.stdout, re.MULTILINE)
    return int(match[1]) if match and int(match[1]) > 1 else None
