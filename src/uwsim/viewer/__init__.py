"""The page in which a run is seen: its data, replays, live views and films."""
