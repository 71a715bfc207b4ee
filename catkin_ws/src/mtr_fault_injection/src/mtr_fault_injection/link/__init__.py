"""Faults of the Operator's link: a relay in front of its ports, and a foreign Operator."""
# SPDX-License-Identifier: Apache-2.0
