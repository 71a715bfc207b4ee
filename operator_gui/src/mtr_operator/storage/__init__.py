"""Files of the application: parameters in, progress in and out; each written whole or not at all."""
# SPDX-License-Identifier: Apache-2.0
