"""Exit codes of the command line; nothing is imported here, so that the first lines to run can have them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

# All lines were measured, and keep the limits where there are some.
EXIT_PASS = 0
# A robot was looked at, and no test could begin.
EXIT_NOT_READY = 1
# What was asked for could not be done.
EXIT_ERROR = 2
# The command line was not understood, as argparse has it.
EXIT_USAGE = 2
# A line breaks a limit.
EXIT_FAIL = 3
# A replay differs from the record.
EXIT_CHANGED = 3
# Of a line nobody knows whether it keeps its limits, and none breaks one.
EXIT_INCONCLUSIVE = 4
# Ended by Ctrl-C, as a shell has it: 128 and the number of SIGINT.
EXIT_INTERRUPTED = 130
