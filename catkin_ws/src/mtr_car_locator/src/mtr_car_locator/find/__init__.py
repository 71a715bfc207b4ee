"""From surfaces to the one rectangle that is the Car, or to a sentence that says why there is none."""
# SPDX-License-Identifier: Apache-2.0
