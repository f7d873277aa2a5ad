"""The viewer: replays, live views and films of runs, and recordings for other viewers."""
