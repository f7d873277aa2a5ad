"""Models that were kept on disk are the models that were made."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from uwsim.assets import model_cache as room
from uwsim.assets.mesh import Model

TANK = "terrain/CIRS/cirs_trident"


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "uwsim" / "models"


def fresh(name: str) -> Model:
    """Ask as a new process would."""
    return room.made.__wrapped__(name)


def assert_equal(a: Model, b: Model) -> None:
    assert (a.name, a.source, a.sha256, a.box) == (b.name, b.source, b.sha256, b.box)
    for one, other in zip(a.meshes, b.meshes, strict=True):
        for array in ("vertices", "normals", "uvs", "triangles"):
            x, y = getattr(one, array), getattr(other, array)
            assert x.dtype == y.dtype
            assert np.array_equal(x, y)
        assert (one.colour, one.two_sided) == (other.colour, other.two_sided)
        assert (one.texture is None) == (other.texture is None)
        if one.texture is not None and other.texture is not None:
            assert one.texture.name == other.texture.name
            assert one.texture.repeats == other.texture.repeats
            assert np.array_equal(one.texture.pixels, other.texture.pixels)


@pytest.mark.parametrize("name", [TANK, "objects/blackbox_uib_trimesh", "robot/PA10/pa10link0"])
def test_read_back_as_made(cache: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    first = fresh(name)
    assert len(list(cache.rglob("*.npz"))) == 1
    monkeypatch.setattr(room, "_make", lambda _: pytest.fail("was made again"))
    assert_equal(fresh(name), first)


@pytest.mark.parametrize("damage", [b"", b"PK", b"not a zip at all"])
def test_damaged_file_is_replaced(cache: Path, damage: bytes) -> None:
    first = fresh("objects/hook")
    (file,) = cache.rglob("*.npz")
    whole = file.read_bytes()
    file.write_bytes(damage or whole[: len(whole) // 2])
    assert_equal(fresh("objects/hook"), first)
    assert file.read_bytes() == whole


def test_other_sources_are_another_model(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    fresh("objects/hook")
    monkeypatch.setattr(room, "_key", lambda: "another")
    fresh("objects/hook")
    assert len(list(cache.rglob("*.npz"))) == 2


def test_without_a_place_to_keep(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert fresh("objects/hook").n_triangles > 0
