"""Report tests whose process crashes in native code, and run them again in another process.

The test does not cause such a crash: the software rasteriser has crashed twice in some hundred runs
of all tests. A test that crashes its process twice has failed. `scripts/test` prints the native
stacks of all crashes, of tests that pass the second time, too.
"""

from __future__ import annotations

import pytest
from _pytest.terminal import TerminalReporter
from xdist.scheduler import Scheduling

RERUN = "rerun"
"""The outcome of a test that runs again."""


class CrashedProcesses:
    """The tests that have crashed the process in which they ran."""

    def __init__(self) -> None:
        self.names: list[str] = []
        """The names of the tests, in order."""

    @pytest.hookimpl(optionalhook=True)
    def pytest_handlecrashitem(
        self, crashitem: str, report: pytest.TestReport, sched: Scheduling
    ) -> None:
        """Run a test again the first time."""
        if crashitem not in self.names:
            sched.mark_test_pending(crashitem)
            report.outcome = RERUN  # type: ignore[assignment]
        self.names.append(crashitem)

    def pytest_terminal_summary(self, terminalreporter: TerminalReporter) -> None:
        """List the tests, whether or not they passed."""
        if self.names:
            terminalreporter.section("processes that crashed in native code", yellow=True)
            for name in self.names:
                terminalreporter.line(f"CRASHED {name}")


def pytest_configure(config: pytest.Config) -> None:
    """Register the plugin."""
    config.pluginmanager.register(CrashedProcesses())
