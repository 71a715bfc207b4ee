"""A bag of any robot with a level LiDAR and odometry, as the inputs that localization takes."""
# SPDX-License-Identifier: Apache-2.0
