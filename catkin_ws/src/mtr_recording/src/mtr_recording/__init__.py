"""Recording of the robot's topics, bounded in size, and what a replay of it decided otherwise."""
# SPDX-License-Identifier: Apache-2.0
