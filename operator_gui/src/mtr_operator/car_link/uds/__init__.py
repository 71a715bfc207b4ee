"""The state of the locks of a Car that does not send it by itself: asked for by UDS, ISO 14229 over ISO 15765."""
# SPDX-License-Identifier: Apache-2.0
