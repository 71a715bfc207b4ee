"""The record with the names of ASAM ODS' base model, so that an import is a plain mapping."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Mapping

from mtr_operator.domain.results.session_record import CAN_ADAPTER

_METRE = {"base": "AoUnit", "name": "m", "factor": 1.0, "offset": 0.0, "dimension": "length"}
# Quantities of a submatrix: one row for each line.
_QUANTITIES = ("distance_m", "uncertainty_m", "low_m", "high_m")


def ods_of(record: Mapping[str, Any], station: str) -> dict[str, Any]:
    """Convert a record (record.schema.json)."""
    identity, session = record.get("identity") or {}, record["session"]
    return {
        "AoTest": {"name": record["scenario"], "date_created": session.get("started", ""), "station": station,
                   "software": record["software"], "parameters": record["parameters"]},
        "AoUnitUnderTest": {"name": identity.get("car_vin", ""), "model": identity.get("car_model", ""),
                            "software": identity.get("car_software", ""), "key_serial": identity.get("key_serial", ""),
                            "key_type": identity.get("key_type", ""), "key_battery_v": identity.get("key_battery_v")},
        "AoTestEquipment": [*identity.get("equipment", []), {"name": "robot", "serial": session.get("robot", "")},
                            *({"name": name, "serial": text} for name, text in session.items()
                              if name.startswith(CAN_ADAPTER))],
        "AoUser": {"name": identity.get("operator", "")},
        "AoMeasurement": {
            "name": f"{record['scenario']} {session.get('started', '')}",
            "measurement_begin": session.get("started", ""),
            "place": identity.get("place", ""), "verdict": record["verdict"],
            "AoSubmatrix": {"name": "lines", "number_of_rows": len(record["lines"])},
            "AoMeasurementQuantity": [*_columns(record["lines"])]},
        "AoUnit": [_METRE]}


def _columns(lines: list[Mapping[str, Any]]) -> list[dict[str, Any]]:
    words = dict.fromkeys(distance["word"] for line in lines for distance in line["distances"])
    places: dict[str, Any] = {"name": "place", "datatype": "DT_STRING", "values": [line["place"] for line in lines]}
    found = [places]
    for word in words:
        rows: list[Mapping[str, Any]] = [
            next((each for each in line["distances"] if each["word"] == word), {}) for line in lines]
        found.append({"name": f"{word}_status", "datatype": "DT_STRING", "values": [row.get("status") for row in rows]})
        found += [{"name": f"{word}_{name}", "datatype": "DT_DOUBLE", "unit": "m",
                   "values": [row.get(name) for row in rows]} for name in _QUANTITIES]
    return found
