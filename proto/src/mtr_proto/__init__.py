"""Messages of the link between laptop and robot, generated from robot_link.proto."""
