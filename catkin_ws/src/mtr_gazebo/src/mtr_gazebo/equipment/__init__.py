"""Firmware and Car of the other simulation, which see the key where Gazebo has it."""
# SPDX-License-Identifier: Apache-2.0
