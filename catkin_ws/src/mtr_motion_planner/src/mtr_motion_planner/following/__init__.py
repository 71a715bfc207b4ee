"""The velocity that keeps the robot on its plan, and the checks that stop it."""
# SPDX-License-Identifier: Apache-2.0
