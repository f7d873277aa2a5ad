"""An executor on a Ray cluster: the one that ``RAY_ADDRESS`` names, else one made here for the run.

No file system is shared. Rows and images come back level by level and are kept here, as though
they had been run here; a worker whose machine has other files, versions or another renderer
says so before it begins. What is run must be installed there: uwsim, and a user's own files under
the same paths (``ray job submit --working-dir`` brings them).
"""

from __future__ import annotations

import importlib
import io
import os
import platform
import secrets
import signal
import socket
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ...base.environment import select_unset, set_environment
from ...base.files.scratch import SCRATCH_VARIABLE, scratch_folder
from ...errors import BadSetting, MissingExtra, RunFailed, UwsimError
from ...results.stored.stored_row import Record
from ..planning.plan import Trial
from ..planning.trial_cache import TrialCache
from ..prepare import hash_inputs
from ..run import Run
from .executor import ENVIRONMENT, Job, JobQueue
from .worker import Event, JournalWriter, TrialEnded, TrialFailed, picklable, run_trial

ADDRESS = "RAY_ADDRESS"
STORE = 256 * 2**20
"""Memory for what travels within a cluster of our own: rows and images [bytes]."""
QUIET = {"RAY_USAGE_STATS_ENABLED": "0", "RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO": "0"}
"""No telemetry, no advice."""


class RayExecutor:
    """Workers on a Ray cluster, one for each of its processors.

    A worker that is lost, with its machine or alone, loses its trial to a fresh one. A cluster made
    here listens to this machine alone, has a token of its own, and leaves nothing behind.

    Args:
        cpus: processors of a cluster made here; without it all that this process may use.

    Raises:
        MissingExtra: Ray is not installed.
        BadSetting: no cluster at ``RAY_ADDRESS``.
    """

    def __init__(self, cpus: int | None = None) -> None:
        self._address = address()
        if self._address is None and "ray" not in sys.modules and "RAY_AUTH_MODE" not in os.environ:
            # For good: Ray reads this when it is imported, and once in a process.
            os.environ["RAY_AUTH_MODE"] = "token"
            os.environ["RAY_AUTH_TOKEN"] = secrets.token_hex(32)
        try:
            self._ray: Any = importlib.import_module("ray")
        except ImportError:
            raise MissingExtra(
                "--workers ray: Ray is not installed. Install it with: pip install uwsim[ray]"
            ) from None
        self._cpus = cpus or len(os.sched_getaffinity(0))

    def execute(self, queue: JobQueue) -> None:
        """Execute all jobs."""
        ray = self._ray
        # Ray prints on standard output what the queue reports better.
        with self._cluster(), redirect_stdout(io.StringIO()):
            n_workers = max(1, int(ray.cluster_resources().get("CPU", 1)))
            remote = ray.remote(num_cpus=1, max_restarts=0)(RayWorker)
            remote = remote.options(runtime_env={"env_vars": select_unset(ENVIRONMENT)})
            idle: list[tuple[Any, str]] = []  # and the only algorithm that it runs
            tasks: dict[Any, AssignedJob] = {}
            try:
                while True:
                    while len(tasks) < n_workers and (job := queue.take()) is not None:
                        name = job.run.plan.algorithm.name
                        while idle and idle[-1][1] != name:  # no process sees two algorithms
                            ray.kill(idle.pop()[0])
                        task = AssignedJob(job, idle.pop()[0] if idle else remote.remote())
                        tasks[task.begin()] = task
                    for worker, _ in idle:  # there is nothing left for them
                        ray.kill(worker)
                    idle.clear()
                    if not tasks:
                        break
                    ready, _ = ray.wait(list(tasks), num_returns=1)
                    for events in ready:
                        if self._is_over(events, tasks[events], queue):
                            task = tasks.pop(events)
                            task.writer.close()
                            if task.is_alive:
                                idle.append((task.worker, task.job.run.plan.algorithm.name))
            finally:
                for task in tasks.values():
                    task.writer.close()

    def _is_over(self, events: Any, task: AssignedJob, queue: JobQueue) -> bool:
        """Take the next event of a task; returns whether it was the last."""
        errors = self._ray.exceptions
        try:
            event = self._ray.get(next(events))
            if isinstance(event, TrialFailed):
                queue.failed(task.job, event.error)
            elif task.writer.keep(event):
                queue.level(task.job)
            elif isinstance(event, TrialEnded):
                queue.done(task.job)
            return False
        except StopIteration:
            return True
        except errors.RayTaskError as error:
            queue.failed(task.job, RunFailed(f"{task.job}: {error.cause!r}"))
        except errors.RayError as error:
            task.is_alive = False
            queue.lost(task.job, f"with {type(error).__name__}")
        except UwsimError as error:  # what came differs from what is on disk
            self._ray.kill(task.worker)
            task.is_alive = False
            queue.failed(task.job, error)
        return True

    @contextmanager
    def _cluster(self) -> Iterator[None]:
        """Connect; a cluster made for the run is stopped after it."""
        if self._ray.is_initialized():
            yield
            return
        with scratch_folder("uwsim-ray-", _short_folder()) as folder:
            try:
                with set_environment({**QUIET, SCRATCH_VARIABLE: str(folder)}), _signals_kept():
                    self._connect(str(folder))
                yield
            finally:
                self._ray.shutdown()

    def _connect(self, folder: str) -> None:
        quiet = {"logging_level": "ERROR", "log_to_driver": False}
        try:
            if self._address is not None:
                self._ray.init(address=self._address, **quiet)
            else:
                self._ray.init(
                    address="local",
                    _node_ip_address="127.0.0.1",
                    num_cpus=self._cpus,
                    object_store_memory=STORE,
                    include_dashboard=False,
                    _temp_dir=folder,
                    **quiet,
                )
        except SystemExit:  # what Ray makes of SIGTERM while it starts
            raise KeyboardInterrupt from None
        except Exception as error:  # of many kinds
            where = "a cluster here" if self._address is None else f"{ADDRESS}={self._address}"
            message = " ".join(str(error).split())
            raise RunFailed(f"--workers ray: {where} cannot be used ({message[:300]}).") from error


