"""Commands about vehicles: how they move."""
