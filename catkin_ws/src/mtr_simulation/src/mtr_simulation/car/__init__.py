"""Simulated Car: radio, body ECU and CAN adapter."""
# SPDX-License-Identifier: Apache-2.0
