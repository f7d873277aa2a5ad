"""The output of commands: tables, progress, image files."""
