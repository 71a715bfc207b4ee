"""The velocity that keeps the robot on its plan, and what stops it."""
# SPDX-License-Identifier: Apache-2.0
