"""The visible surfaces of a scene: rendering, ray casting, and the sand over buried objects."""
