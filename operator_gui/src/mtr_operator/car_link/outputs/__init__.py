"""Outputs that the application switches at the Car by messages on its bus: the handle actuator and an extender."""
# SPDX-License-Identifier: Apache-2.0
