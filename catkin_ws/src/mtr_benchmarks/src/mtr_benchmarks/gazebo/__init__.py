"""Complete tests on the wall clock, in Gazebo and in MuJoCo, compared with each other."""
# SPDX-License-Identifier: Apache-2.0
