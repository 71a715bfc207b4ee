"""Plans of the predefined studies."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import pathlib
from typing import Any

from ..plan.plan import Plan, load_plan

_FOLDER = pathlib.Path(__file__).parent


def shipped_plan(name: str, **design: Any) -> Plan:
    """Return the plan of a study. design: replaced fields of its design."""
    plan = load_plan(_FOLDER / f"{name}.yaml")
    return dataclasses.replace(plan, design=dataclasses.replace(plan.design, **design))
