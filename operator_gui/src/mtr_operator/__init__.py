"""The Operator's application of the mobile testing robot."""
# SPDX-License-Identifier: Apache-2.0
__version__ = "0.2.0"
