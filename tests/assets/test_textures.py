import numpy as np
import pytest

from scripts.models import textures


@pytest.mark.parametrize("shape", [(64, 64), (60, 200), (200, 60)])
@pytest.mark.parametrize("tiles", [True, False])
def test_noise_is_centred_spread_by_about_one_and_the_same_every_time(
    shape: tuple[int, int], tiles: bool
) -> None:
    made = textures.noise("test", *shape, cells=4, octaves=5, tiles=tiles)
    assert made.shape == shape
    assert made.dtype == np.float32
    assert abs(float(made.mean())) < 0.1
    assert 0.7 < float(made.std()) < 1.2
    assert np.array_equal(made, textures.noise("test", *shape, cells=4, octaves=5, tiles=tiles))
    assert not np.array_equal(
        made, textures.noise("other", *shape, cells=4, octaves=5, tiles=tiles)
    )


def test_tiling_noise_has_no_seam() -> None:
    made = textures.noise("test", 128, 128, cells=4, octaves=3)
    inside = np.abs(np.diff(made, axis=0)).max()
    assert np.abs(made[0] - made[-1]).max() <= 1.2 * inside
    assert np.abs(made[:, 0] - made[:, -1]).max() <= 1.2 * np.abs(np.diff(made, axis=1)).max()


def test_words_leave_ink_where_they_are_written_and_nowhere_else() -> None:
    image = textures.fill(100, 200, (1.0, 1.0, 1.0))
    textures.paint_text(image, "DO NOT OPEN", (0.5, 0.5), width=0.5, height=0.2)
    ink = image.mean(axis=2) < 0.5
    rows, columns = np.nonzero(ink)
    assert 0.2 < ink[40:60, 50:150].mean() < 0.8
    assert rows.min() >= 39
    assert rows.max() <= 60
    assert columns.min() >= 49
    assert columns.max() <= 151


def test_words_near_a_border_are_cut_off_not_wrapped() -> None:
    image = textures.fill(40, 40, (1.0, 1.0, 1.0))
    textures.paint_text(image, "XXXX", (0.0, 0.0), width=1.0)
    assert (image[20:, :] == 1.0).all()
    assert (image[:10, :10] < 1.0).any()


def test_relief_is_brighter_on_the_side_of_the_light() -> None:
    y, x = np.mgrid[0:32, 0:32].astype(np.float32)
    dome = -np.hypot(x - 16, y - 16).astype(np.float32)
    shade = textures.shading(dome, 0.2)
    assert shade[8, 8] > 1.1
    assert shade[24, 24] < 0.9


def test_pixels_are_rounded_and_clipped() -> None:
    texture = textures.to_texture("x", np.array([[[-1.0, 0.5, 2.0]]], dtype=np.float32))
    assert texture.pixels.tolist() == [[[0, 128, 255]]]
