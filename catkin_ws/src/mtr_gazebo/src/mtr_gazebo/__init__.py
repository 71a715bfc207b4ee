"""The robot's site, body and sensors in Gazebo, made from what the other simulation is made of."""
# SPDX-License-Identifier: Apache-2.0
