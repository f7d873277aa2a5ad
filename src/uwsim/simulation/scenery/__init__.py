"""The visible side of a scene: images, rays, and the sand over buried objects."""
