"""``uwsim slurm``: print the script that runs a benchmark or suite on a Slurm cluster."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from ...base.terminal import warn
from ...campaigns.slurm import DEFAULT_MAX_ARRAY_SIZE, SlurmJob, read_max_array_size
from ..options.help_texts import RUN, option
from .cluster_options import ClusterOptions


def slurm(
    options: ClusterOptions,
    time: Annotated[
        str | None,
        option(RUN, "--time", metavar="H:M:S", help="The time limit of a task [the partition's]."),
    ] = None,
    partition: Annotated[
        str | None, option(RUN, "--partition", metavar="NAME", help="The partition.")
    ] = None,
    account: Annotated[
        str | None, option(RUN, "--account", metavar="NAME", help="The account.")
    ] = None,
    container: Annotated[
        Path | None,
        option(
            RUN,
            "--container",
            metavar="FILE.sif",
            help="Run uwsim in an image of Apptainer (`uwsim container`).",
        ),
    ] = None,
    setup: Annotated[
        list[str] | None,
        option(
            RUN,
            "--setup",
            metavar="COMMAND",
            help="Shell command that each task runs first, such as 'module load apptainer'; may be "
            "repeated.",
        ),
    ] = None,
) -> None:
    """Print a script that runs a benchmark or suite on Slurm.

    `bash job.sh` submits an array of tasks, one for each shard (`--shard`), and a job
    that merges them when all have ended well. Submitted again, it runs what is missing. Tasks run
    in this folder, each with one processor per worker; preempted tasks are queued again.
    """
    job = SlurmJob(
        run=options.cluster_run(Path.cwd()),
        time=time,
        partition=partition,
        account=account,
        container=None if container is None else container.absolute(),
        setup=tuple(setup or ()),
    )
    size = read_max_array_size()
    limited_job = job.limit_tasks(size or DEFAULT_MAX_ARRAY_SIZE)
    if limited_job != job:
        source = "the default, as scontrol is not here" if size is None else "of this cluster"
        warn(
            f"--tasks {job.run.n_tasks}: MaxArraySize is {size or DEFAULT_MAX_ARRAY_SIZE} "
            f"({source}); the script has {limited_job.run.n_tasks} tasks with more trials each"
        )
    print(limited_job.script(), end="")
