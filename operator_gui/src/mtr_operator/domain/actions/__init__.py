"""What a scenario does with robot and Car: actions that block, on one loop of Status and answer."""
# SPDX-License-Identifier: Apache-2.0
