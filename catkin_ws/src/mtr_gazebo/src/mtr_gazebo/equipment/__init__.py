"""Simulated firmware and Car, which use the key pose of Gazebo."""
# SPDX-License-Identifier: Apache-2.0
