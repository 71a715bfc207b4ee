"""Passwords are never shown, and numbers in addresses may be arbitrarily large."""
# SPDX-License-Identifier: Apache-2.0
import logging

import pytest
from asgi import asked

from mtr_campaign.cli import main as campaign_main
from mtr_results.cli import main
from mtr_results.errors import StoreError
from mtr_results.live.followed import Followed
from mtr_results.live.watch import Watch
from mtr_results.store.database import engine_of, shown_address
from mtr_results.web.application import application
from mtr_results.web.live_pages import LivePages
from mtr_results.web.pages import Pages

ADDRESSES = ["postgresql://me:s3cret@lab/db", "postgresql://me@lab/db?password=s3cret", "mysql://me:s3cret@lab/db",
             "postgresql://me:s3cret@lab:port/db", "postgresql://me:%s3cret%@lab/db", "nonsense://me:s3cret@lab/db"]
COMMANDS = ["import", "upgrade", "list", "show", "compare", "spread", "trend", "report", "serve", "export"]


@pytest.mark.parametrize("address", ADDRESSES)
def test_address_is_shown_without_its_password(address):
    assert "s3cret" not in shown_address(address) and "lab" in shown_address(address)
    try:
        engine_of(address)
    except StoreError as error:
        assert "s3cret" not in str(error)


@pytest.mark.parametrize("address", ADDRESSES)
def test_help_and_errors_show_no_password(address, monkeypatch, capsys, caplog):
    monkeypatch.setenv("MTR_RESULTS_STORE", address)
    caplog.set_level(logging.DEBUG)
    for command in COMMANDS:
        with pytest.raises(SystemExit) as left:
            main([command, "--help"])
        assert left.value.code == 0
    with pytest.raises(SystemExit):
        campaign_main(["run", "--help"])
    main(["list", "--store", address.replace("lab", "127.0.0.1:1")])
    said = capsys.readouterr()
    assert "s3cret" not in said.out + said.err + caplog.text


def test_help_works_in_a_folder_with_a_percent_sign(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "100%d"))
    for command in COMMANDS:
        with pytest.raises(SystemExit) as left:
            main([command, "--help"])
        assert left.value.code == 0
    assert "100%d" in capsys.readouterr().out


@pytest.fixture
def app(place):
    """Provide the application of an empty store."""
    database = place.open()
    yield application(Pages(database, place.kept_files()), LivePages(Watch(Followed([]), database)))
    database.close()


@pytest.mark.parametrize("number", ["0", "7", 9 * "9", 10 * "9", 20 * "9", 5000 * "9", "-1", "1e9", "\u0661", "1.0",
                                    "%00"])
@pytest.mark.parametrize("route", ["/tests/{}", "/tests/{}.json", "/report/{}.html", "/tests/{}/files/x",
                                   "/?from={}", "/trend?line={}&baseline={}", "/compare?first={}&second={}",
                                   "/trend?set={}", "/?since={}", "/?until={}",
                                   "/report/compare.html?first={}&second={}"])
def test_number_of_any_length_is_answered_with_a_page(app, route, number):
    status, content = asked(app, route.replace("{}", number))
    assert status in (200, 404) and b"Traceback" not in content


def test_limit_of_any_size_is_taken(place):
    place.open().close()
    assert main(["list", "--limit", 30 * "9", "--store", place.address]) == 0
