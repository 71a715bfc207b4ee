"""One file for each change of the tables; a store of an older version is brought up to date by all that follow."""
# SPDX-License-Identifier: Apache-2.0
