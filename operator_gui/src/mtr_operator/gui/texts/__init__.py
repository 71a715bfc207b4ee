"""What the parts below the window say, listed for translation."""
# SPDX-License-Identifier: Apache-2.0
