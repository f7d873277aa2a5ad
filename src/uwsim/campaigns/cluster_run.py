"""A call of uwsim that a cluster divides into tasks, one for each shard."""

from __future__ import annotations

import re
import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import BadSetting

BENCH = ("bench",)
"""The command whose shards are merged by ``uwsim merge``."""
MAX_NAME_LENGTH = 40
"""The greatest length of the name of a job; Kubernetes allows 63 with its own suffixes."""
THREAD_VARIABLES = (
    ("LP_NUM_THREADS", 0),
    ("NUMBA_NUM_THREADS", 1),
    ("OMP_NUM_THREADS", 1),
    ("OPENBLAS_NUM_THREADS", 1),
)
"""The environment of a task: each library uses one thread. Mesa's 0 is the thread of its caller."""


@dataclass(frozen=True, kw_only=True)
class ClusterRun:
    """The tasks of a campaign, and the resources of each."""

    command: tuple[str, ...]
    """The command of uwsim, such as ``bench`` or ``suite run``."""
    words: tuple[str, ...]
    """The words after the command: the benchmark or suite, and options, without ``--shard``."""
    out: Path
    """The result directory, an absolute path that all machines share."""
    folder: Path
    """The folder in which tasks run, an absolute path that all machines share."""
    data_path: tuple[Path, ...]
    """The folders in which files are searched."""
    n_tasks: int
    """The number of tasks, which is the number of shards."""
    n_parallel: int | None
    """The number of tasks that run at the same time; None: as the cluster decides."""
    n_processors: int
    """The number of processors of a task, one for each of its workers."""
    memory: str
    """The memory of a task, such as ``2G``: a number, and K, M, G or T for powers of 1024."""
    subject: str
    """The name or file of the benchmark or suite."""

    def __post_init__(self) -> None:
        """Check the paths and the memory; raise BadSetting."""
        for path in (self.out, self.folder, *self.data_path):
            if re.search(r"[\0-\x1f\x7f]", str(path)):
                raise BadSetting(f"{str(path)!r}: expected a path without control characters.")
        if not re.fullmatch(r"[1-9]\d{0,8}[KMGT]", self.memory, re.ASCII):
            raise BadSetting(f"--memory {self.memory}: expected a number and a unit, such as 2G.")

    @property
    def name(self) -> str:
        """The name of the job: ``uwsim-`` and the subject, in lower case letters and digits."""
        stem = re.sub(r"[^a-z0-9]+", "-", Path(self.subject).stem.lower())
        return f"uwsim-{stem}"[:MAX_NAME_LENGTH].strip("-")

    def shard_command(self, number: str, prefix: Sequence[str] = ("uwsim",)) -> str:
        """Return the shell command of a task.

        Args:
            number: the shell expression for the number of the shard, from 1.
            prefix: the words that start uwsim.
        """
        shard = f'--shard "{number}/{self.n_tasks}"'
        return f"{shlex.join([*prefix, *self.command])} {shard} {shlex.join(self.words)}"

    def merge_command(self, prefix: Sequence[str] = ("uwsim",)) -> str:
        """Return the shell command that merges the campaign.

        A command of a suite merges its own shards: it is called without ``--shard``.
        """
        if self.command != BENCH:
            return shlex.join([*prefix, *self.command, *self.words])
        folders = [word for path in self.data_path for word in ("--data-path", str(path))]
        return shlex.join([*prefix, "merge", str(self.out), *folders])

    @property
    def description(self) -> str:
        """The command that the tasks run together, in one line."""
        return re.sub(r"[\r\n]", " ", shlex.join(["uwsim", *self.command, *self.words]))
