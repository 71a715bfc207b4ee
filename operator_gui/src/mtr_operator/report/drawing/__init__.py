"""What all pictures made with matplotlib have in common."""
# SPDX-License-Identifier: Apache-2.0
