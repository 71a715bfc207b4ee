"""Common settings of all pictures made with matplotlib."""
# SPDX-License-Identifier: Apache-2.0
