"""The Operator's connection to the Car's CAN bus, and its substitute."""
# SPDX-License-Identifier: Apache-2.0
