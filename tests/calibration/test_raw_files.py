"""Raw files of a camera."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest

from uwsim.calibration.pictures.frames import read_frame
from uwsim.calibration.pictures.raw_files import average_cells
from uwsim.errors import AssetError, MissingExtra

LEVELS = {"R": 1000, "G": 3000, "B": 500}
BLACK = 64
SHORT, LONG, RATIONAL, SIGNED_RATIONAL, BYTE, ASCII = 3, 4, 5, 10, 1, 2


def write_dng(path: Path, rows: int = 64, columns: int = 96) -> None:
    """Write a small DNG file: a Bayer pattern of three levels, without compression."""
    sensor = np.full((rows, columns), LEVELS["G"] + BLACK, dtype="<u2")
    sensor[0::2, 0::2] = LEVELS["R"] + BLACK
    sensor[1::2, 1::2] = LEVELS["B"] + BLACK
    identity = [number for row in np.eye(3, dtype=int).tolist() for n in row for number in (n, 1)]
    entries: list[tuple[int, int, list[int] | bytes]] = [
        (254, LONG, [0]), (256, LONG, [columns]), (257, LONG, [rows]), (258, SHORT, [16]),
        (259, SHORT, [1]), (262, SHORT, [32803]), (271, ASCII, b"Tank\0"), (272, ASCII, b"Phone\0"),
        (273, LONG, [0]), (274, SHORT, [1]), (277, SHORT, [1]), (278, LONG, [rows]),
        (279, LONG, [sensor.nbytes]), (284, SHORT, [1]), (33421, SHORT, [2, 2]),
        (33422, BYTE, bytes([0, 1, 1, 2])), (50706, BYTE, bytes([1, 4, 0, 0])),
        (50708, ASCII, b"Tank Phone\0"), (50714, LONG, [BLACK]), (50717, LONG, [4095]),
        (50721, SIGNED_RATIONAL, identity), (50728, RATIONAL, [1, 1, 1, 1, 1, 1]),
    ]  # fmt: skip
    formats = {SHORT: "H", LONG: "I", RATIONAL: "I", SIGNED_RATIONAL: "i"}
    head = 8 + 2 + 12 * len(entries) + 4
    extra, table = b"", b""
    for tag, kind, values in entries:
        if isinstance(values, bytes):
            data, count = values, len(values)
        else:
            data = struct.pack(f"<{len(values)}{formats[kind]}", *values)
            count = len(values) // 2 if kind in (RATIONAL, SIGNED_RATIONAL) else len(values)
        if len(data) > 4:
            place = struct.pack("<I", head + len(extra))
            extra += data + b"\0" * (len(data) % 2)
        else:
            place = data.ljust(4, b"\0")
        table += struct.pack("<HHI", tag, kind, count) + place
    offset = head + len(extra)
    strip = struct.pack("<HHI", 273, LONG, 1)
    table = table.replace(strip + b"\0\0\0\0", strip + struct.pack("<I", offset))
    file = b"II*\0" + struct.pack("<IH", 8, len(entries)) + table + b"\0" * 4 + extra
    path.write_bytes(file + sensor.tobytes())


def test_a_colour_is_the_mean_of_its_pixels_in_each_cell() -> None:
    numbers = np.array([[10.0, 20.0, 14.0, 24.0], [30.0, 40.0, 34.0, 44.0]])
    colours = np.array([[0, 1, 0, 1], [3, 2, 3, 2]])
    planes = average_cells(numbers, colours, "RGBG", [1, 2, 3, 4])
    np.testing.assert_array_equal(planes, [[[9.0, 22.0, 37.0], [13.0, 26.0, 41.0]]])


def test_a_dng_is_read_without_its_black_level(tmp_path: Path) -> None:
    pytest.importorskip("rawpy", reason="rawpy is not installed: pip install uwsim[raw]")
    write_dng(tmp_path / "frame.dng")
    frame = read_frame(tmp_path / "frame.dng")
    assert frame.shape == (32, 48, 3)
    np.testing.assert_array_equal(frame[5, 7], [LEVELS["R"], LEVELS["G"], LEVELS["B"]])


def test_a_damaged_dng_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("rawpy", reason="rawpy is not installed: pip install uwsim[raw]")
    (tmp_path / "damaged.dng").write_bytes(b"nothing")
    with pytest.raises(AssetError, match="is not a raw file that LibRaw reads"):
        read_frame(tmp_path / "damaged.dng")
    write_dng(tmp_path / "huge.dng")
    monkeypatch.setattr("uwsim.calibration.pictures.frames.MAX_PIXELS", 100)
    with pytest.raises(AssetError, match="expected at most 100"):
        read_frame(tmp_path / "huge.dng")


def test_without_rawpy_the_error_names_its_installation(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_dng(tmp_path / "frame.dng")
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(MissingExtra, match=r"pip install 'uwsim\[raw\]'"):
        read_frame(tmp_path / "frame.dng")
