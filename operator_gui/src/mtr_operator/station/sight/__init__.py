"""The robot's view of the Car's surroundings: for the picture, and for the check of the plan before a test."""
# SPDX-License-Identifier: Apache-2.0
