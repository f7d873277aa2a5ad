"""What is read but not simulated yet, and how that is said."""

from __future__ import annotations

from ..errors import UwsimError


class NotSimulatedYet(UwsimError):
    """An element that a later version will play."""

    def __init__(self, element: str) -> None:
        super().__init__(f"<{element}> is read, not simulated yet.")
