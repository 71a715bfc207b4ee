"""Recording of the robot's topics with bounded size, and comparison of decisions with a replay."""
# SPDX-License-Identifier: Apache-2.0
