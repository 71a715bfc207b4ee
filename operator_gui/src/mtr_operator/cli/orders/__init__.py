"""Orders of the command line to the robot outside a test."""
# SPDX-License-Identifier: Apache-2.0
