"""What is around the robot: the Car's body, poles, walls, people, and the test sites made of them."""
# SPDX-License-Identifier: Apache-2.0
