"""Where long work is done: within the tick that asks for it, or beside the ticks in processes of its own."""
# SPDX-License-Identifier: Apache-2.0
from .inline import InlineExecutor
from .process import ProcessesExecutor, ProcessExecutor

__all__ = ["InlineExecutor", "ProcessExecutor", "ProcessesExecutor"]
