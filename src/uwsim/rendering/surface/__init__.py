"""The water's surface in images, the sky, and the air above the water."""
