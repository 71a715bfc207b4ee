"""Pure Python shared by the robot's nodes."""
