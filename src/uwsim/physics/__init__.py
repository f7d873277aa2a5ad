"""The physics room."""
