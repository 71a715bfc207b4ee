"""JUnit report of a campaign, for CI."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence
from xml.etree import ElementTree

from .folder import FAILED, Done


def junit_xml(name: str, runs: Sequence[Done]) -> str:
    """Return a test suite with a case for each run; a failed run has its sentence."""
    failed = sum(done.status == FAILED for done in runs)
    suite = ElementTree.Element("testsuite", name=name, tests=str(len(runs)), failures=str(failed), errors="0",
                                time=f"{sum(done.seconds for done in runs):.3f}")
    for done in runs:
        settings = ", ".join(f"{key}={value}" for key, value in sorted(done.run.settings.items()))
        case = ElementTree.SubElement(suite, "testcase", classname=f"{name}.{done.run.scenario}",
                                      name=f"{done.digest} {settings}".rstrip(), time=f"{done.seconds:.3f}")
        if done.status == FAILED:
            ElementTree.SubElement(case, "failure", message=done.reason).text = done.reason
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ElementTree.tostring(suite, encoding="unicode") + "\n"
