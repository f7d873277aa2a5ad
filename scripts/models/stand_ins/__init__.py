"""Models in place of those of UWSim, whose files are not free to copy."""
