"""Entry point of `python -m mtr_operator`."""
# SPDX-License-Identifier: Apache-2.0
import sys

from mtr_operator.cli import main

sys.exit(main())
