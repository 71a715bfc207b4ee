"""For all tests: what cannot be written where it belongs is kept in the test's folder, not in the person's."""
# SPDX-License-Identifier: Apache-2.0
import pytest


@pytest.fixture(autouse=True)
def own_second_place(tmp_path_factory, monkeypatch):
    """The system's folder for data of programs, of this test alone."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path_factory.mktemp("data")))
    # A person's store of results is none of a test's.
    monkeypatch.delenv("MTR_RESULTS_STORE", raising=False)
