"""The images of a trial for its report: snapshots of cameras, and an image of each phase."""
