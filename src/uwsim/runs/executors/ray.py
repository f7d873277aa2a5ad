"""An executor on a Ray cluster: at ``RAY_ADDRESS``, or on this machine and started for the run.

No file system is shared. Rows and images return level by level and are stored on this machine, as
in a local run. A worker whose machine has other files, versions or another renderer raises an
error before it begins. Its machine must have uwsim, and the user's own files under the same paths
(``ray job submit --working-dir`` copies them).
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
from .worker import Event, JournalWriter, TrialEnded, TrialFailed, make_picklable, run_trial

ADDRESS = "RAY_ADDRESS"
OBJECT_STORE_SIZE = 256 * 2**20
"""The memory for rows and images within a cluster that is started for the run [bytes]."""
RAY_ENV = {"RAY_USAGE_STATS_ENABLED": "0", "RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO": "0"}
"""The environment variables that turn off Ray's telemetry and its warnings on GPU settings."""


class RayExecutor:
    """Workers on a Ray cluster, one for each of its processors.

    A new worker repeats the trial of a lost worker. A cluster that is started for the run accepts
    connections of this machine only, has its own token, and is removed at the end.

    Args:
        cpus: the number of processors of a cluster that is started for the run; None for all that
            this process may use.

    Raises:
        MissingExtra: Ray is not installed.
        BadSetting: there is no cluster at ``RAY_ADDRESS``.
    """

    def __init__(self, cpus: int | None = None) -> None:
        self._address = address()
        if self._address is None and "ray" not in sys.modules and "RAY_AUTH_MODE" not in os.environ:
            # The variables remain set: Ray reads them at its import, once in a process.
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
        """Execute all jobs of the queue on the cluster."""
        ray = self._ray
        # Ray prints its progress on standard output; the progress of levels is displayed instead.
        with self._cluster(), redirect_stdout(io.StringIO()):
            n_workers = max(1, int(ray.cluster_resources().get("CPU", 1)))
            worker_class = ray.remote(num_cpus=1, max_restarts=0)(RayWorker)
            worker_class = worker_class.options(runtime_env={"env_vars": select_unset(ENVIRONMENT)})
            pool: list[tuple[Any, str]] = []  # idle workers, each with its only algorithm
            tasks: dict[Any, AssignedJob] = {}
            try:
                while True:
                    while len(tasks) < n_workers and (job := queue.pop()) is not None:
                        name = job.run.plan.algorithm.name
                        while pool and pool[-1][1] != name:  # no process runs two algorithms
                            ray.kill(pool.pop()[0])
                        task = AssignedJob(job, pool.pop()[0] if pool else worker_class.remote())
                        tasks[task.begin()] = task
                    for worker, _ in pool:  # no jobs are left for the idle workers
                        ray.kill(worker)
                    pool.clear()
                    if not tasks:
                        break
                    ready_tasks, _ = ray.wait(list(tasks), num_returns=1)
                    for events in ready_tasks:
                        if self._is_over(events, tasks[events], queue):
                            task = tasks.pop(events)
                            task.writer.close()
                            if task.is_alive:
                                pool.append((task.worker, task.job.run.plan.algorithm.name))
            finally:
                for task in tasks.values():
                    task.writer.close()

    def _is_over(self, events: Any, task: AssignedJob, queue: JobQueue) -> bool:
        """Process the next event of a task; return whether the task has ended."""
        errors = self._ray.exceptions
        try:
            event = self._ray.get(next(events))
            if isinstance(event, TrialFailed):
                queue.report_failure(task.job, event.error)
            elif task.writer.write(event):
                queue.report_level(task.job)
            elif isinstance(event, TrialEnded):
                queue.report_finish(task.job)
            return False
        except StopIteration:
            return True
        except errors.RayTaskError as error:
            queue.report_failure(task.job, RunFailed(f"{task.job}: {error.cause!r}"))
        except errors.RayError as error:
            task.is_alive = False
            queue.report_loss(task.job, f"with {type(error).__name__}")
        except UwsimError as error:  # the row differs from the row on disk
            self._ray.kill(task.worker)
            task.is_alive = False
            queue.report_failure(task.job, error)
        return True

    @contextmanager
    def _cluster(self) -> Iterator[None]:
        """Connect to the cluster during the block; then stop it if it was started for the run."""
        if self._ray.is_initialized():
            yield
            return
        with scratch_folder("uwsim-ray-", _short_folder()) as folder:
            try:
                with set_environment({**RAY_ENV, SCRATCH_VARIABLE: str(folder)}), _keep_signals():
                    self._connect(str(folder))
                yield
            finally:
                self._ray.shutdown()

    def _connect(self, folder: str) -> None:
        log_options = {"logging_level": "ERROR", "log_to_driver": False}
        try:
            if self._address is not None:
                self._ray.init(address=self._address, **log_options)
            else:
                self._ray.init(
                    address="local",
                    _node_ip_address="127.0.0.1",
                    num_cpus=self._cpus,
                    object_store_memory=OBJECT_STORE_SIZE,
                    include_dashboard=False,
                    _temp_dir=folder,
                    **log_options,
                )
        except SystemExit:  # Ray's exception for SIGTERM while it starts
            raise KeyboardInterrupt from None
        except Exception as error:  # Ray raises many kinds of exceptions
            place = "a cluster here" if self._address is None else f"{ADDRESS}={self._address}"
            message = " ".join(str(error).split())
            raise RunFailed(f"--workers ray: {place} cannot be used ({message[:300]}).") from error


