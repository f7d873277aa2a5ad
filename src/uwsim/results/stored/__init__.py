"""What a stored value must look like, checked as it is read."""
