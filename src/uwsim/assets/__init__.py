"""The assets room."""
