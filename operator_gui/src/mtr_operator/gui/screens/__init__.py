"""What fills the main window, one at a time."""
# SPDX-License-Identifier: Apache-2.0
