"""Operator's station without its window: links in a thread, settings, readiness, estimates; no Qt."""
# SPDX-License-Identifier: Apache-2.0
