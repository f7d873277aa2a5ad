"""The kernel and the files that it compiles in."""

from __future__ import annotations

import hashlib
from pathlib import Path

from uwsim.physics.hydrodynamics import kernel

COMPILED_IN = (
    "columns", "equations", "fields", "free_bodies", "layout", "memory", "midpoint", "submersion",
)  # fmt: skip


def test_the_kernel_changes_with_the_files_it_compiles_in_or_numba_would_run_an_old_one() -> None:
    folder = Path(kernel.__file__).parent
    digest = hashlib.sha256(b"".join((folder / f"{name}.py").read_bytes() for name in COMPILED_IN))
    assert digest.hexdigest()[:16] == kernel.COMPILED_IN
