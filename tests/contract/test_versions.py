"""One version for the whole project, with its entry in the changelog."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import re
from xml.etree import ElementTree

import pytest

import mtr_operator

TOP = pathlib.Path(__file__).resolve().parents[2]
PACKAGES = sorted([*TOP.glob("*/package.xml"), *TOP.glob("catkin_ws/src/*/package.xml")])


@pytest.mark.parametrize("path", PACKAGES, ids=lambda path: path.parent.name)
def test_every_package_has_the_version_of_the_application(path):
    assert ElementTree.parse(path).findtext("version") == mtr_operator.__version__


def test_the_changelog_begins_with_this_version():
    text = (TOP / "CHANGELOG.md").read_text(encoding="utf-8")
    assert re.findall(r"^## ([\d.]+)", text, re.MULTILINE)[0] == mtr_operator.__version__


def test_every_package_is_under_the_licence_of_the_project():
    assert "Apache License" in (TOP / "LICENSE").read_text(encoding="utf-8")
    assert {ElementTree.parse(path).findtext("license") for path in PACKAGES} == {"Apache-2.0"}
