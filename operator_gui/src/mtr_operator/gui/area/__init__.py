"""The test area: drawn by the Operator, and shown as the robot enforces it."""
# SPDX-License-Identifier: Apache-2.0
