"""A server of live views without a network: it stores what a view publishes."""

from __future__ import annotations

from typing import Any


class Desk:
    """A fake of `uwsim.viewer.live.server.LiveServer`, with one viewer.

    Args:
        wanted: the requested channels.
        said: the waiting messages, each with the number of its viewer.
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
        """Store the content."""
        self.published.append((channel, content))

    def on(self, channel: str) -> list[Any]:
        """Return the contents of a channel."""
        return [content for name, content in self.published if name == channel]

    def remove_channels(self, channels: object) -> None:
        """Remove nothing, as there are no later viewers."""

    def channels(self) -> frozenset[str]:
        """Return the requested channels."""
        return self._wanted

    def pop_messages(self) -> list[tuple[int, dict[str, Any]]]:
        """Take out the messages of viewers."""
        said, self.said = self.said, []
        return said
