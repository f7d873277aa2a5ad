"""Models that were kept on disk are the models that were made."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from uwsim.assets import model_cache as room
from uwsim.assets.mesh import Model
from uwsim.assets.stand_ins import STAND_INS

TANK = "terrain/CIRS/cirs_trident"
LABELLED = "robot/PA10/pa10link0"


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "uwsim" / "models"


def fresh(name: str) -> Model:
    """Ask as a new process would."""
    return room.generated_model.__wrapped__(name)


def models(cache: Path) -> list[Path]:
    return [file for file in cache.rglob("*.npz") if not file.name.startswith("texture-")]


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


@pytest.mark.parametrize("name", [TANK, "objects/blackbox_uib_trimesh", LABELLED])
def test_read_back_as_made(cache: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    first = fresh(name)
    assert models(cache)
    monkeypatch.setattr(room, "_make", lambda _: pytest.fail("was made again"))
    assert_equal(fresh(name), first)


def cut(data: bytes) -> bytes:
    return data[: len(data) // 2]


def with_one_byte_changed(data: bytes) -> bytes:
    at = len(data) // 2
    return data[:at] + bytes([data[at] ^ 1]) + data[at + 1 :]


DAMAGES = {
    "empty": lambda _: b"",
    "no archive": lambda _: b"PK",
    "cut off": cut,
    "another vertex": with_one_byte_changed,
}


@pytest.mark.parametrize("damage", DAMAGES.values(), ids=DAMAGES)
def test_a_damaged_file_is_made_anew_and_that_is_reported_once(
    cache: Path, damage: Callable[[bytes], bytes], caplog: pytest.LogCaptureFixture
) -> None:
    first = fresh("objects/hook")
    (file,) = models(cache)
    whole = file.read_bytes()
    file.write_bytes(damage(whole))
    assert_equal(fresh("objects/hook"), first)
    assert file.read_bytes() == whole
    assert_equal(fresh("objects/hook"), first)
    assert [record.getMessage() for record in caplog.records] == [
        f"uwsim: warning: {file} in the cache is damaged; its content is computed again."
    ]


def test_a_damaged_texture_is_made_anew(cache: Path) -> None:
    first = fresh(LABELLED)
    (texture,) = cache.rglob("texture-*.npz")
    whole = texture.read_bytes()
    texture.write_bytes(with_one_byte_changed(whole))
    room._texture.cache_clear()
    assert_equal(fresh(LABELLED), first)
    assert texture.read_bytes() == whole


def test_a_file_under_the_name_of_another_is_not_it(cache: Path) -> None:
    first = fresh("objects/hook")
    (hook,) = models(cache)
    fresh("objects/torus")
    torus = next(file for file in models(cache) if file != hook)
    hook.write_bytes(torus.read_bytes())
    assert_equal(fresh("objects/hook"), first)


def test_other_sources_are_another_model(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    fresh("objects/hook")
    monkeypatch.setattr(room, "_key", lambda: "another")
    fresh("objects/hook")
    assert len(models(cache)) == 2


def test_what_a_killed_process_was_writing_is_taken_away(cache: Path) -> None:
    fresh("objects/hook")
    folder = models(cache)[0].parent
    gone = subprocess.run(
        [sys.executable, "-c", "import os; print(os.getpid())"],
        capture_output=True,
        text=True,
        check=True,
    )
    drafts = [folder / f"{pid}-abc.part" for pid in (int(gone.stdout), os.getpid())]
    for draft in drafts:
        draft.touch()
    fresh("objects/torus")
    assert [draft.exists() for draft in drafts] == [False, True]
    assert len(list(folder.glob("*.part"))) == 1


def test_without_a_place_to_keep(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert fresh("objects/hook").n_triangles > 0


def test_meshes_share_their_texture(cache: Path) -> None:
    """Meshes of one texture object are drawn in one go, read back or not."""
    for read_back in (False, True):
        parts = [fresh(f"robot/ARM5E/ARM5E_part{i}") for i in range(5)]
        textures = {mesh.texture.name: set() for p in parts for mesh in p.meshes if mesh.texture}
        for part in parts:
            for mesh in part.meshes:
                if mesh.texture:
                    textures[mesh.texture.name].add(id(mesh.texture.pixels))
        assert textures
        assert {name: len(found) for name, found in textures.items()} == dict.fromkeys(
            textures, 1
        ), read_back


def test_equal_names_mean_equal_pixels() -> None:
    seen: dict[str, np.ndarray] = {}
    for name in STAND_INS:
        for mesh in room._make(name).meshes:
            if mesh.texture is not None:
                pixels = seen.setdefault(mesh.texture.name, mesh.texture.pixels)
                assert np.array_equal(pixels, mesh.texture.pixels), (name, mesh.texture.name)
    assert len(seen) > 10
