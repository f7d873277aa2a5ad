"""Frames from files, exposures, discs around an LED, and squares of a board."""

from __future__ import annotations

import io
import math
from pathlib import Path

import cv2
import numpy as np
import pytest

from uwsim.calibration.example.synthetic_pictures import (
    LAYOUT,
    SyntheticCamera,
    draw_board,
    draw_led,
)
from uwsim.calibration.pictures.board_squares import Checker, find_checkers, read_difference
from uwsim.calibration.pictures.frames import FrameMean, average_frames, read_frame
from uwsim.calibration.pictures.led_discs import find_led, sum_discs
from uwsim.calibration.pictures.linear_picture import Exposure, LinearPicture, combine_exposures
from uwsim.errors import AssetError, BadSetting

COLOURS = np.arange(5 * 4 * 3).reshape(5, 4, 3) * 1000


def make_picture(values: np.ndarray) -> LinearPicture:
    nothing = np.zeros(values.shape)
    return LinearPicture(values, nothing, nothing, np.ones(values.shape, dtype=bool))


def make_frames(values: object, peaks: object = None) -> FrameMean:
    numbers = np.atleast_3d(np.asarray(values, dtype=float))
    top = numbers if peaks is None else np.atleast_3d(np.asarray(peaks, dtype=float))
    return FrameMean(numbers, np.zeros_like(numbers), top)


@pytest.mark.parametrize("suffix", [".png", ".tif", ".npy"])
@pytest.mark.parametrize("depth", [np.uint8, np.uint16])
def test_colour_frames_are_read_as_red_green_blue(suffix: str, depth: type, tmp_path: Path) -> None:
    colours = COLOURS.astype(depth)
    path = tmp_path / f"frame{suffix}"
    if suffix == ".npy":
        np.save(path, colours)
    else:
        assert cv2.imwrite(str(path), colours[..., ::-1])
    np.testing.assert_array_equal(read_frame(path), colours)


def test_a_grey_frame_has_one_plane(tmp_path: Path) -> None:
    path = tmp_path / "grey.png"
    cv2.imwrite(str(path), COLOURS[..., 0].astype(np.uint16))
    assert read_frame(path).shape == (5, 4, 1)


def test_frames_are_averaged_with_the_variance_of_their_mean(tmp_path: Path) -> None:
    generator = np.random.default_rng(1)
    paths = [tmp_path / f"{index}.npy" for index in range(16)]
    for path in paths:
        np.save(path, 100.0 + 4.0 * generator.standard_normal((40, 50)))
    mean = average_frames(paths)
    assert mean.values.mean() == pytest.approx(100.0, abs=0.1)
    assert mean.variances.mean() == pytest.approx(1.0, rel=0.1)
    assert (mean.peaks >= mean.values).all()


