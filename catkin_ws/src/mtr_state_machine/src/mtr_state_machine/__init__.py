"""High-level behaviour of the robot: what it may do next, and its faults."""
