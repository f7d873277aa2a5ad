"""The exceptions of uwsim.

.. code-block:: text

    UwsimError
      SeveralErrors        ... several errors of one call
      FileError            an invalid file; contains every error, each with its line
        SceneError         ... a scene or robot file
        BenchmarkError     ... a benchmark file
        PluginError        ... a plugin
      UnknownName          an unknown name; the error message gives the nearest known one
      AssetNotFound        a file that was not found; the error message lists the folders searched
      AssetError           a file that was found and cannot be used
      BadSetting           a command-line setting or a parameter that cannot be used
      BadMessage           an invalid message or request for its topic or service
      NotAllowed           a use of the node that is forbidden to algorithms under test
      MissingExtra         an optional dependency that is missing; the error message names it
      NoGraphics           no OpenGL context; the error message names the package to install
      RunFailed            a run that failed
        ClientLost         ... because a client in lock-step did not answer
        SimulationFailed   ... because a motion is impossible, or the engine stopped
      NeverStarted         a start trigger of a benchmark that never switched on
      ResultError          a result that cannot be read or resumed, or is inconsistent
        ReplayDiffers      ... a replay whose rows differ from the stored rows
"""

from __future__ import annotations

import difflib
import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Literal

MAX_LISTED_NAMES = 16
"""The greatest number of names that an error lists; of more names, the nearest `N_NEAREST`."""
MAX_NAME_LENGTH = 200
"""The longest name that is compared with valid names [characters]; peers send longer ones."""
N_NEAREST = 3
MAX_REPR_LENGTH = 80
"""The longest text of a value of third-party code in an error [characters]."""


class UwsimError(Exception):
    """The base of all errors of uwsim; its message is for the user.

    Worker processes send errors to their parent by pickle, which does not call the ``__init__`` of
    a subclass.
    """

    def __init__(self, message: str = "", *, name: str = "") -> None:
        self.name = name
        """The name in a file to which the error refers, and which gives its line; may be empty."""
        super().__init__(message)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self).__new__, (type(self), *self.args), self.__dict__


@dataclass(frozen=True, kw_only=True)
class Diagnostic:
    """An error, a warning or a note about a file."""

    file: str
    """The file as the user named it."""
    line: int | None
    """The line number from 1; None for the whole file."""
    message: str
    """The text: what was found, what was expected, and the nearest valid value."""
    severity: Literal["error", "warning", "note"] = "error"
    """The severity; a file with warnings and notes alone is valid. A note informs."""

    def __str__(self) -> str:
        place = self.file if self.line is None else f"{self.file}:{self.line}"
        kind = "" if self.severity == "error" else f"{self.severity}: "
        return f"{place}: {kind}{self.message}"


class FileError(UwsimError):
    """An invalid file, with all of its errors."""

    def __init__(self, diagnostics: Sequence[Diagnostic]) -> None:
        self.diagnostics = tuple(diagnostics)
        super().__init__("\n".join(str(diagnostic) for diagnostic in self.diagnostics))


class SeveralErrors(UwsimError):
    """Several errors of one call, one per line."""

    def __init__(self, errors: Sequence[UwsimError]) -> None:
        self.errors = tuple(errors)
        super().__init__("\n".join(str(error) for error in self.errors))


class SceneError(FileError):
    """An invalid scene or robot file."""


class BenchmarkError(FileError):
    """An invalid benchmark file."""


class PluginError(FileError):
    """An invalid plugin, or one that raised an exception."""


class UnknownName(UwsimError):
    """An unknown name."""

    def __init__(self, kind: str, name: str, valid_names: Iterable[str]) -> None:
        self.kind, self.valid_names = kind, tuple(sorted(valid_names))
        super().__init__(
            f"No {kind} is called {name!r}.{choices(name, self.valid_names)}.", name=name
        )


class AssetNotFound(UwsimError):
    """A file that was not found in the folders searched."""


class AssetError(UwsimError):
    """A file that was found and cannot be used."""


class BadSetting(UwsimError):
    """A command-line setting or parameter that cannot be used."""


class BadMessage(UwsimError):
    """An invalid message or request for its topic or service: an error of the sender."""


class NotAllowed(UwsimError):
    """A use of the node that algorithms may not make: floods, threads, reading results."""


