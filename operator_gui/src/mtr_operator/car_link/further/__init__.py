"""Signals of a Car in addition to its lock state, in any message on any bus."""
# SPDX-License-Identifier: Apache-2.0
