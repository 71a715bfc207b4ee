"""Faults on request: effects, schedule, and control of parts and links."""
# SPDX-License-Identifier: Apache-2.0
