"""CAN databases: read message by message, and the raw values of signals in the data of frames."""
# SPDX-License-Identifier: Apache-2.0
