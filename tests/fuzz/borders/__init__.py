"""Where bytes of others come in; each module has `prepare`, see harness.py."""
# SPDX-License-Identifier: Apache-2.0
