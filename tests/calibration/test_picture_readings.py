"""Readings of pictures of which some are missing or invalid."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.calibration.example.write_example import SETUP_NAME, write_example
from uwsim.calibration.pictures.picture_readings import read_pictures
from uwsim.calibration.setup import SetupError, read_setup

BOARD = "<source>board</source>"


@pytest.fixture(scope="module")
def tank(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of the example."""
    folder = tmp_path_factory.mktemp("tank")
    write_example(folder)
    return folder


def change_setup(tank: Path, name: str, text: str) -> Path:
    """Write another set-up beside that of the example."""
    path = tank / name
    path.write_text(text)
    return path


def test_a_picture_of_a_phone_with_a_tone_curve_is_an_error_with_its_line(tank: Path) -> None:
    text = (tank / SETUP_NAME).read_text()
    (tank / "clear" / "board.jpg").write_bytes(b"")
    path = change_setup(tank, "jpeg.xml", text.replace("clear/board-0.5-*.png", "clear/board.jpg"))
    line = text[: text.index("clear/board-0.5")].count("\n")
    with pytest.raises(SetupError) as caught:
        read_pictures(read_setup(path), tank)
    [diagnostic] = caught.value.diagnostics
    assert abs((diagnostic.line or 0) - line) <= 4  # that of its <picture>
    assert "board.jpg: .jpg is not read; expected .png" in diagnostic.message
    assert "take raw pictures (.dng) with the phone" in diagnostic.message


def test_a_board_without_reference_gives_no_reading_of_open_water(tank: Path) -> None:
    text = (tank / SETUP_NAME).read_text()
    start = text.rindex("<picture>", 0, text.index(BOARD))
    end = text.index("</picture>", start) + len("</picture>")
    complete = read_pictures(read_setup(tank / SETUP_NAME), tank)
    path = change_setup(tank, "led.xml", text[:start] + text[end:])
    waters = read_pictures(read_setup(path), tank)
    assert [len(water.open_water) for water in complete] == [3, 3]
    assert [len(water.open_water) for water in waters] == [0, 0]
    assert [len(water.readings) for water in waters] == [len(w.readings) for w in complete]
