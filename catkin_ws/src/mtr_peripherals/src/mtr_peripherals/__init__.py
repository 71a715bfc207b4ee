"""Key height, button presses and LEDs between the robot's nodes and the firmware."""
