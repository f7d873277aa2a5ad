"""The fixtures of all tests: a separate home, children that receive Ctrl-C, no deadlines."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

pytest_plugins = ["tests.support.crashed_processes"]

settings.register_profile(
    "any computer", deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("any computer")  # a slow computer causes no error


@pytest.fixture(scope="session", autouse=True)
def _receive_ctrl_c() -> None:
    """The handler of Ctrl-C, which children of tests inherit, also if pytest ignores it."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session", autouse=True)
def _may_dump_core() -> Iterator[None]:
    """The access to the memory of a test's process, which runs of external algorithms deny.

    A process that denies access leaves no core file, hence no native stacks of a crash.
    """
    with pytest.MonkeyPatch.context() as patch:
        for module in ("uwsim.runs.sealing", "uwsim.runs.executors.executor"):
            patch.setattr(f"{module}.deny_access_to_memory", lambda: None)
        yield


@pytest.fixture(scope="session", autouse=True)
def home(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A home directory, which commands of tests inherit; it is empty but for caches.

    All processes of a run of tests share the caches, so that each model is compiled once.
    """
    folder = tmp_path_factory.mktemp("home")
    is_worker = "PYTEST_XDIST_WORKER" in os.environ
    run_folder = tmp_path_factory.getbasetemp().parent if is_worker else folder.parent
    caches = run_folder / "caches"
    caches.mkdir(exist_ok=True)
    (folder / ".cache").symlink_to(caches, target_is_directory=True)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("HOME", str(folder))
        for name in ("XDG_CACHE_HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "MPLCONFIGDIR"):
            patch.delenv(name, raising=False)
        yield folder
