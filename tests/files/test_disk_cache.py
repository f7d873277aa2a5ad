"""Caches on disk keep what is read, and no more than they may."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from uwsim.base.files import disk_cache
from uwsim.base.files.code_digest import code_digest


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(disk_cache, "MAX_BYTES", 10_000)
    return tmp_path / "uwsim"


def write(name: str, age: float) -> Path:
    """Keep 2000 bytes that were read some seconds ago."""
    file = disk_cache.cache_folder("things") / name
    disk_cache.write(file, bytes(2000))
    facts = file.stat()
    os.utime(file, ns=(facts.st_atime_ns, facts.st_mtime_ns - round(1e9 * age)))
    return file


def test_what_was_read_last_stays_and_the_rest_goes(cache: Path) -> None:
    other = disk_cache.cache_folder("other") / "file"
    disk_cache.write(other, bytes(9000))
    files = [write(f"{k % 2}/file{k}", age=100.0 - k) for k in range(4)]
    assert disk_cache.read(files[0]) is not None
    newest = [write(f"more{k}", age=0.0) for k in range(2)]
    assert [file.exists() for file in files] == [True, False, False, True]
    assert all(file.exists() for file in (*newest, other))
    size = sum(file.stat().st_size for file in (cache / "things").rglob("*") if file.is_file())
    assert size <= 10_000


def test_a_file_outside_the_cache_is_written_and_nothing_is_removed(
    cache: Path, tmp_path: Path
) -> None:
    for name in ("a", "b"):
        disk_cache.write(tmp_path / "elsewhere" / name, bytes(9000))
    assert len(list((tmp_path / "elsewhere").iterdir())) == 2


def test_other_code_has_another_hash(tmp_path: Path) -> None:
    def package(name: str, **modules: str) -> Path:
        folder = tmp_path / name
        folder.mkdir()
        for module, source in modules.items():
            (folder / f"{module}.py").write_text(source)
        return folder

    same, equal = package("same", a="x = 1", b=""), package("equal", a="x = 1", b="")
    other = package("other", a="x = 2", b="")
    digests = {code_digest([folder], ["numpy"]) for folder in (same, equal, other)}
    assert len(digests) == 2
    assert code_digest([same], ["numpy", "scipy"]) not in digests
