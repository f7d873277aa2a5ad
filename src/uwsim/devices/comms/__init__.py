"""Communication devices (modems), and the channels on which they send and receive."""
