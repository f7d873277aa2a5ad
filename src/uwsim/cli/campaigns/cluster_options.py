"""The options of the commands that divide a call of uwsim among the tasks of a cluster.

The call follows ``--``, and is read as its command reads it, so that an unknown option is an error
before anything is submitted.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.main import get_command

from ...campaigns.cluster_run import BENCH, ClusterRun
from ...campaigns.shard import MAX_SHARDS
from ...errors import BadSetting
from ...runs.executors.choose import RAY
from ..app import build_application
from ..options.help_texts import RUN, option

COMMANDS = (BENCH, ("suite", "run"), ("suite", "table"))
"""The commands that can run in shards."""
EXCLUDED_PARAMETERS = ("shard", "resume", "overwrite", "view")
"""The names of the parameters of these commands that are refused."""

CallArgument = Annotated[
    list[str],
    typer.Argument(
        metavar="-- COMMAND ARGUMENTS",
        help="The call of `uwsim bench`, `uwsim suite run` or `uwsim suite table`, with an "
        "absolute --out that all machines share.",
        show_default=False,
    ),
]


@dataclass(frozen=True, kw_only=True)
class ClusterOptions:
    """The options of the tasks of a cluster."""

    call: CallArgument
    tasks: Annotated[
        int,
        option(
            RUN,
            "--tasks",
            metavar="N",
            min=1,
            max=MAX_SHARDS,
            help="The number of tasks, each with a part of the trials.",
        ),
    ] = 100
    n_parallel: Annotated[
        int | None,
        option(
            RUN,
            "--parallel",
            metavar="M",
            min=1,
            help="The greatest number of tasks that run at the same time [as the cluster decides].",
        ),
    ] = None
    memory: Annotated[
        str,
        option(RUN, "--memory", metavar="SIZE", help="The memory of a task, such as 500M or 4G."),
    ] = "2G"

    def cluster_run(self, folder: Path) -> ClusterRun:
        """Return the tasks.

        Args:
            folder: the folder in which tasks run.

        Raises:
            BadSetting: the call is of another command, or cannot run in shards.
        """
        command = next((c for c in COMMANDS if tuple(self.call[: len(c)]) == c), None)
        if command is None:
            raise BadSetting(
                f"{' '.join(self.call[:2])}: expected -- bench BENCHMARK ... --out DIR, or suite "
                "run, or suite table."
            )
        words = self.call[len(command) :]
        values = _read_call(command, words)
        for name in EXCLUDED_PARAMETERS:
            if values.get(name):
                raise BadSetting(
                    f"--{name} cannot be given to the tasks of a cluster; leave it out."
                )
        out: Path | None = values["out"]
        if out is None or not out.is_absolute():
            value = "no --out" if out is None else f"--out {out}"
            raise BadSetting(f"{value}: expected an absolute --out that all machines share.")
        if values["workers"] == RAY:
            raise BadSetting(f"--workers {RAY}: expected a number of processes of a task.")
        return ClusterRun(
            command=command,
            words=tuple(words),
            out=out,
            folder=folder,
            data_path=tuple(values.get("data_path") or ()),
            n_tasks=self.tasks,
            n_parallel=self.n_parallel,
            n_processors=max(1, int(values["workers"])),
            memory=self.memory,
            subject=values["benchmark" if command == BENCH else "suite"],
        )


def _read_call(command: Sequence[str], words: Sequence[str]) -> dict[str, Any]:
    """Return the values of the parameters of a command; raise the error of a wrong one."""
    parser: Any = get_command(build_application(command))
    for name in command:
        parser = parser.commands[name]
    context = parser.make_context(" ".join(["uwsim", *command]), list(words))
    values: dict[str, Any] = context.params
    return values
