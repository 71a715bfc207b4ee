"""Gateway between the Operator's link and the robot's nodes."""
