"""What can be seen of a scene: images, rays, the sand below."""
