"""Without graphics one clean line is said, and nothing by the libraries below."""

from __future__ import annotations

import os
import subprocess
import sys

PROGRAM = """
from uwsim.errors import NoGraphics
from uwsim.rendering.context import create_context
try:
    create_context()
except NoGraphics:
    print("no graphics")
"""


def said_without_drivers(**more: str) -> subprocess.CompletedProcess[str]:
    environment = {k: v for k, v in os.environ.items() if k != "EGL_LOG_LEVEL"}
    return subprocess.run(
        [sys.executable, "-c", PROGRAM],
        env={**environment, "LIBGL_DRIVERS_PATH": "/nonexistent", **more},
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )


def test_no_libegl_warning_stands_before_the_reason() -> None:
    assert said_without_drivers().stderr == ""


def test_whoever_asks_for_libegl_warnings_still_gets_them() -> None:
    found = said_without_drivers(EGL_LOG_LEVEL="debug")
    assert "libEGL" in found.stderr or "no graphics" not in found.stdout
