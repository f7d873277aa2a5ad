"""Warnings about elements of water and cameras that another element makes ineffective."""

from __future__ import annotations

from collections.abc import Iterator

from ...errors import Diagnostic
from ...particles.bubbles import BubblesSpec
from ...schema import NAMESPACE, Spec
from ...sensors.virtual_camera import VirtualCameraSpec
from ..subjects import CheckedScene


def unused_values(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of values of bubbles and cameras that have no effect beside others."""
    water = scene.spec.ocean_state.water
    if water is not None and water.particles is not None and water.particles.bubbles is not None:
        yield from _check_bubbles(scene, water.particles.bubbles)
    for vehicle in scene.spec.vehicles:
        for camera in vehicle.parts_of(VirtualCameraSpec):
            yield from _check_camera(scene, camera)


def _check_bubbles(scene: CheckedScene, bubbles: BubblesSpec) -> Iterator[Diagnostic]:
    if bubbles.source is None:
        reason = "has no effect without <u:source>; <u:concentration> sets the bubbles of a surface"
        yield from _warn(scene, bubbles, "rate", reason)
        return
    reason = "has no effect: bubbles with a <u:source> leave it at <u:rate>"
    for name in ("concentration", "depthScale"):
        yield from _warn(scene, bubbles, name, reason)


def _check_camera(scene: CheckedScene, camera: VirtualCameraSpec) -> Iterator[Diagnostic]:
    response = camera.response
    if response is None:
        return
    reason = "has no effect: <u:response> replaces it; expected its noise in <u:readNoise>"
    yield from _warn(scene, camera, "std", reason, is_namespaced=False)
    if response.falloff:
        reason = "has no effect: <u:falloff> replaces it; expected one of the two"
        yield from _warn(scene, response, "vignetting", reason)


def _warn(
    scene: CheckedScene, spec: Spec, name: str, reason: str, *, is_namespaced: bool = True
) -> Iterator[Diagnostic]:
    """Warn of an element that is in the file; defaults are not."""
    source = spec.source_line
    tag = f"{{{NAMESPACE}}}{name}" if is_namespaced else name
    if source is not None and tag in source.elements:
        shown_name = f"u:{name}" if is_namespaced else name
        yield scene.warning(spec, f"<{shown_name}> {reason}", tag)
