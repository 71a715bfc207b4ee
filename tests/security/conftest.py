"""The helpers lie beside the tests."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).parent))
