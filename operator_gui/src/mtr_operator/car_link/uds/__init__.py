"""Lock state of a Car that does not send it by itself: polled by UDS, ISO 14229 over ISO 15765."""
# SPDX-License-Identifier: Apache-2.0
