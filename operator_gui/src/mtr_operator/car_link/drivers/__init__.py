"""Differences of the CAN drivers: listen-only mode, CAN FD and fault reports."""
# SPDX-License-Identifier: Apache-2.0