def address() -> str | None:
    """Return the address of the cluster; None for a cluster that is started for the run.

    Raises:
        BadSetting: the address is invalid, or no cluster answers; Ray itself would retry for
            minutes.
    """
    value = os.environ.get(ADDRESS, "").strip()
    if value in ("", "local"):
        return None
    if value == "auto":
        return value
    host, colon, port = value.rpartition(":")
    if not colon or not port.isdigit() or "/" in host:
        raise BadSetting(f"{ADDRESS}={value}: expected HOST:PORT of a cluster's head, or auto.")
    try:
        socket.create_connection((host.strip("[]"), int(port)), timeout=5.0).close()
    except (OSError, OverflowError, UnicodeError) as error:
        raise BadSetting(f"{ADDRESS}={value}: there is no answer ({error}).") from None
    return value


@dataclass
class AssignedJob:
    """A job that a worker executes, and the writer of its journal."""

    job: Job
    """The job to execute."""
    worker: Any
    """Ray's handle of a `RayWorker`."""
    is_alive: bool = True
    """True if the worker accepts another job."""

    def begin(self) -> Any:
        """Start the job; return its future events."""
        run, trial = self.job.run, self.job.trial
        self.writer = JournalWriter(run, trial)
        execute = self.worker.execute.options(num_returns="streaming")
        unsealed_run = replace(run, seal=None)  # only this process writes rows and needs the key
        return execute.remote(unsealed_run, trial, run.head(trial))


class RayWorker:
    """A process in the cluster, with a renderer kept between trials."""

    def __init__(self) -> None:
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # the driver handles Ctrl-C
        self._cache = TrialCache()
        self._checked_heads: list[Record] = []

    def execute(self, run: Run, trial: Trial, head: Record) -> Iterator[Event | TrialFailed]:
        """Run a trial, if this machine is equivalent to the driver's; yield its events."""
        try:
            self._check(run, trial, head)
            yield from run_trial(run.plan, trial, self._cache)
        except Exception as error:
            yield TrialFailed(make_picklable(error))

    def _check(self, run: Run, trial: Trial, head: Record) -> None:
        """Check that the trial gives the same rows here as on the driver's machine.

        Args:
            run: the run of the trial.
            trial: the trial to run.
            head: the head of the trial's journal, from the driver.

        Raises:
            RunFailed: files, versions or the renderer differ from the driver's.
        """
        expected = {name: head[name] for name in ("inputs", "run")}
        if expected in self._checked_heads:
            return
        try:
            inputs, renderer = hash_inputs(run.plan, self._cache.renderers)
        except UwsimError as error:
            raise RunFailed(f"Worker on {platform.node()}: {error}") from error
        if run.plan.is_blind:
            renderer = run.renderer
        own_head = Run(plan=run.plan, out=run.out, inputs=inputs, renderer=renderer).head(trial)
        differences = list(_differences({name: own_head[name] for name in expected}, expected))
        if differences:
            raise RunFailed(
                f"Worker on {platform.node()} would not give the same result: "
                f"{'; '.join(differences)}."
            )
        self._checked_heads.append(expected)


def _differences(actual: object, expected: object, name: str = "") -> Iterator[str]:
    if isinstance(actual, dict) and isinstance(expected, dict):
        for key in {**expected, **actual}:
            yield from _differences(actual.get(key), expected.get(key), f"{name}.{key}".lstrip("."))
    elif actual != expected:
        yield f"{name} is {actual!r}, not {expected!r}"


def _short_folder() -> Path | None:
    """Return a folder short enough for sockets, whose paths may have 107 characters."""
    return folder if (folder := Path("/tmp")).is_dir() else None


@contextmanager
def _keep_signals() -> Iterator[None]:
    """Restore the handler of SIGTERM, which Ray replaces, at the end of the block."""
    is_main = threading.current_thread() is threading.main_thread()
    handler = signal.getsignal(signal.SIGTERM)
    try:
        yield
    finally:
        if is_main:
            signal.signal(signal.SIGTERM, handler)
