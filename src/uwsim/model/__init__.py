"""The model of a scene: everything that is computed from its files and does not change in a run."""
