"""Executors for long work: within the requesting tick, or in separate processes in parallel to the ticks."""
# SPDX-License-Identifier: Apache-2.0
from .inline import InlineExecutor
from .process import ProcessesExecutor, ProcessExecutor

__all__ = ["InlineExecutor", "ProcessExecutor", "ProcessesExecutor"]
