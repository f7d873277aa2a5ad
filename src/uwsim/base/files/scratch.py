"""A temporary folder that is removed when the process that uses it ends, even if it is killed.

A killed process cannot remove its files. So another process creates the folder and reads from a
pipe. It removes the folder when the other end of the pipe is closed.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ...errors import RunFailed

SCRATCH_VARIABLE = "UWSIM_SCRATCH"
"""The environment variable with the path of a scratch folder, for processes that use the folder.

They are killed if the process that requested the folder is killed.
"""
REMOVER = """
import contextlib, os, shutil, sys, tempfile, time
folder = tempfile.mkdtemp(prefix=sys.argv[1], dir=sys.argv[2] or None)
mark = f"{sys.argv[3]}={folder}".encode()
try:
    print(folder, flush=True)
    is_over = sys.stdin.read()
except (OSError, KeyboardInterrupt):
    is_over = ""
for _ in range(1 if is_over else 30):  # what a killed process has started may still be starting
    for process in [] if is_over else filter(str.isdigit, os.listdir("/proc")):
        with contextlib.suppress(OSError), open(f"/proc/{process}/environ", "rb") as variables:
            if mark in variables.read().split(b"\\0"):
                os.kill(int(process), 9)
    shutil.rmtree(folder, ignore_errors=True)
    time.sleep(0 if is_over else 0.1)
"""


@contextmanager
def scratch_folder(prefix: str, parent: Path | None = None) -> Iterator[Path]:
    """Yield an empty folder, and remove it with its content after the block.

    If this process is killed, all processes with this folder in their `SCRATCH_VARIABLE` are
    killed, too.

    Args:
        prefix: the first characters of the folder's name.
        parent: the folder in which it is created; None: the system's temporary folder.

    Raises:
        RunFailed: the folder cannot be created.
    """
    arguments = [prefix, str(parent or ""), SCRATCH_VARIABLE]
    command = [sys.executable, "-I", "-S", "-c", REMOVER, *arguments]
    with subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,  # it gets no signals of the terminal
    ) as remover:
        assert remover.stdin is not None
        assert remover.stdout is not None
        assert remover.stderr is not None
        folder = remover.stdout.readline().rstrip("\n")
        if not folder:
            error_text = remover.stderr.read().strip() or "its process was killed"
            raise RunFailed(f"No temporary folder can be created: {error_text.splitlines()[-1]}.")
        try:
            yield Path(folder)
        finally:
            remover.communicate("over")
