"""The clocks of a line: the robot's, the CAN adapter's and the laptop's; what maps one to another, and who was set."""
# SPDX-License-Identifier: Apache-2.0