@pytest.mark.parametrize(
    ("name", "data", "message"),
    [
        ("frame.jpg", b"", r"\.jpg is not read; expected \.png"),
        ("frame.png", b"nothing", "is not a picture"),
        ("frame.tif", b"II*\0nothing", "is not a picture"),
        ("frame.npy", b"nothing", "is not an NPY file"),
    ],
)
def test_other_files_are_refused(name: str, data: bytes, message: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(data)
    with pytest.raises(AssetError, match=message):
        read_frame(tmp_path / name)


def test_a_missing_frame_and_a_huge_one_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(AssetError, match="cannot be read"):
        read_frame(tmp_path / "none.png")
    monkeypatch.setattr("uwsim.calibration.pictures.frames.MAX_PIXELS", 19)
    for suffix in (".png", ".tif", ".npy"):
        path = tmp_path / f"huge{suffix}"
        if suffix == ".npy":
            np.save(path, COLOURS)
        else:
            cv2.imwrite(str(path), COLOURS.astype(np.uint16))
        with pytest.raises(AssetError, match="expected at most 19"):
            read_frame(path)


def write_header(shape: tuple[int, ...], number_type: str = "<f8") -> bytes:
    """Return the header of an NPY file."""
    stream = io.BytesIO()
    header = {"descr": number_type, "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(stream, header)
    return stream.getvalue()


@pytest.mark.parametrize(
    ("shape", "message"),
    [
        ((1_000_000, 1_000_000, 3), "has 1000000x1000000 pixels; expected at most 26000000"),
        ((2**32, 2**32), "expected at most 26000000"),
        ((2, 2, 10**9), r"has 16 bytes of numbers; expected 32000000000 for the shape \(2, 2, "),
        ((3, 4), r"has 16 bytes of numbers; expected 96 for the shape \(3, 4\) of its header"),
        ((-1, 4), r"is not an NPY file: its shape is \(-1, 4\)"),
    ],
)
def test_the_header_of_an_npy_file_is_checked_before_memory_is_allocated(
    shape: tuple[int, ...], message: str, tmp_path: Path
) -> None:
    path = tmp_path / "frame.npy"
    path.write_bytes(write_header(shape) + bytes(16))
    with pytest.raises(AssetError, match=message):
        read_frame(path)


def test_frames_of_two_sizes_are_refused(tmp_path: Path) -> None:
    np.save(tmp_path / "1.npy", np.zeros((3, 4)))
    np.save(tmp_path / "2.npy", np.zeros((4, 3)))
    with pytest.raises(AssetError, match=r"expected that of 1\.npy"):
        average_frames([tmp_path / "1.npy", tmp_path / "2.npy"])


def test_the_core_comes_from_the_short_exposure_and_the_halo_from_the_long_one() -> None:
    dark_frames = make_frames([[10.0, 10.0]])
    exposures = [
        Exposure(16.0, make_frames([[1000.0, 170.0]], [[1000.0, 180.0]]), dark_frames),
        Exposure(1.0, make_frames([[510.0, 19.0]]), dark_frames),
    ]
    picture = combine_exposures(exposures, plane=0, full_scale=1000.0, encoding="linear")
    np.testing.assert_allclose(picture.values, [[0.5, 0.01]])
    assert picture.is_valid.all()
    saturated = combine_exposures(exposures[:1], plane=0, full_scale=1000.0, encoding="linear")
    assert saturated.is_valid.tolist() == [[False, True]]


def test_srgb_is_made_linear_before_the_dark_frame_is_subtracted() -> None:
    exposure = Exposure(2.0, make_frames([[188.0, 8.0]]), make_frames([[8.0, 8.0]]))
    picture = combine_exposures([exposure], plane=0, full_scale=255.0, encoding="srgb")
    dark = 8.0 / 255.0 / 12.92
    np.testing.assert_allclose(picture.values, [[(0.5029 - dark) / 2.0, 0.0]], atol=1e-4)


def test_exposures_of_two_sizes_and_missing_planes_are_refused() -> None:
    exposures = [Exposure(1.0, make_frames(np.zeros((2, 3))), make_frames(np.zeros((3, 2))))]
    with pytest.raises(BadSetting, match="expected one size"):
        combine_exposures(exposures, plane=0, full_scale=1.0, encoding="linear")
    exposures = [Exposure(1.0, make_frames(np.zeros((2, 3))), None)]
    with pytest.raises(BadSetting, match="plane 2 does not exist"):
        combine_exposures(exposures, plane=2, full_scale=1.0, encoding="linear")


def test_an_led_beside_the_axis_is_found_and_its_discs_have_its_light() -> None:
    camera = SyntheticCamera()
    centre = (240.3, 200.7)
    halo = draw_led(camera, 0.4, lambda angles: 0.5 * np.minimum(angles / 0.2, 1.0), centre)
    picture = make_picture(halo)
    found_centre = find_led(picture)
    assert found_centre == pytest.approx(centre, abs=0.05)
    angles = (math.radians(1.0), math.radians(5.0), math.radians(10.0), math.radians(20.0))
    *sums, outside = sum_discs(picture, found_centre, camera.focal_length, angles)
    for total, angle in zip(sums, angles, strict=False):
        assert total is not None
        assert total.value == pytest.approx(0.4 + 0.5 * angle / 0.2, rel=0.01)
    assert outside is None


def test_a_disc_with_a_saturated_pixel_is_not_read() -> None:
    picture = make_picture(np.ones((100, 100)))
    picture.is_valid[50, 60] = False
    sums = sum_discs(picture, (50.0, 50.0), 1000.0, (0.005, 0.02))
    assert sums[0] is not None
    assert sums[1] is None


def test_a_dark_picture_has_no_led() -> None:
    with pytest.raises(BadSetting, match="no light of an LED"):
        find_led(make_picture(np.zeros((20, 20))))


def draw_clear_board() -> np.ndarray:
    def compute_transfer(frequencies: np.ndarray) -> np.ndarray:
        return np.ones(len(frequencies))

    def compute_irradiance(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        return np.full(x.shape, math.pi)

    return draw_board(SyntheticCamera(), LAYOUT, 1.0, compute_transfer, compute_irradiance)


def test_checkers_of_three_sizes_are_found_where_they_are() -> None:
    camera = SyntheticCamera()
    checkers = find_checkers(make_picture(draw_clear_board()), LAYOUT.sides, camera.focal_length)
    for side, centre in zip(LAYOUT.sides, LAYOUT.centres, strict=True):
        expected = np.array(camera.middle) + np.array(centre) * 1000.0
        np.testing.assert_allclose(checkers[side].corners.mean(axis=0), expected, atol=0.6)
        total = read_difference(make_picture(draw_clear_board()), checkers[side])
        assert total.value == pytest.approx(0.85, rel=0.01)


def test_a_checker_is_not_found_in_a_smaller_or_larger_one() -> None:
    picture = make_picture(draw_clear_board())
    for side in (0.02, 0.07):
        with pytest.raises(BadSetting, match=f"no checker of {side * 100:g} cm was found"):
            find_checkers(picture, (*LAYOUT.sides, side), 1000.0)


@pytest.mark.parametrize("focal_length", [752.0, 900.0, 1100.0, 1250.0])
def test_a_wrong_focal_length_is_seen_by_the_size_of_squares(focal_length: float) -> None:
    picture = make_picture(draw_clear_board())
    find_checkers(picture, (0.15,), 960.0, is_clear=True)
    with pytest.raises(BadSetting, match="<focalLength> give"):
        find_checkers(picture, (0.15,), focal_length, is_clear=True)


def test_a_tilted_checker_is_read_by_its_corners() -> None:
    board = draw_clear_board()
    x0, y0 = SyntheticCamera().middle
    matrix = cv2.getRotationMatrix2D((x0, y0), 12.0, 1.0)
    tilted = cv2.warpAffine(board, matrix, board.shape[::-1])
    half = 40.0
    places = np.array([(-half, -half), (half, -half), (half, half), (-half, half)])
    corners = (places + np.array([x0 + 150.0, y0 - 60.0])) @ matrix[:, :2].T + matrix[:, 2]
    total = read_difference(make_picture(tilted), Checker(corners, 1.0))
    assert abs(total.value) == pytest.approx(0.85, rel=0.02)


def test_a_card_without_checkers_and_checkers_outside_of_the_picture_are_refused() -> None:
    grey = make_picture(np.full((300, 400), 0.5))
    with pytest.raises(BadSetting, match="no checker of 4 cm"):
        find_checkers(grey, (0.04,), 1000.0)
    with pytest.raises(BadSetting, match="at most half of the picture"):
        find_checkers(grey, (0.5,), 1000.0)
    corners = np.array([(-10.0, 0.0), (30.0, 0.0), (30.0, 40.0), (-10.0, 40.0)])
    with pytest.raises(BadSetting, match="leaves the picture"):
        read_difference(grey, Checker(corners, 1.0))
    with pytest.raises(BadSetting, match=r"(0|1) pixels"):
        read_difference(grey, Checker(corners / 20.0 + 50.0, 1.0))
