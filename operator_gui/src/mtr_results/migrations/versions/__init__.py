"""One file per change of the tables; an older store is migrated by all later versions in order."""
# SPDX-License-Identifier: Apache-2.0
