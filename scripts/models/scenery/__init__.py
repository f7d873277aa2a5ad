"""Models for scenes in physical water, with normal, roughness and occlusion maps."""
