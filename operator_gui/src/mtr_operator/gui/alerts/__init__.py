"""What the Operator hears."""
# SPDX-License-Identifier: Apache-2.0
