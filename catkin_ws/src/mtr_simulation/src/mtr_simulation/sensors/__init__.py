"""What the robot's sensors say of its true state, with their errors."""
# SPDX-License-Identifier: Apache-2.0
