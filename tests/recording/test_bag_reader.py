"""Files that are no recordings."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.bus import Bus
from uwsim.errors import AssetError, BadSetting
from uwsim.middleware.recording import BagReader, Recorder


@pytest.mark.parametrize(
    ("begin", "said"),
    [(b"junk", "it is not a .bag file"), (b"\x89MCAP0\r\n", "it is a .mcap file")],
)
def test_a_file_that_is_no_bag_of_ros_1_says_what_it_is(
    tmp_path: Path, begin: bytes, said: str
) -> None:
    path = tmp_path / "x.bag"
    path.write_bytes(begin)
    with pytest.raises(AssetError, match=said):
        BagReader(path)


@pytest.mark.parametrize("name", ["x.bag", "x.mcap"])
def test_a_folder_that_cannot_be_written_is_one_line(tmp_path: Path, name: str) -> None:
    (tmp_path / "file").write_text("no folder")
    with pytest.raises(BadSetting, match=r"--record .*: cannot be written: File exists\."):
        Recorder(Bus(), tmp_path / "file" / name)
