"""Check that the robot may be stopped for an update: it is at standstill and a stop is engaged."""
# SPDX-License-Identifier: Apache-2.0
