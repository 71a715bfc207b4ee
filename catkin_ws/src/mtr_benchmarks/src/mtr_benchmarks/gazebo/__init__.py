"""The whole test on the wall clock in Gazebo and in MuJoCo, beside each other."""
# SPDX-License-Identifier: Apache-2.0
