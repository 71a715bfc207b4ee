"""Faults on request: what they do, when, and where they take hold."""
# SPDX-License-Identifier: Apache-2.0
