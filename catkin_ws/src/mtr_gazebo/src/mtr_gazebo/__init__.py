"""Site, body and sensors of the robot in Gazebo, from the same sources as the other simulator."""
# SPDX-License-Identifier: Apache-2.0
