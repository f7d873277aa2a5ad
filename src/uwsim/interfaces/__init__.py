"""The interfaces room."""
