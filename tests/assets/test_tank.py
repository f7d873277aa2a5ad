import numpy as np
import pytest

from scripts.models.stand_ins.seabed_image import mosaic, stones
from scripts.models.stand_ins.tank import PROFILE
from uwsim.assets import load_model


def hits(origin: tuple[float, float, float], way: tuple[float, float, float]) -> list[float]:
    """Distances at which a ray meets front faces of the tank, nearest first (Moeller-Trumbore)."""
    start, direction = np.array(origin), np.array(way, dtype=float)
    found: list[float] = []
    for mesh in load_model("terrain/CIRS/cirs_trident").meshes:
        a, b, c = (mesh.vertices[mesh.triangles[:, k]].astype(float) for k in range(3))
        e1, e2 = b - a, c - a
        p = np.cross(direction, e2)
        det = np.einsum("ij,ij->i", e1, p)
        front = det > 1e-12
        det = np.where(front, det, 1.0)
        t = start - a
        u = np.einsum("ij,ij->i", t, p) / det
        q = np.cross(t, e1)
        v = q @ direction / det
        s = np.einsum("ij,ij->i", e2, q) / det
        inside = front & (u >= -1e-6) & (v >= -1e-6) & (u + v <= 1 + 1e-6) & (s > 0)
        found += s[inside].tolist()
    return sorted(found)


@pytest.mark.parametrize(
    ("x", "y", "z"),
    [(0.3, 0.2, -4.81), (1.7, 3.4, -4.81), (1.9, 0.1, -4.85), (0.3, 3.7, -4.85), (-7.0, 1.1, -0.65),
     (7.0, -3.1, -0.65), (-4.01, 0.1, -2.75), (3.99, 2.2, -2.75)],
)  # fmt: skip
def test_the_bottom_has_the_depths_of_the_tank(x: float, y: float, z: float) -> None:
    assert hits((x, y, 0.0), (0, 0, -1))[0] == pytest.approx(-z, abs=1e-4)


@pytest.mark.parametrize(
    ("way", "distance"),
    [((1, 0, 0), 7.99), ((-1, 0, 0), 8.01), ((0, 1, 0), 4.0), ((0, -1, 0), 4.0)],
)
def test_walls_face_into_the_basin(way: tuple[float, float, float], distance: float) -> None:
    assert hits((0.0, 0.0, -0.3), way)[0] == pytest.approx(distance, abs=1e-4)
    assert hits((0.0, 0.0, 0.1), way)[0] == pytest.approx(distance, abs=1e-4)


def test_the_window_stands_a_little_out_of_its_wall() -> None:
    assert hits((1.0, 0.0, -1.3), (0, 1, 0))[0] == pytest.approx(3.96, abs=1e-4)
    assert hits((3.0, 0.0, -1.3), (0, 1, 0))[0] == pytest.approx(4.0, abs=1e-4)


def test_deck_ground_and_facade_are_seen_from_outside() -> None:
    assert hits((8.15, 0.0, 5.0), (0, 0, -1))[0] == pytest.approx(4.75, abs=1e-4)
    assert hits((12.0, -9.0, 5.0), (0, 0, -1))[0] == pytest.approx(4.87, abs=0.03)
    assert hits((2.0, -9.0, 3.0), (0, 1, 0))[0] == pytest.approx(13.3, abs=1e-4)
    assert hits((2.0, -9.0, 5.2), (0, 1, 0))[0] == pytest.approx(13.22, abs=1e-4)


@pytest.mark.parametrize("seed", range(5))
def test_water_cannot_leave_the_basin(seed: int) -> None:
    draw = np.random.Generator(np.random.Philox(seed))
    for _ in range(40):
        way = draw.normal(size=3)
        way[2] = -abs(way[2])
        way /= np.linalg.norm(way)
        assert hits((0.1, 0.2, -0.1), tuple(way.tolist()))


def test_the_old_tank_is_the_same_but_higher() -> None:
    new, old = load_model("terrain/CIRS/cirs_trident"), load_model("terrain/CIRS/cirs")
    assert old.box.lower[2] - new.box.lower[2] == pytest.approx(0.43, abs=1e-5)


def test_no_two_places_of_the_mosaic_look_alike() -> None:
    pixels = mosaic().pixels.astype(np.float32).mean(axis=2)
    size = 64
    patches = [
        pixels[y : y + size, x : x + size].ravel()
        for y in range(0, pixels.shape[0] - size, size)
        for x in range(0, pixels.shape[1] - size, size)
    ]
    table = np.stack([(patch - patch.mean()) / patch.std() for patch in patches]) / size
    alike = table @ table.T - 2.0 * np.eye(len(table))
    assert alike.max() < 0.8
    assert min(patch.std() for patch in patches) > 5.0


def test_stones_cover_the_ground_and_are_lower_at_their_rims() -> None:
    high, shade = stones("test", 128, 128, count=40, gap=1.0)
    assert 20 <= len(np.unique(shade)) <= 40
    rim = shade[:, 1:] != shade[:, :-1]
    assert high[:, 1:][rim].max() == 0.0
    assert high.max() == 1.0


def test_the_profile_is_the_one_of_the_reference() -> None:
    assert PROFILE[1] == (-6.01, -0.65)
    assert PROFILE[2] == (-2.01, -4.85)
