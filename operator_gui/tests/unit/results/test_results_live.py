"""Tests in progress in a browser: contents and timing of the updates."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import re
import threading
import time

import pytest
from followed_tests import Measuring, following
from live_browser import PATIENCE_S, Browser, ask, only_name

from mtr_operator.storage.lock import Lock
from mtr_results.live import followed
from mtr_results.web import live_pages
from mtr_results.web.access import Access
from mtr_results.web.pages import Pages
from mtr_results.web.server import make_server


@pytest.fixture
def serve(place, tmp_path):
    """Return a function that starts a server for the folder and returns its port."""
    ending = []

    def start(**access):
        database = place.open()
        pages = following(database, tmp_path / "tests")
        server, listening = make_server(Pages(database, place.kept_files()), pages, Access(port=0, **access))
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]})
        thread.start()
        ending.append((server, thread))
        return listening.getsockname()[1]
    yield start
    for server, thread in ending:
        server.should_exit = True
        thread.join(PATIENCE_S)
        assert not thread.is_alive()


@pytest.fixture
def test(tmp_path):
    """Provide a test in progress with two points on its first radial."""
    with Measuring(tmp_path / "tests" / "one") as measuring:
        measuring.begin(1, 5.0)
        measuring.press(3.0, True, 10.0)
        measuring.press(5.4, False, 20.0)
        yield measuring


def test_list_names_what_is_measured_and_the_page_runs_the_servers_own_script_alone(serve, test):
    port = serve()
    status, page, headers = ask(port, "/live")
    assert status == 200 and "is being measured" in page and "script" not in headers["Content-Security-Policy"]
    status, page, headers = ask(port, f"/live/{only_name(port)}")
    assert status == 200 and "radial 1: go to the start" in page and "2 points" in page
    assert "script-src 'self'; connect-src 'self'" in headers["Content-Security-Policy"]
    assert re.findall(r"<script[^>]*>", page) == [
        f'<script src="/live.js" data-events="/live/{only_name(port)}/events">']
    status, script, headers = ask(port, "/live.js")
    assert status == 200 and "EventSource" in script and headers["Content-Type"].startswith("text/javascript")
    assert str(test.path.parent) not in page
    assert ask(port, "/live/none")[0] == 404 == ask(port, "/live/none/events")[0]


def test_points_lines_and_the_robots_place_come_as_they_are_measured(serve, test):
    port = serve()
    browser = Browser(port, only_name(port)).see("2 points")
    assert set(browser.events[0]) == {"now", "picture", "distances", "points"}
    test.press(4.9, True, 30.0)
    browser.see("3 points")
    assert "points" in browser.events[-1] and "distances" not in browser.events[-1]
    assert re.findall(r"press ([\d.]+)", browser.parts["points"]) == ["4.9", "5.4", "3"]
    test.end(1, 5.0)
    browser.see("1 of 4 lines").see("radial 1 (0\N{DEGREE SIGN})")
    test.stand_at(-2.5, 1.25, 31.0)
    browser.see("x -2.50 m, y 1.25 m").see("Robot</title>")
    test.begin(2, 65.0)
    # One line took a minute; three remain.
    browser.see("about 3 min")
    browser.close()


def test_two_windows_and_one_that_comes_back_see_the_whole_test(serve, test):
    port = serve()
    first, second = (Browser(port, only_name(port)).see("2 points") for _ in range(2))
    first.close()
    test.press(4.9, True, 30.0)
    second.see("3 points")
    assert second.parts == Browser(port, only_name(port)).see("3 points").parts


def test_end_of_the_test_and_its_page_in_the_store_are_told(serve, tmp_path, place):
    with Measuring(tmp_path / "tests" / "one") as test:
        port = serve()
        test.begin(1, 5.0)
        for line in range(1, 5):
            test.end(line, 5.0)
        browser = Browser(port, only_name(port)).see("is being measured")
    browser.see("is complete")
    assert "/tests/" not in browser.parts["now"]
    assert place.door().take(test.path).outcome == "added"
    browser.see('<a href="/tests/1">test 1 of the store</a>')


def test_application_that_was_killed_is_told_from_one_that_measures(serve, test, monkeypatch):
    monkeypatch.setattr(followed, "SILENT_S", 0.0)
    port = serve()
    Browser(port, only_name(port)).see("nothing was written for")
    assert "silent" in ask(port, "/live")[1]


def test_files_that_vanish_or_are_torn_are_a_sentence_and_the_page_goes_on(serve, test):
    port = serve()
    browser = Browser(port, only_name(port)).see("2 points")
    journal = test.path.with_suffix(".journal")
    content = journal.read_bytes()
    # The end of the last line is not yet written.
    journal.write_bytes(content + content.splitlines(keepends=True)[-1][:20])
    test.stand_at(1.0, 1.0, 2.0)
    browser.see("x 1.00 m")
    assert "2 points" in browser.parts["points"]
    journal.rename(journal.with_suffix(".away"))
    browser.see("problem")
    journal.with_suffix(".away").rename(journal)
    browser.see("is being measured")


def test_the_folder_is_left_as_it_is_and_its_lock_to_the_application(serve, tmp_path, test):
    port = serve()
    folder = tmp_path / "tests"
    before = {path: path.stat().st_mtime_ns for path in sorted(folder.rglob("*"))}
    browser = Browser(port, only_name(port)).see("2 points")
    ask(port, "/live")
    assert {path: path.stat().st_mtime_ns for path in sorted(folder.rglob("*"))} == before
    (folder / "two").mkdir()
    with Lock(folder / "two" / "progress.json"):
        assert "is being measured" in ask(port, "/live")[1]
    browser.close()


def test_who_may_not_read_pages_may_not_follow_tests(serve, test, tmp_path):
    token = tmp_path / "token"
    token.write_text("a-token-that-is-long-enough")
    port = serve(token_file=token)
    assert [ask(port, path)[0] for path in ("/live", "/live/x", "/live/x/events", "/live.js")] == [401] * 4
    cookie = ask(port, "/?token=a-token-that-is-long-enough")[2]["Set-Cookie"].split(";")[0]
    name, = re.findall(r'href="/live/(\w+)"', ask(port, "/live", Cookie=cookie)[1])
    assert ask(port, f"/live/{name}/events", Cookie=cookie, Host="evil.example")[0] == 421
    Browser(port, name, Cookie=cookie).see("2 points")


def test_more_browsers_than_are_served_are_refused_and_one_that_leaves_makes_room(serve, test, monkeypatch):
    monkeypatch.setattr(live_pages, "MAX_STREAMS", 1)
    port = serve()
    name = only_name(port)
    first = Browser(port, name).see("2 points")
    assert ask(port, f"/live/{name}/events")[0] == 503
    first.close()
    until_s = time.monotonic() + PATIENCE_S
    # The server detects a closed window only when it sends something.
    while Browser(port, name).answer.status != 200:
        test.stand_at(1.0, 1.0, 2.0)
        assert time.monotonic() < until_s


def test_what_files_and_folders_say_is_text_on_the_page(serve, tmp_path):
    with Measuring(tmp_path / "tests" / "<img src=x onerror=alert(1)>") as test:
        port = serve()
        test.begin(1, 5.0, "<script>")
        test.press(3.0, True)
        browser = Browser(port, only_name(port)).see("&lt;script&gt;")
        pages = [ask(port, "/live")[1], ask(port, f"/live/{only_name(port)}")[1], *browser.parts.values()]
        browser.close()
    assert "&lt;img src=x" in pages[0]
    assert not [page for page in pages if "<img" in page or "<script>" in page]


def test_without_folders_the_page_says_how_to_follow_some(place):
    assert "--follow FOLDER" in following(place.open()).list()
    assert "no test in the folders" in following(place.open(), pathlib.Path("/nowhere")).list()
