"""The peripherals' firmware as a model of what the wire shows of it."""
# SPDX-License-Identifier: Apache-2.0
