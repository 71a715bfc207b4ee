"""The record as the JSON of an OpenHTF test, which TofuPilot also accepts: a line is a phase, a distance a
measurement."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime
from typing import Any, Mapping

from .outcome import FAIL, NOT_MEASURED, PASS, line_outcome, unmeasured_lines

_MS_PER_S = 1000.0
_UNIT = "m"
_OUTCOMES = {"pass": "PASS", "fail": "FAIL", "error": "ERROR", "aborted": "ABORTED"}
_PHASES = {PASS: "PASS", FAIL: "FAIL"}


def openhtf_of(record: Mapping[str, Any], station: str) -> dict[str, Any]:
    """Convert a record (record.schema.json). The outcome is the verdict; without limits the outcome of the measurement,
    which passes if each planned line is measured."""
    identity, session = record.get("identity") or {}, record["session"]
    begun_ms = _milliseconds(session.get("started"))
    phases = [_phase(line, begun_ms) for line in record["lines"]]
    phases += [_left_out(line, begun_ms) for line in unmeasured_lines(record)]
    measured = "PASS" if phases and all(phase["outcome"] == "PASS" for phase in phases) else "ERROR"
    return {
        "dut_id": identity.get("car_vin") or identity.get("key_serial") or "unknown", "station_id": station,
        "start_time_millis": begun_ms, "end_time_millis": begun_ms,
        "outcome": measured if record["verdict"] is None else _OUTCOMES.get(record["verdict"], "ERROR"),
        "outcome_details": [] if record["verdict"] is None else [{"code": record["verdict"], "description": "verdict"}],
        "metadata": {"test_name": record["scenario"], "session": session, "identity": identity,
                     "parameters": record["parameters"], "software": record["software"]},
        "phases": phases}


def _phase(line: Mapping[str, Any], begun_ms: int) -> dict[str, Any]:
    measurements = {}
    for distance in line["distances"]:
        is_ok = distance["status"] == "ok"
        measurements[f"{distance['word']}_distance_m"] = {
            "name": f"{distance['word']}_distance_m", "units": _UNIT, "measured_value": distance["distance_m"],
            "outcome": "PASS" if is_ok else "UNSET", "validators": [],
            "docstring": f"{distance['status']}; 95 %: {distance['low_m']} to {distance['high_m']} m; 1 sigma: "
                         f"{distance['uncertainty_m']} m"}
    return {"name": f"{line['kind']} {line['number']} {line['place']}", "start_time_millis": begun_ms,
            "end_time_millis": begun_ms, "outcome": _PHASES.get(line_outcome(line), "SKIP"),
            "measurements": measurements, "attachments": {},
            "result": {"phase_result": line["reason"] or "CONTINUE"}}


def _left_out(line: Mapping[str, Any], begun_ms: int) -> dict[str, Any]:
    """Return the phase of a planned line without a result."""
    return {"name": f"{line['kind']} {line['number']}", "start_time_millis": begun_ms, "end_time_millis": begun_ms,
            "outcome": "SKIP", "measurements": {}, "attachments": {}, "result": {"phase_result": NOT_MEASURED}}


def _milliseconds(started: Any) -> int:
    """Return milliseconds of the epoch; 0 for a record without a time."""
    try:
        return round(_MS_PER_S * datetime.datetime.fromisoformat(str(started)).timestamp())
    except ValueError:
        return 0
