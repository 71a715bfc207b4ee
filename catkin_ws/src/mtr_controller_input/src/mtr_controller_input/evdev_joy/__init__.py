"""Driver of a game controller for machines without the ROS package joy."""
