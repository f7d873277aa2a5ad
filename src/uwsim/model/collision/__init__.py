"""Collision shapes of the bodies of a scene, and the ground on which bodies rest."""
