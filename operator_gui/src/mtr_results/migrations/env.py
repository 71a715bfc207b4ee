"""Migration environment. Alembic runs it within the transaction of the caller."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from alembic import context

from mtr_results.model.tables import METADATA

context.configure(connection=context.config.attributes["connection"], target_metadata=METADATA)
context.run_migrations()
