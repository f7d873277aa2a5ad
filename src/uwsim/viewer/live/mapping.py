"""What keys, gamepad and sticks of the page do: by default, and by a file of the user's.

.. code-block:: toml

    dead_zone = 0.08
    axes = ["yaw", "-heave", "sway", "-surge"]      # of the gamepad, in its order
    buttons = ["", "", "", "", "", "", "-jaw", "+jaw"]
    sticks = ["yaw", "heave", "sway", "surge"]      # those on the screen

    [keys]
    w = "+surge"
    s = "-surge"
    z = "+thruster1 -thruster2"                     # several axes at once
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

from ...algorithms.pilot import AXES
from ...errors import BadSetting, did_you_mean

KEYS = {
    **{"w": "+surge", "s": "-surge", "d": "+sway", "a": "-sway", "e": "+yaw", "q": "-yaw"},
    **{"r": "+heave", "v": "-heave", "t": "+joint1", "g": "-joint1", "y": "+joint2"},
    **{"h": "-joint2", "u": "+joint3", "j": "-joint3", "i": "+joint4", "k": "-joint4"},
    **{"o": "+jaw", "l": "-jaw", "m": "+lamps", "n": "-lamps"},
}
"""Key -> axis and direction; none of those by which the page itself is used."""


@dataclass(frozen=True, kw_only=True)
class PilotMapping:
    """Which axis everything moves, or which axes, with blanks between them."""

    keys: Mapping[str, str] = field(default_factory=lambda: KEYS)
    """Key, as the browser names it in lower case -> axes with their signs."""
    axes: tuple[str, ...] = ("yaw", "-heave", "sway", "-surge")
    """Of the axes of the gamepad."""
    buttons: tuple[str, ...] = ("", "", "", "", "", "", "-jaw", "+jaw")
    """Of its buttons."""
    sticks: tuple[str, ...] = ("yaw", "heave", "sway", "surge")
    """Of the sticks on the screen: left x, left y, right x, right y."""
    dead_zone: float = 0.08
    """Of gamepad and sticks: less counts as none [1]."""

    def values(self, said: Mapping[str, Any]) -> tuple[float, ...]:
        """Return the value of each axis, -1..1, for a message of the page; nonsense counts as 0."""
        total = dict.fromkeys(AXES, 0.0)
        pressed = said.get("keys")
        for key in pressed[:32] if isinstance(pressed, list) else ():
            if isinstance(key, str) and key in self.keys:
                _add(total, self.keys[key], 1.0)
        for name in ("axes", "buttons", "sticks"):
            numbers = said.get(name)
            for target, number in zip(
                getattr(self, name), numbers if isinstance(numbers, list) else (), strict=False
            ):
                if target and abs(value := _number(number)) > self.dead_zone:
                    _add(total, target, value)
        return tuple(min(1.0, max(-1.0, total[axis])) for axis in AXES)


def read_mapping(path: Path) -> PilotMapping:
    """Read a mapping file; what it lacks is as usual.

    Raises:
        BadSetting: it cannot be read, or names an axis that there is not.
    """
    try:
        read = tomllib.loads(path.read_text(encoding="utf-8"))
    except RecursionError:
        raise BadSetting(f"--pilot-mapping {path}: lists are nested too deeply.") from None
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        raise BadSetting(f"--pilot-mapping {path}: cannot be read: {why}.") from None
    known = [each.name for each in fields(PilotMapping)]
    for name, value in read.items():
        if name not in known:
            raise BadSetting(f"--pilot-mapping {path}: {name!r}?{did_you_mean(name, known)}")
        _check(path, name, value)
    given: dict[str, Any] = {k: tuple(v) if isinstance(v, list) else v for k, v in read.items()}
    return PilotMapping(**given)


def _check(path: Path, name: str, value: object) -> None:
    if name == "dead_zone":
        if not isinstance(value, int | float) or not 0.0 <= value < 1.0:
            raise BadSetting(f"--pilot-mapping {path}: dead_zone is {value!r}; expected 0 to 1.")
        return
    targets = list(value.values()) if isinstance(value, dict) else value
    if isinstance(value, dict) != (name == "keys") or not isinstance(targets, list):
        raise BadSetting(f"--pilot-mapping {path}: {name} is {value!r}; see docs/piloting.md.")
    for target in targets:
        if not isinstance(target, str):
            raise BadSetting(
                f"--pilot-mapping {path}: {name} has {repr(target)[:60]}; expected the names of "
                "axes in quotation marks."
            )
    for target in " ".join(targets).split():
        axis = target.removeprefix("-").removeprefix("+")
        if axis not in AXES:
            raise BadSetting(
                f"--pilot-mapping {path}: {name}: no axis is called {target!r}."
                f"{did_you_mean(axis, AXES)} Axes: {', '.join(AXES)}."
            )


def _add(total: dict[str, float], targets: str, value: float) -> None:
    for target in targets.split():
        total[target.lstrip("+-")] += -value if target.startswith("-") else value


def _number(value: object) -> float:
    """A number of a page, -1..1; 0 for what is none."""
    if isinstance(value, bool) or not isinstance(value, int | float) or value != value:
        return 0.0
    return float(min(1, max(-1, value)))


def merged(by_viewer: Mapping[int, Sequence[float]]) -> tuple[float, ...] | None:
    """Return what all pilots do together, -1..1 each; None where there is none."""
    if not by_viewer:
        return None
    sums = [sum(column) for column in zip(*by_viewer.values(), strict=True)]
    return tuple(min(1.0, max(-1.0, value)) for value in sums)
