"""What can go wrong, and how it is said.

.. code-block:: text

    UwsimError
      SeveralErrors        ... all that is wrong with a call, at once
      FileError            a file is wrong: all its errors at once, each with its place
        SceneError         ... a scene or robot file
        BenchmarkError     ... a benchmark file
        PluginError        ... a plugin
      UnknownName          a name that nothing has; names the nearest right one
      AssetNotFound        a file that is nowhere; names every folder searched
      AssetError           a file that was found and cannot be used
      BadSetting           a command-line setting or a parameter that cannot be used
      BadMessage           a message or request that its topic or service does not take
      NotAllowed           what an algorithm under test may not do
      MissingExtra         an optional part that is not installed; says how to install it
      NoGraphics           no OpenGL context; says what to install
      RunFailed            a run that broke in the middle
      NeverStarted         the start trigger of a benchmark never went on
      ResultError          a result that cannot be read, resumed or trusted
        ReplayDiffers      ... a replay that did not give the rows that are stored
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Literal

MAX_LISTED = 16
"""So many names are listed; of more the nearest `N_NEAREST`."""
N_NEAREST = 3


class UwsimError(Exception):
    """Anything uwsim refuses to do, with a message for the user.

    Comes out of a pickle as it went in, whatever its ``__init__`` takes: workers send it home.
    """

    def __init__(self, message: str = "", *, name: str = "") -> None:
        self.name = name
        """The word in a file that it is about, by which its line can be found; may be empty."""
        super().__init__(message)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self).__new__, (type(self), *self.args), self.__dict__


@dataclass(frozen=True, kw_only=True)
class Diagnostic:
    """One thing that is wrong, or worth knowing, about a file."""

    file: str
    """The file as the user named it."""
    line: int | None
    """Line number from 1; None when the whole file is meant."""
    message: str
    """What was found, what was expected, and the nearest right answer."""
    severity: Literal["error", "warning"] = "error"
    """A warning does not make the file wrong ("read, not simulated yet")."""

    def __str__(self) -> str:
        place = self.file if self.line is None else f"{self.file}:{self.line}"
        return f"{place}: {self.message}"


class FileError(UwsimError):
    """A file is wrong; carries every error found, not only the first."""

    def __init__(self, diagnostics: Sequence[Diagnostic]) -> None:
        self.diagnostics = tuple(diagnostics)
        super().__init__("\n".join(str(diagnostic) for diagnostic in self.diagnostics))


class SeveralErrors(UwsimError):
    """Several things are wrong with one call; each is said as if it were alone."""

    def __init__(self, errors: Sequence[UwsimError]) -> None:
        self.errors = tuple(errors)
        super().__init__("\n".join(str(error) for error in self.errors))


class SceneError(FileError):
    """A scene or robot file is wrong."""


class BenchmarkError(FileError):
    """A benchmark file is wrong."""


class PluginError(FileError):
    """A plugin is wrong, or raised while it was asked something."""


class UnknownName(UwsimError):
    """A name that nothing has."""

    def __init__(self, kind: str, name: str, known: Iterable[str]) -> None:
        self.kind, self.known = kind, tuple(sorted(known))
        super().__init__(f"No {kind} is called {name!r}.{choices(name, self.known)}.", name=name)


class AssetNotFound(UwsimError):
    """A file that is in none of the folders searched."""


class AssetError(UwsimError):
    """A file that was found and cannot be used."""


class BadSetting(UwsimError):
    """A command-line setting or parameter that cannot be used."""


class BadMessage(UwsimError):
    """A message or request that its topic or service does not take: the sender's error."""


class NotAllowed(UwsimError):
    """What an algorithm under test may not do: flood a topic, use a thread, hear the results."""


class MissingExtra(UwsimError):
    """An optional part that is not installed."""


class NoGraphics(UwsimError):
    """No OpenGL context could be made."""


class NeverStarted(UwsimError):
    """The start trigger of a benchmark never went on."""


class RunFailed(UwsimError):
    """A run that broke in the middle; what was finished is kept."""


class ResultError(UwsimError):
    """A result that cannot be read, resumed or trusted."""


class ReplayDiffers(ResultError):
    """A replay did not give the rows that are stored; found only by running."""


RUN_ERRORS = (NeverStarted, ReplayDiffers, RunFailed)
"""What can only be found by running; every other `UwsimError` is wrong input."""


class AllErrors:
    """Collects what is wrong with one call, so that all of it is said at once."""

    def __init__(self) -> None:
        self._found: list[UwsimError] = []

    @contextmanager
    def kept(self) -> Iterator[None]:
        """Keep what is raised within, and go on behind it."""
        try:
            yield
        except SeveralErrors as error:
            self._found += error.errors
        except UwsimError as error:
            self._found.append(error)

    def check(self) -> None:
        """Raise what was kept, if anything: one error as it is, several as `SeveralErrors`."""
        first: dict[str, UwsimError] = {}
        for error in self._found:
            first.setdefault(str(error), error)
        found = list(first.values())
        if found:
            raise found[0] if len(found) == 1 else SeveralErrors(found)


def choices(name: str, known: Iterable[str], *, called: str = "Known") -> str:
    """Return " Did you mean 'x'? Known: x, y"; of more than `MAX_LISTED` the nearest alone."""
    names = list(known)
    meant = did_you_mean(name, names)
    if len(names) <= MAX_LISTED:
        return f"{meant} {called}: {', '.join(names) or 'none'}"
    near = difflib.get_close_matches(name, names, n=N_NEAREST, cutoff=0.0)
    return f"{meant} Nearest of {len(names)}: {', '.join(near)}"


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return " Did you mean 'x'?" for the nearest known name, or nothing."""
    names = list(known)
    by_lower = {candidate.lower(): candidate for candidate in names}
    close = difflib.get_close_matches(name.lower(), by_lower, n=1, cutoff=0.6)
    return f" Did you mean {by_lower[close[0]]!r}?" if close else ""
