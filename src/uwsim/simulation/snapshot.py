"""Save and restore: the state of a simulation as bytes, exact to the bit.

Each class whose objects change while a simulation runs names in ``STATE`` what of them changes;
parts that have a state of their own are followed, in lists and dictionaries, too. What follows from
the scene file is not saved: bytes are restored into a simulation of the same scene, seed and
timestep. Not part of it: algorithms that are attached, callbacks, currents that a program has set,
and the hash of the images published so far.
"""

from __future__ import annotations

import dataclasses
import hashlib
import io
import pickle
from collections.abc import Collection, Mapping
from typing import Any

import numpy as np

from ..base.record import Record, assign, copied_record
from ..errors import UwsimError
from ..version import __version__

Values = Mapping[str, Any]
ARRAYS = {
    ("numpy", "dtype"),
    ("numpy", "ndarray"),
    ("numpy._core.multiarray", "_reconstruct"),
    ("numpy._core.multiarray", "scalar"),
    ("numpy._core.numeric", "_frombuffer"),
    ("collections", "deque"),
    ("mujoco._structs", "MjData"),
    ("mujoco._structs", "MjModel"),
}
"""Types allowed in saved bytes, besides numbers, texts and dataclasses of uwsim and rosbags."""


def state_of(thing: object, names: Collection[str] = ()) -> dict[str, Any]:
    """Return the values of the attributes that ``STATE`` of its class names, or of some of them."""
    return {name: _saved(getattr(thing, name)) for name in names or _names(thing)}


def put_state(thing: object, values: Values, names: Collection[str] = ()) -> None:
    """Set the attributes again that `state_of` was asked for; arrays keep their place in memory.

    Raises:
        UwsimError: the values are those of another thing.
    """
    names = names or _names(thing)
    if set(values) != set(names):
        raise _of_another_scene()
    for name in names:
        now, then = getattr(thing, name), values[name]
        if not _restored(now, then):
            setattr(thing, name, then)


def packed(values: Values) -> bytes:
    """Return values as bytes."""
    return pickle.dumps(values, protocol=5)


def unpacked(data: bytes) -> dict[str, Any]:
    """Read values from bytes.

    Raises:
        UwsimError: these are no bytes of a saved simulation.
    """
    try:
        values = _Unpickler(io.BytesIO(data)).load()
    except Exception as error:  # whatever damaged bytes make of themselves
        raise UwsimError(f"These bytes are no saved simulation: {error}.") from None
    if not isinstance(values, dict):
        raise UwsimError("These bytes are no saved simulation.")
    return values


def saved(values: Values, identity: Mapping[str, str]) -> bytes:
    """Return the values of a whole simulation as bytes, with the version of uwsim.

    Args:
        values: what changes while it runs.
        identity: what does not, by its name.
    """
    return packed({"uwsim": __version__, "identity": dict(identity), **values})


def opened(data: bytes, names: Collection[str], identity: Mapping[str, str]) -> dict[str, Any]:
    """Read the values of a whole simulation, which have these names, from bytes.

    Raises:
        UwsimError: these are no bytes of a saved simulation, another version saved them, or the
            simulation had another identity.
    """
    values = unpacked(data)
    if values.pop("uwsim", None) != __version__:
        raise UwsimError(f"The simulation was not saved by uwsim {__version__}.")
    kept = values.pop("identity", None)
    if set(values) != set(names) or not isinstance(kept, dict):
        raise UwsimError("These bytes are no saved simulation.")
    for name, value in identity.items():
        if kept.get(name) != value and name == "scene":
            raise _of_another_scene()
        if kept.get(name) != value:
            raise UwsimError(
                f"The saved simulation has {name} {kept.get(name)}; this one has {value}."
            )
    return values


def digest_of(spec: object) -> str:
    """Return a hash of what a spec says, wherever its file lies."""
    return hashlib.sha256(repr(_plain(spec)).encode()).hexdigest()


def _plain(value: Any) -> object:
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        fields = [each.name for each in dataclasses.fields(value) if each.compare]
        return type(value).__name__, [(name, _plain(getattr(value, name))) for name in fields]
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    return value.tolist() if isinstance(value, np.ndarray) else value


class _Unpickler(pickle.Unpickler):
    """Makes numbers, arrays and messages, and calls nothing else."""

    def find_class(self, module: str, name: str) -> Any:
        if (module, name) in ARRAYS:
            return super().find_class(module, name)
        if module.startswith(("uwsim.", "rosbags.")):
            found = super().find_class(module, name)
            if isinstance(found, type) and dataclasses.is_dataclass(found):
                return found
        raise pickle.UnpicklingError(f"{module}.{name} has no place in them")


def _names(thing: object) -> tuple[str, ...]:
    names: tuple[str, ...] = type(thing).STATE  # type: ignore[attr-defined]
    return names


def _has_state(value: object) -> bool:
    return hasattr(type(value), "STATE") or _has_record(value)


def _has_record(value: object) -> bool:
    return isinstance(getattr(value, "state", None), Record)


def _saved(value: Any) -> Any:
    if _has_record(value):
        return copied_record(value.state)
    if _has_state(value):
        return state_of(value)
    if isinstance(value, np.random.Generator):
        return value.bit_generator.state
    if isinstance(value, dict) and any(map(_has_state, value.values())):
        return {key: _saved(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)) and any(map(_has_state, value)):
        return [_saved(each) if _has_state(each) else None for each in value]
    return value


def _restored(now: Any, then: Any) -> bool:
    """Put a value back into what holds it; False where an attribute must be set instead."""
    if _has_record(now):
        assign(now.state, then)
    elif _has_state(now):
        put_state(now, then)
    elif isinstance(now, np.random.Generator):
        now.bit_generator.state = then
    elif isinstance(now, dict) and any(map(_has_state, now.values())):
        if set(now) != set(then):
            raise _of_another_scene()
        for key, each in now.items():
            _restored(each, then[key])
    elif isinstance(now, (list, tuple)) and any(map(_has_state, now)):
        if len(now) != len(then):
            raise _of_another_scene()
        for each, values in zip(now, then, strict=True):
            if _has_state(each):
                _restored(each, values)
    elif isinstance(now, np.ndarray) and now.flags.writeable and now.shape == np.shape(then):
        now[...] = then
    else:
        return False
    return True


def _of_another_scene() -> UwsimError:
    return UwsimError("The saved simulation is not of this scene.")
