"""Model of the peripherals' firmware as seen from the wire."""
# SPDX-License-Identifier: Apache-2.0
