"""The exchange with the robot in one run, what the run records, and who assists at the Car."""
# SPDX-License-Identifier: Apache-2.0
