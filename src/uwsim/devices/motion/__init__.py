"""The motion of a vehicle as it is given from outside: a table of poses, or a real vehicle."""
