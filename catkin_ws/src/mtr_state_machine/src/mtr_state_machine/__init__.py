"""High-level behaviour of the robot: its permitted next actions, and its faults."""
