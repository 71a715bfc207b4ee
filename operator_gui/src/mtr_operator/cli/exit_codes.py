"""Exit codes of the command line; this module imports nothing, so that the entry point can use it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

# All lines were measured, and keep the limits if there are any.
EXIT_PASS = 0
# A robot was checked, and no test could start.
EXIT_NOT_READY = 1
# The command failed.
EXIT_ERROR = 2
# The command line was invalid, as with argparse.
EXIT_USAGE = 2
# A line breaks a limit.
EXIT_FAIL = 3
# A replay differs from the record.
EXIT_CHANGED = 3
# For some line the verdict is undecided, and no line breaks a limit.
EXIT_INCONCLUSIVE = 4
# Ended by Ctrl-C, with the code of a shell: 128 and the number of SIGINT.
EXIT_INTERRUPTED = 130
