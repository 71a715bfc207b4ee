"""Entry point of python -m mtr_results, the same as the command mtr-results."""
# SPDX-License-Identifier: Apache-2.0
import sys

from .cli import main

if __name__ == "__main__":
    sys.exit(main())
