"""The water of a scene: its density and its motion."""
