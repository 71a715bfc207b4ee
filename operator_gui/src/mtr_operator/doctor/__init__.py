"""What this computer lacks to run tests, in sentences."""
# SPDX-License-Identifier: Apache-2.0
