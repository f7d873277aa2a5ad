"""A channel of an unknown lamp, and a seventh rangefinder, are errors with their lines."""

from __future__ import annotations

from pathlib import Path

import uwsim
from uwsim.assets.bundled import bundled_files


def messages_of(text: str, folder: Path) -> list[str]:
    path = folder / "scene.xml"
    path.write_text(text)
    return [str(d) for d in uwsim.check(path) if d.severity == "error"]


def test_an_unknown_lamp_is_an_error_with_the_nearest_name(tmp_path: Path) -> None:
    text = bundled_files("scenes")["bluerov2-scene"].read_text()
    assert messages_of(text, tmp_path) == []
    changed = text.replace("<lamp>lights_port</lamp>", "<lamp>light_port</lamp>")
    (message,) = messages_of(changed, tmp_path)
    line = 1 + changed[: changed.index("<lamp>light_port")].count("\n")
    assert message.endswith(
        f"scene.xml:{line}: No lamp is called 'light_port'. Did you mean lights_port?"
    )


def test_seven_rangefinders_are_too_many(tmp_path: Path) -> None:
    text = bundled_files("scenes")["bluerov2-scene"].read_text()
    one = "<rangefinder>/bluerov2/altitude</rangefinder>"
    (message,) = messages_of(text.replace(one, one * 7), tmp_path)
    assert "7 <rangefinder>: ArduPilot reads 6." in message
