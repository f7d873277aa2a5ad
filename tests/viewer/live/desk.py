"""A server of live views without a network: what was published, and what viewers say."""

from __future__ import annotations

from typing import Any


class Desk:
    """Stands for `uwsim.viewer.live.server.LiveServer`, with one viewer.

    Args:
        wanted: channels that are asked for.
        said: messages of viewers that wait, each with the number of its viewer.
    """

    n_viewers = 1

    def __init__(
        self,
        wanted: frozenset[str] = frozenset(),
        said: list[tuple[int, dict[str, Any]]] | None = None,
    ) -> None:
        self._wanted = wanted
        self.said = said or []
        self.published: list[tuple[str, Any]] = []

    def publish(self, channel: str, content: str | bytes) -> None:
        """Keep what is published."""
        self.published.append((channel, content))

    def on(self, channel: str) -> list[Any]:
        """Return what was published on a channel."""
        return [content for name, content in self.published if name == channel]

    def forget(self, channels: object) -> None:
        """Nothing is kept for later viewers."""

    def wanted(self) -> frozenset[str]:
        """Channels that are asked for."""
        return self._wanted

    def messages(self) -> list[tuple[int, dict[str, Any]]]:
        """Take what viewers have said."""
        said, self.said = self.said, []
        return said
