"""Drive round the Car, and the mapping order to localization."""
# SPDX-License-Identifier: Apache-2.0
