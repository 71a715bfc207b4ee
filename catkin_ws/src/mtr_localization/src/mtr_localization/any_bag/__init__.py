"""Conversion of a bag of any robot with a level LiDAR and odometry to the inputs of localization."""
# SPDX-License-Identifier: Apache-2.0
