"""A temporary folder that is gone with its process, however that comes to its end.

A process that is killed cannot clear up after itself. So another one, which does nothing else,
makes the folder and holds a leash (`leash`): when nobody holds the other end any more, it removes
the folder.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import RunFailed

REMOVER = """
import shutil, sys, tempfile, time
folder = tempfile.mkdtemp(prefix=sys.argv[1], dir=sys.argv[2] or None)
try:
    print(folder, flush=True)
    is_over = sys.stdin.read()
except (OSError, KeyboardInterrupt):
    is_over = ""
shutil.rmtree(folder, ignore_errors=True)
if not is_over:
    time.sleep(2)  # workers of who was killed may have been writing
    shutil.rmtree(folder, ignore_errors=True)
"""


@contextmanager
def scratch_folder(prefix: str, where: Path | None = None) -> Iterator[Path]:
    """Lend an empty folder, and remove it with all that is in it.

    Args:
        prefix: how its name begins.
        where: the folder that it is made in; without one, the system's for temporary files.

    Raises:
        RunFailed: it cannot be made.
    """
    command = [sys.executable, "-I", "-S", "-c", REMOVER, prefix, str(where or "")]
    with subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,  # what a terminal sends to the process is not for it
    ) as remover:
        assert remover.stdin is not None
        assert remover.stdout is not None
        assert remover.stderr is not None
        folder = remover.stdout.readline().rstrip("\n")
        if not folder:
            why = remover.stderr.read().strip().splitlines()[-1:] or ["its process was killed"]
            raise RunFailed(f"No temporary folder can be made: {why[0]}.")
        try:
            yield Path(folder)
        finally:
            remover.communicate("over")
