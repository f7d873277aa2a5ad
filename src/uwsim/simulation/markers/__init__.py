"""Markers that programs add: `spawned` stores them, `lines` draws them for viewers."""

from __future__ import annotations

from .spawned import SERVICE, TYPES, Markers

__all__ = ["SERVICE", "TYPES", "Markers"]