def address() -> str | None:
    """Return where the cluster is; None for one of our own.

    Raises:
        BadSetting: no address, or no cluster there; Ray itself would retry for minutes.
    """
    given = os.environ.get(ADDRESS, "").strip()
    if given in ("", "local"):
        return None
    if given == "auto":
        return given
    host, colon, port = given.rpartition(":")
    if not colon or not port.isdigit() or "/" in host:
        raise BadSetting(f"{ADDRESS}={given}: expected HOST:PORT of a cluster's head, or auto.")
    try:
        socket.create_connection((host.strip("[]"), int(port)), timeout=5.0).close()
    except (OSError, OverflowError, UnicodeError) as error:
        raise BadSetting(f"{ADDRESS}={given}: no answer there ({error}).") from None
    return given


@dataclass
class AssignedJob:
    """A job that a worker executes."""

    job: Job
    worker: Any
    """Ray's handle of a `RayWorker`."""
    is_alive: bool = True
    """Whether the worker can be given another."""

    def begin(self) -> Any:
        """Start the job; returns its events to come."""
        run, trial = self.job.run, self.job.trial
        self.writer = JournalWriter(run, trial)
        execute = self.worker.execute.options(num_returns="streaming")
        without_key = replace(run, seal=None)  # rows are written here
        return execute.remote(without_key, trial, run.head(trial))


class RayWorker:
    """A process in the cluster, with a renderer kept between trials."""

    def __init__(self) -> None:
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # for its employer alone
        self._cache = TrialCache()
        self._known: list[Record] = []

    def execute(self, run: Run, trial: Trial, head: Record) -> Iterator[Event | TrialFailed]:
        """Run a trial, if this machine is equivalent to the driver's; yields its events."""
        try:
            self._check(run, trial, head)
            yield from run_trial(run.plan, trial, self._cache)
        except Exception as error:
            yield TrialFailed(picklable(error))

    def _check(self, run: Run, trial: Trial, head: Record) -> None:
        """Check that the trial would be the same on the driver's machine.

        Args:
            run: whose trial it is.
            trial: the trial to run.
            head: the trial's head as the driver wrote it.

        Raises:
            RunFailed: files, versions or the renderer are not the driver's.
        """
        asked = {name: head[name] for name in ("inputs", "run")}
        if asked in self._known:
            return
        try:
            inputs, renderer = hash_inputs(run.plan, self._cache.renderers)
        except UwsimError as error:
            raise RunFailed(f"Worker on {platform.node()}: {error}") from error
        if run.plan.is_blind:
            renderer = run.renderer
        here = Run(plan=run.plan, out=run.out, inputs=inputs, renderer=renderer).head(trial)
        differences = list(_differences({name: here[name] for name in asked}, asked))
        if differences:
            raise RunFailed(
                f"Worker on {platform.node()} would not give the same result: "
                f"{'; '.join(differences)}."
            )
        self._known.append(asked)


def _differences(here: object, there: object, name: str = "") -> Iterator[str]:
    """Name what differs between two heads."""
    if isinstance(here, dict) and isinstance(there, dict):
        for key in {**there, **here}:
            yield from _differences(here.get(key), there.get(key), f"{name}.{key}".lstrip("."))
    elif here != there:
        yield f"{name} is {here!r}, not {there!r}"


def _short_folder() -> Path | None:
    """A folder short enough for sockets, whose paths may have 107 characters."""
    return short if (short := Path("/tmp")).is_dir() else None


@contextmanager
def _signals_kept() -> Iterator[None]:
    """Keep the handler of a signal that Ray would replace."""
    is_main = threading.current_thread() is threading.main_thread()
    handler = signal.getsignal(signal.SIGTERM)
    try:
        yield
    finally:
        if is_main:
            signal.signal(signal.SIGTERM, handler)
