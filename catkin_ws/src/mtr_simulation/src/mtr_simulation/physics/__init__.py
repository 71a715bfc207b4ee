"""Robot as a body: MuJoCo's model of the robot and its site, tyres on the ground, and the base's own speed control."""
# SPDX-License-Identifier: Apache-2.0
