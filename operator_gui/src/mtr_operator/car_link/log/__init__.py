"""Logs of the Car's bus: written with each test, and read again in place of a bus."""
# SPDX-License-Identifier: Apache-2.0
