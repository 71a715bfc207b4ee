"""Response and painting times of the Operator's window, and its use of the laptop's processor and memory."""
# SPDX-License-Identifier: Apache-2.0