class MissingExtra(UwsimError):
    """An optional dependency that is not installed."""


class NoGraphics(UwsimError):
    """A missing OpenGL context."""


class NeverStarted(UwsimError):
    """A start trigger of a benchmark that never switched on."""


class RunFailed(UwsimError):
    """A run that failed; its finished parts are kept."""


class ClientLost(RunFailed):
    """A client in lock-step that did not answer or left; the run is invalid from then on."""


class SimulationFailed(RunFailed):
    """An impossible motion of a body, or an engine that stopped; later states are invalid."""


class ResultError(UwsimError):
    """A result that cannot be read or resumed, or is inconsistent."""


class ReplayDiffers(ResultError):
    """A replay whose rows differ from the stored rows; only a run detects it."""


@contextmanager
def name_file_in_errors(path: object, draft: object = None) -> Iterator[None]:
    """Make system errors in this block, such as a full disk, name the file that is written.

    Args:
        path: the path of the file.
        draft: the path of the temporary file or folder that later replaces it; errors do not name
            it.
    """
    try:
        yield
    except BrokenPipeError:
        raise
    except OSError as error:
        name, folder = str(error.filename or draft), f"{draft}{os.sep}"
        if error.errno is None or not (name == str(draft) or name.startswith(folder)):
            raise
        user_path = f"{path}{name[len(str(draft)) :]}"
        raise OSError(error.errno, error.strerror or str(error), user_path) from error


RUN_ERRORS = (NeverStarted, ReplayDiffers, RunFailed)
"""The errors that only a run detects; every other `UwsimError` is invalid input."""


class ErrorCollector:
    """A collector of the errors of one call, which reports all of them at once."""

    def __init__(self) -> None:
        self._errors: list[UwsimError] = []

    @contextmanager
    def collect(self) -> Iterator[None]:
        """Collect an error that the block raises, and continue after the block."""
        try:
            yield
        except SeveralErrors as error:
            self._errors += error.errors
        except UwsimError as error:
            self._errors.append(error)

    def raise_errors(self) -> None:
        """Raise the collected errors, if any: one as it is, several as `SeveralErrors`."""
        errors_by_text: dict[str, UwsimError] = {}
        for error in self._errors:
            errors_by_text.setdefault(str(error), error)
        errors = list(errors_by_text.values())
        if errors:
            raise errors[0] if len(errors) == 1 else SeveralErrors(errors)


def choices(name: str, valid_names: Iterable[str], *, heading: str = "Known") -> str:
    """Return " Did you mean 'x'? Known: x, y"; for many names, only the nearest."""
    names = list(valid_names)
    suggestion = did_you_mean(name, names)
    if len(names) <= MAX_LISTED_NAMES:
        return f"{suggestion} {heading}: {', '.join(names) or 'none'}"
    nearest_names = difflib.get_close_matches(
        name[:MAX_NAME_LENGTH], names, n=N_NEAREST, cutoff=0.0
    )
    return f"{suggestion} Nearest of {len(names)}: {', '.join(nearest_names)}"


def type_and_text(error: BaseException) -> str:
    """Return the type and the text of an exception of third-party code as one line."""
    return " ".join(f"{type(error).__name__}: {error}".split()).removesuffix(":")


def short_repr(value: object) -> str:
    """Return the text of a value of third-party code as one line, shortened if it is long."""
    try:
        text = " ".join(repr(value).split())
    except Exception:  # its repr raises, or it is an integer of too many digits
        return f"a {type(value).__name__}"
    return text if len(text) <= MAX_REPR_LENGTH else text[: MAX_REPR_LENGTH - 3] + "..."


def did_you_mean(name: str, valid_names: Iterable[str]) -> str:
    """Return " Did you mean 'x'?" for the nearest valid name, or "" if none is near."""
    if len(name) > MAX_NAME_LENGTH:
        return ""
    names = list(valid_names)
    names_by_lower = {candidate.lower(): candidate for candidate in names}
    close_names = difflib.get_close_matches(name.lower(), names_by_lower, n=1, cutoff=0.6)
    return f" Did you mean {names_by_lower[close_names[0]]!r}?" if close_names else ""
