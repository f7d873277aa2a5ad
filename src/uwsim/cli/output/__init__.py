"""What commands print and write: tables, progress, image files."""
