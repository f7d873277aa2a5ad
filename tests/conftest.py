"""What every test gets: a home of its own, children that hear Ctrl-C, no limit of an example."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

pytest_plugins = ["tests.support.crashed_processes"]

settings.register_profile(
    "any computer", deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("any computer")  # a slow one is no error


@pytest.fixture(scope="session", autouse=True)
def _hear_ctrl_c() -> None:
    """Tests that press Ctrl-C do so to children that hear it, also when pytest was told not to."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session", autouse=True)
def _may_dump_core() -> Iterator[None]:
    """A run of an external algorithm denies access to memory, of a test's process it does not.

    A process that denies it leaves no core file, hence no native stacks of a crash.
    """
    with pytest.MonkeyPatch.context() as patch:
        for module in ("uwsim.runs.sealing", "uwsim.runs.executors.executor"):
            patch.setattr(f"{module}.deny_access_to_memory", lambda: None)
        yield


@pytest.fixture(scope="session", autouse=True)
def home(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """Make an empty home directory; commands that tests start inherit it."""
    folder = tmp_path_factory.mktemp("home")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("HOME", str(folder))
        for name in ("XDG_CACHE_HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "MPLCONFIGDIR"):
            patch.delenv(name, raising=False)
        yield folder
