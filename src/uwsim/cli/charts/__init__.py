"""Commands about charts of the sea floor."""
