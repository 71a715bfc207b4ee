"""Store and search selected by the arguments of a command."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse

from ..store.place import Place
from ..store.reading import Search

# More tests than any store has; databases do not accept a larger limit.
_MOST = 10 ** 9
# Name of the argument and attribute of Search -> help text.
FILTERS = {"scenario": "its name: autolock, key_press, zone_map, handle_request, digital_key, sleep_time, "
                        "relay_resistance",
           "car": "model and VIN, as listed",
           "software": "of the Car", "key": "its serial number", "verdict": "pass, inconclusive or fail",
           "campaign": "its name", "place": "where it was measured", "since": "day or moment, UTC: 2026-11-01",
           "until": "day or moment, UTC; a day counts whole"}


def place_of(options: argparse.Namespace) -> Place:
    """Return the selected store."""
    return Place(options.store, options.files, getattr(options, "spool", None))


def search_of(options: argparse.Namespace) -> Search:
    """Return the search of the selected tests."""
    return Search(" ".join(options.words), limit=min(max(0, options.limit), _MOST),
                  **{name: getattr(options, name) for name in FILTERS})
