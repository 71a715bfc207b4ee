"""The store's pages in a real browser: filter, compare, download, keyboard, narrow screen (`make browser-test`).

The name keeps it out of `make test`, which needs no browser.
"""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import os
import pathlib
import re
import threading

import measured
import pytest
from followed_tests import Measuring, following
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support import expected_conditions
from selenium.webdriver.support.ui import Select, WebDriverWait

from mtr_results.store.place import Place
from mtr_results.web.access import Access
from mtr_results.web.pages import Pages
from mtr_results.web.server import make_server

PATIENCE_S = 20.0
# A small telephone, held upright.
NARROW_PX, WIDE_PX, HIGH_PX = 360, 1280, 900
# Folder for pictures of what the tests have seen.
SHOTS = "MTR_BROWSER_SHOTS"
# So few px high a letter cannot be read any more.
LEAST_LETTER_PX = 7.0


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Of the store; tests that are being measured lie in the folder running within it."""
    return tmp_path_factory.mktemp("store")


@pytest.fixture(scope="module")
def address(folder):
    """Of a served store: test 1, 2 its repetition and 3 with a weaker antenna, both of the campaign winter."""
    place = Place(str(folder / "store.sqlite"), spool=folder / "spool")
    door = place.door()
    for number, distances in enumerate(((5.0, 5.5, 6.0, 6.5), (5.05, 5.45, 6.0, 6.5), (4.0, 4.5, 5.0, 5.5)), start=1):
        path = measured.in_folder(folder / str(number), *distances, mark=f"m{number}",
                                  started=f"2026-11-2{number}T10:00:00+00:00")
        door.take(path, "winter" if number > 1 else "")
    with served(place, folder) as port:
        yield f"http://127.0.0.1:{port}"


@contextlib.contextmanager
def served(place, folder, port=0):
    """Context with a server; its port."""
    server, listening = make_server(Pages(place.open(), place.kept_files()),
                                    following(place.open(), folder / "running"), Access(port=port))
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]})
    thread.start()
    try:
        yield listening.getsockname()[1]
    finally:
        server.should_exit = True
        thread.join(PATIENCE_S)


@pytest.fixture(scope="module")
def downloads(tmp_path_factory):
    """Where the browser puts what it is given."""
    return tmp_path_factory.mktemp("downloads")


@pytest.fixture(scope="module")
def chromium(downloads):
    """Without a window."""
    options = webdriver.ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    # As root, in containers, Chromium has no sandbox of its own; it sees pages of this test alone.
    for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu"):
        options.add_argument(argument)
    options.add_experimental_option("prefs", {"download.default_directory": str(downloads)})
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    yield driver
    driver.quit()


@pytest.fixture
def browser(chromium, address):
    """On the list, as wide as on a desk; at the end nothing was refused or missing."""
    chromium.set_window_size(WIDE_PX, HIGH_PX)
    chromium.get(address)
    yield chromium
    assert [entry for entry in chromium.get_log("browser") if "favicon" not in entry["message"]] == []


def waits(browser, condition):
    return WebDriverWait(browser, PATIENCE_S).until(condition)


def text_of(browser, selector):
    return browser.find_element(By.CSS_SELECTOR, selector).text


def numbers(browser):
    return [link.text for link in browser.find_elements(By.CSS_SELECTOR, "tbody a")]


def test_filters_find_and_clear(browser):
    assert numbers(browser) == ["3", "2", "1"]
    Select(browser.find_element(By.NAME, "campaign")).select_by_visible_text("winter")
    browser.find_element(By.CSS_SELECTOR, "form.filters button").click()
    waits(browser, expected_conditions.url_contains("campaign=winter"))
    assert numbers(browser) == ["3", "2"] and text_of(browser, "[role=status]") == "2 tests"
    assert Select(browser.find_element(By.NAME, "campaign")).first_selected_option.text == "winter"
    browser.find_element(By.LINK_TEXT, "clear").click()
    waits(browser, lambda driver: len(numbers(driver)) == 3)


def test_two_chosen_tests_are_compared(browser):
    browser.find_element(By.CSS_SELECTOR, "[aria-label='test 1 first']").click()
    browser.find_element(By.CSS_SELECTOR, "[aria-label='test 3 second']").click()
    browser.find_element(By.XPATH, "//button[text()='Compare the chosen']").click()
    waits(browser, expected_conditions.url_contains("/compare"))
    assert "Different among all" in text_of(browser, ".summary")
    assert len(browser.find_elements(By.CSS_SELECTOR, "figure svg")) == 2
    different = browser.find_elements(By.CSS_SELECTOR, "tr.different")
    assert different and all("nearer *" in row.text for row in different)


def test_comparison_asks_for_both_sides(browser):
    browser.find_element(By.XPATH, "//button[text()='Compare the chosen']").click()
    first = browser.find_element(By.NAME, "first")
    assert "/compare" not in browser.current_url and not browser.execute_script(
        "return arguments[0].checkValidity()", first)


@pytest.mark.parametrize(("address_part", "link", "file"), [
    ("/tests/1", "results.csv", (".csv", "#")), ("/tests/1", "Report as a file", (".html", "<")),
    ("/compare?first=1&second=3", "Report as a file", (".html", "<"))])
def test_files_and_reports_are_downloaded(browser, downloads, address_part, link, file):
    browser.get(browser.current_url.rstrip("/") + address_part)
    for old in downloads.iterdir():
        old.unlink()
    browser.find_element(By.LINK_TEXT, link).click()
    waits(browser, lambda _: [path for path in downloads.iterdir() if path.suffix in (".csv", ".html")])
    path, = downloads.iterdir()
    assert (path.suffix, path.read_text(encoding="utf-8").lstrip()[:1]) == file


def test_keyboard_alone_leads_to_a_test_and_shows_where_it_is(browser):
    for _ in range(60):
        browser.switch_to.active_element.send_keys(Keys.TAB)
        focused = browser.switch_to.active_element
        width_px = focused.value_of_css_property("outline-width")
        assert width_px == "3px", f"{focused.tag_name} {focused.text} shows no focus"
        if focused.tag_name == "a" and focused.text == "3":
            break
    focused.send_keys(Keys.ENTER)
    waits(browser, expected_conditions.url_contains("/tests/3"))
    browser.find_element(By.TAG_NAME, "summary").send_keys(Keys.ENTER)
    assert browser.find_element(By.CSS_SELECTOR, "details table").is_displayed()


@pytest.mark.parametrize("address_part", ["/", "/tests/1", "/compare?first=1&second=3",
                                          "/trend?set=scenario%3Dkey_press"])
def test_narrow_screen_scrolls_tables_only_and_letters_can_be_read(browser, address, address_part):
    browser.set_window_size(NARROW_PX, HIGH_PX)
    browser.get(address + address_part)
    assert browser.execute_script("return document.documentElement.scrollWidth <= window.innerWidth")
    small = browser.execute_script(
        "return [...document.querySelectorAll('svg text')].filter(each => each.getBoundingClientRect().height < "
        "arguments[0]).map(each => each.textContent)", LEAST_LETTER_PX)
    assert small == []
    beyond = browser.execute_script(
        "return [...document.querySelectorAll('svg')].flatMap(svg => {const frame = svg.getBoundingClientRect(); "
        "return [...svg.querySelectorAll('text')].filter(each => {const box = each.getBoundingClientRect(); "
        "return box.left < frame.left - 1 || box.right > frame.right + 1;}).map(each => each.textContent)})")
    assert beyond == []


@pytest.fixture
def running(folder):
    """A test that is being measured: one radial is done, and the next one begun."""
    name = f"golf {1 + len(list(folder.glob('running/*')))}"
    with Measuring(folder / "running" / name) as test:
        test.begin(1, 5.0)
        for place_m, worked in ((3.0, True), (5.4, False), (4.9, True)):
            test.press(place_m, worked, 10.0 + place_m)
        test.end(1, 5.0)
        test.begin(2, 65.0)
        test.stand_at(0.5, 4.0, 70.0)
        yield test


def shot(browser, name):
    """A picture for a person, where one is wanted."""
    wanted = os.environ.get(SHOTS)
    if wanted:
        browser.save_screenshot(str(pathlib.Path(wanted, f"{name}.png")))


def test_running_test_is_followed_in_two_windows_without_a_reload(browser, running):
    browser.find_element(By.LINK_TEXT, "Live").click()
    waits(browser, expected_conditions.url_contains("/live"))
    browser.find_element(By.PARTIAL_LINK_TEXT, running.path.parent.name).click()
    waits(browser, lambda driver: "radial 2: go to the start" in text_of(driver, "#now"))
    assert "1 of 4 lines" in text_of(browser, "#now") and "about 3 min" in text_of(browser, "#now")
    first = browser.current_window_handle
    page = browser.current_url
    browser.switch_to.new_window("window")
    second = browser.current_window_handle
    browser.get(page)
    running.press(6.5, False, 75.0)
    running.stand_at(0.5, 6.5, 76.0)
    for window in (first, second):
        browser.switch_to.window(window)
        waits(browser, lambda driver: "4 points" in text_of(driver, "#points"))
        waits(browser, lambda driver: "y 6.50 m" in text_of(driver, "#now"))
        assert len(browser.find_elements(By.CSS_SELECTOR, "#picture svg .robot")) == 1
    shot(browser, "live_wide")
    browser.close()
    browser.switch_to.window(first)
    shot(browser, "live_first")


def test_live_page_says_when_the_server_is_not_heard_and_then_shows_all(browser, folder, running):
    place = Place(str(folder / "store.sqlite"), spool=folder / "spool")
    with served(place, folder) as port:
        browser.get(f"http://127.0.0.1:{port}/live")
        browser.find_element(By.PARTIAL_LINK_TEXT, running.path.parent.name).click()
        waits(browser, lambda driver: "3 points" in text_of(driver, "#points"))
    waits(browser, lambda driver: "not heard" in text_of(driver, "#link"))
    running.press(6.5, False, 75.0)
    with served(place, folder, port):
        waits(browser, lambda driver: "4 points" in text_of(driver, "#points") and not text_of(driver, "#link"))
    # The browser has logged that there was no server.
    browser.get_log("browser")


def test_narrow_live_page_scrolls_tables_only(browser, address, running):
    browser.set_window_size(NARROW_PX, HIGH_PX)
    browser.get(address + "/live")
    browser.find_element(By.PARTIAL_LINK_TEXT, running.path.parent.name).click()
    waits(browser, lambda driver: "3 points" in text_of(driver, "#points"))
    shot(browser, "live_narrow")
    assert browser.execute_script("return document.documentElement.scrollWidth <= window.innerWidth")


def test_printed_page_has_no_controls(browser, address):
    browser.get(address + "/tests/1")
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    try:
        shown = [form for form in browser.find_elements(By.CSS_SELECTOR, "form, nav") if form.is_displayed()]
        assert shown == [] and re.search("radial 1", text_of(browser, "main"))
    finally:
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
