"""The protocol's evidence bundle: what it holds, what it says of itself, and what is said without one."""
# SPDX-License-Identifier: Apache-2.0
import sys

import pytest

from mtr_operator.evidence.verification import verify_bundle


@pytest.fixture
def station(tmp_path, monkeypatch):
    """A station of this test's own."""
    monkeypatch.setattr("platformdirs.user_data_path", lambda *_, **__: tmp_path / "data")


def bundle_of(protocol, operator):
    """Path of the bundle that the window has written."""
    operator.wait(protocol.bundle.isEnabled)
    operator.click(protocol.bundle)
    operator.wait(lambda: "mtr.zip" in protocol.notice.text())
    path, = operator.application.flow.store.settings.result_folder.glob("*/*.mtr.zip")
    return path


@pytest.mark.usefixtures("station")
def test_bundle_has_report_and_findings_and_is_verified_in_the_history(protocol, operator):
    path = bundle_of(protocol, operator)
    found = verify_bundle(path)
    assert found.is_intact
    record = next(name for name in found.manifest.files if name.startswith("autolock_") and name.endswith(".json"))
    assert path.name == record.replace(".json", ".mtr.zip")
    assert {"results.csv", "budget.json", "protocol.png", "protocol.pdf", "record.json",
            "parameters.json"} <= set(found.manifest.files)
    said = protocol.notice.text().replace("\N{ZERO WIDTH SPACE}", "")
    assert path.name in said and str(path.parent) in said
    assert f"It is bundle 1 of {found.manifest.station}." in said
    history = operator.window.history
    history.verify_bundle(path)
    operator.wait(lambda: "is intact: " in history.notice.text())
    assert history.verify.isEnabled() and "bundle 1 of" in history.notice.text()
    content = path.read_bytes()
    path.write_bytes(content[:900] + bytes([content[900] ^ 1]) + content[901:])
    history.verify_bundle(path)
    operator.wait(lambda: "is not as it was signed: " in history.notice.text())


@pytest.mark.usefixtures("station")
def test_what_a_bundle_leaves_out_is_said(protocol, operator, monkeypatch):
    monkeypatch.setitem(sys.modules, "duckdb", None)
    bundle_of(protocol, operator)
    assert "Left out is results.parquet: The package duckdb is not installed; pip install duckdb" in \
        protocol.notice.text()


@pytest.mark.usefixtures("station")
def test_bundle_that_cannot_be_signed_is_a_sentence_and_the_report_is_kept(protocol, operator, tmp_path):
    (tmp_path / "data" / "evidence").mkdir(parents=True)
    (tmp_path / "data" / "evidence" / "signing.key").write_text("damaged")
    operator.wait(protocol.bundle.isEnabled)
    operator.click(protocol.bundle)
    operator.wait(lambda: "is damaged; restore it from a copy" in protocol.notice.text())
    folder = operator.application.flow.store.settings.result_folder
    assert not list(folder.glob("*/*.mtr.zip")) and list(folder.glob("*/results.csv"))
