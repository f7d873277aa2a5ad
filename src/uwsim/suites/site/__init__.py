"""The page of a leaderboard: a static page from a folder of submissions."""
