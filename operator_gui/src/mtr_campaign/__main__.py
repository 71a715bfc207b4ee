"""Entry point of python -m mtr_campaign."""
# SPDX-License-Identifier: Apache-2.0
import sys

from mtr_campaign.cli import main

if __name__ == "__main__":
    sys.exit(main())
