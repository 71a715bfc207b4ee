"""Geometry of the robot, read from its URDF for all nodes."""
