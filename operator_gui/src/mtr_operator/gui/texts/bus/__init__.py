"""Sentences on the Car's bus: its adapter, and its logs."""
# SPDX-License-Identifier: Apache-2.0
