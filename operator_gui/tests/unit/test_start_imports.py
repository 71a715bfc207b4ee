"""What the window imports before it is seen: what takes long and is needed later comes later."""
# SPDX-License-Identifier: Apache-2.0
import subprocess
import sys

LATE = ("matplotlib", "scipy.stats", "duckdb", "mtr_results", "sqlalchemy", "mcap")


def test_window_is_seen_before_what_takes_long_is_imported():
    told = subprocess.run([sys.executable, "-c", "import sys, mtr_operator.gui.app; print(*sorted(sys.modules))"],
                          check=True, capture_output=True, text=True).stdout.split()
    assert "mtr_operator.gui.windows.main_window" in told
    assert not [name for name in LATE if name in told]
