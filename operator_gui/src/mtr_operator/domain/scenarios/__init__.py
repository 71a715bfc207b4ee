"""The scenarios that the application knows; a new one is a module with a SCENARIO, listed here."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ..scenario import AnyScenario
from . import autolock, digital_key, handle_request, key_press, relay_resistance, sleep_time, zone_map

_MODULES = (autolock, key_press, zone_map, handle_request, digital_key, sleep_time, relay_resistance)
SCENARIOS: dict[str, AnyScenario] = {module.SCENARIO.name: module.SCENARIO for module in _MODULES}
