"""Manual controller with dead-man switch."""
