"""The record as JUnit XML for continuous integration servers: a line is a test case."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Mapping
from xml.etree import ElementTree

from .outcome import FAIL, NOT_MEASURED, NOTHING, line_outcome, unmeasured_lines

_BAD_VERDICTS = ("fail", "error", "aborted")


def junit_of(record: Mapping[str, Any], station: str) -> bytes:
    """Convert a record (record.schema.json); the verdict, if there is one, is a separate test case.

    A planned line without a result is an error: a skipped case would leave an interrupted test green.
    """
    suite = ElementTree.Element("testsuite", name=record["scenario"], hostname=station,
                                timestamp=str(record["session"].get("started", "")))
    for line in record["lines"]:
        _line(suite, record["scenario"], line)
    for line in unmeasured_lines(record):
        case = ElementTree.SubElement(suite, "testcase", classname=record["scenario"],
                                      name=f"{line['kind']} {line['number']}")
        ElementTree.SubElement(case, "error", message=NOT_MEASURED)
    if record["verdict"] is not None:
        case = ElementTree.SubElement(suite, "testcase", classname=record["scenario"], name="verdict")
        if record["verdict"] in _BAD_VERDICTS:
            ElementTree.SubElement(case, "failure", message=record["verdict"])
        elif record["verdict"] != "pass":
            ElementTree.SubElement(case, "skipped", message=record["verdict"])
    suite.set("tests", str(len(suite.findall("testcase"))))
    suite.set("failures", str(len(suite.findall("testcase/failure"))))
    suite.set("errors", str(len(suite.findall("testcase/error"))))
    suite.set("skipped", str(len(suite.findall("testcase/skipped"))))
    ElementTree.indent(suite)
    return bytes(ElementTree.tostring(suite, encoding="utf-8", xml_declaration=True))


def _line(suite: ElementTree.Element, scenario: str, line: Mapping[str, Any]) -> None:
    case = ElementTree.SubElement(suite, "testcase", classname=scenario,
                                  name=f"{line['kind']} {line['number']} {line['place']}")
    outcome = line_outcome(line)
    if outcome == FAIL:
        ElementTree.SubElement(case, "failure", message=line["reason"] or "invalid")
    elif outcome == NOTHING:
        ElementTree.SubElement(case, "skipped")
    properties = ElementTree.SubElement(case, "properties")
    for distance in line["distances"]:
        for name in ("status", "distance_m", "uncertainty_m", "low_m", "high_m"):
            if distance[name] is not None:
                ElementTree.SubElement(properties, "property", name=f"{distance['word']}_{name}",
                                       value=str(distance[name]))
