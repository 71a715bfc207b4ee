"""Path around the Car and along an axis, and the velocity that follows the path."""
# SPDX-License-Identifier: Apache-2.0
