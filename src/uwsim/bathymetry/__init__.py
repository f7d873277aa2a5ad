"""Charts of the sea floor: their files, their place in a scene, and synthetic ones."""
