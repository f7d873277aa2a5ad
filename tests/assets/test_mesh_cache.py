"""Meshes that were read from a file are read back as they were, without the reader."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from uwsim.assets import loaders
from uwsim.assets.loaders import by_trimesh
from uwsim.assets.mesh import Model
from uwsim.errors import AssetError

TRIANGLES = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 2\nf 1 2 3\nf 1 2 4\n"


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache" / "uwsim" / "meshes"


def written(folder: Path, text: str, name: str = "thing.obj") -> Path:
    path = folder / name
    path.write_text(text)
    return path


def fresh(path: Path) -> Model:
    """Read as a new process would."""
    loaders._cache.clear()
    return loaders.read_model(path, name=path.name)


def assert_equal(one: Model, other: Model) -> None:
    assert (one.sha256, one.files, one.box) == (other.sha256, other.files, other.box)
    for a, b in zip(one.meshes, other.meshes, strict=True):
        assert (a.colour, a.two_sided, a.texture) == (b.colour, b.two_sided, b.texture)
        for name in ("vertices", "normals", "uvs", "triangles"):
            assert getattr(a, name).dtype == getattr(b, name).dtype
            assert np.array_equal(getattr(a, name), getattr(b, name))


def test_a_file_is_read_back_as_it_was(
    cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = written(tmp_path, TRIANGLES)
    first = fresh(path)
    assert len(list(cache.iterdir())) == 1
    with monkeypatch.context() as patch:
        patch.setattr(by_trimesh, "_parts", lambda *_: pytest.fail("was read again"))
        assert_equal(fresh(path), first)
    (kept,) = cache.iterdir()
    kept.write_bytes(kept.read_bytes()[:-20])
    assert_equal(fresh(path), first)


def test_a_changed_file_is_read_anew(cache: Path, tmp_path: Path) -> None:
    path = written(tmp_path, TRIANGLES)
    assert fresh(path).meshes[0].vertices[:, 2].max() == 2.0
    written(tmp_path, TRIANGLES.replace("0 0 2", "0 0 3"))
    assert fresh(path).meshes[0].vertices[:, 2].max() == 3.0
    assert len(list(cache.iterdir())) == 2


@pytest.mark.parametrize("is_there", [True, False])
def test_a_file_that_names_another_is_not_kept(cache: Path, tmp_path: Path, is_there: bool) -> None:
    if is_there:
        written(tmp_path, "newmtl red\nKd 1 0 0\n", "thing.mtl")
    fresh(written(tmp_path, "mtllib thing.mtl\nusemtl red\n" + TRIANGLES))
    assert not cache.exists()


def test_a_broken_file_is_not_kept(cache: Path, tmp_path: Path) -> None:
    path = written(tmp_path, TRIANGLES + "v 1 1 nan\nf 1 2 5\n")
    for _ in range(2):
        with pytest.raises(AssetError, match=r"thing\.obj"):
            fresh(path)
    assert not cache.exists()


def test_what_is_kept_is_read_without_trimesh(cache: Path, tmp_path: Path) -> None:
    path = written(tmp_path, TRIANGLES)
    fresh(path)
    code = (
        "import sys; from pathlib import Path; from uwsim.assets.loaders import read_model;"
        "read_model(Path(sys.argv[1]), name='thing.obj');"
        "print([name for name in ('trimesh', 'scipy.spatial') if name in sys.modules])"
    )
    command = [sys.executable, "-c", code, str(path)]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    assert run.stdout == "[]\n"
