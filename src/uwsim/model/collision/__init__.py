"""The collision shapes of a scene, and the ground that they form."""
