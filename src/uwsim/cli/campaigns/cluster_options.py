"""The options of the commands that divide a call of ``uwsim bench`` among the tasks of a cluster.

The call follows ``--``, and is read as ``uwsim bench`` reads it, so that an unknown option is an
error before anything is submitted.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.main import get_command

from ...campaigns.cluster_run import ClusterRun
from ...campaigns.shard import MAX_SHARDS
from ...errors import BadSetting
from ...runs.executors.choose import RAY
from ..app import build_application
from ..options.help_texts import RUN, option

COMMAND = "bench"
EXCLUDED_PARAMETERS = ("shard", "resume", "overwrite", "view")
"""The names of the parameters of ``uwsim bench`` that are refused."""

BenchArgument = Annotated[
    list[str],
    typer.Argument(
        metavar="-- bench ARGUMENTS",
        help="The call of `uwsim bench`, with an absolute --out that all machines share.",
        show_default=False,
    ),
]


@dataclass(frozen=True, kw_only=True)
class ClusterOptions:
    """The options of the tasks of a cluster."""

    bench: BenchArgument
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
            BadSetting: the call is not one of ``uwsim bench``, or cannot run in shards.
        """
        if self.bench[0] != COMMAND:
            raise BadSetting(f"{self.bench[0]}: expected -- bench BENCHMARK ... --out DIR.")
        words = self.bench[1:]
        values = _read_bench(words)
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
            words=tuple(words),
            out=out,
            folder=folder,
            data_path=tuple(values["data_path"] or ()),
            n_tasks=self.tasks,
            n_parallel=self.n_parallel,
            n_processors=max(1, int(values["workers"])),
            memory=self.memory,
            benchmark=values["benchmark"],
        )


def _read_bench(words: Sequence[str]) -> dict[str, Any]:
    """Return the values of the parameters of ``uwsim bench``; raise the error of a wrong one."""
    command: Any = get_command(build_application([COMMAND]))
    context = command.commands[COMMAND].make_context(f"uwsim {COMMAND}", list(words))
    values: dict[str, Any] = context.params
    return values
