"""Pages of the store as files and from the server: contents, rejected requests, and no external resources."""
# SPDX-License-Identifier: Apache-2.0
import html.parser
import http.client
import json
import re
import threading

import measured
import pytest
from followed_tests import following

from mtr_operator.domain.identity.identity import Identity
from mtr_operator.domain.verdict.limits_document import limits_from
from mtr_results.cli import main
from mtr_results.errors import StoreError
from mtr_results.web.access import Access
from mtr_results.web.pages import Pages
from mtr_results.web.server import make_server

EVIL = "<script>alert('x')</script>"
# Elements without an end tag.
VOID = {"meta", "input", "br", "link"}


class Balanced(html.parser.HTMLParser):
    """HTML parser that fails for an element without its end tag."""

    def __init__(self, page):
        super().__init__()
        self.open, self.links = [], []
        self.feed(page)
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.links += [value for name, value in attrs if name in ("href", "src", "action")]
        assert not [name for name, _ in attrs if name.startswith("on")]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


@pytest.fixture
def store(place, tmp_path):
    """Provide three tests: 1 with a script in its identity, 2 its repetition, 3 weaker and with an open line."""
    limits = limits_from({"limits": [{"what": "press", "at_least_m": 6.0}]})
    who = Identity("VIN1", f"Golf {EVIL}", notes=EVIL, key_serial="A")
    door = place.door()
    for number, (distances, identity) in enumerate((((5.0, 5.5, 6.0, 6.5), who), ((5.05, 5.45, 6.0, 6.5), Identity()),
                                                    ((4.0, 4.5, measured.at_least(3, 6.0), 5.5), Identity())), start=1):
        path = measured.in_folder(tmp_path / str(number), *distances, mark=f"m{number}", identity=identity,
                                  limits=limits, started=f"2026-11-2{number}T10:00:00+00:00")
        assert door.take(path, "winter" if number > 1 else "").outcome == "added"
    return place


@pytest.fixture
def serve(store):
    """Return a function that starts a server on this store and returns a request function."""
    ending = []

    def start(**access):
        server, listening = make_server(Pages(store.open(), store.kept_files()), following(store.open()),
                                        Access(port=0, **access))
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]})
        thread.start()
        ending.append((server, thread))
        port = listening.getsockname()[1]

        def ask(path, **headers):
            connection = http.client.HTTPConnection("127.0.0.1", port, timeout=20.0)
            connection.request("GET", path, headers={"Host": f"127.0.0.1:{port}", **headers})
            answer = connection.getresponse()
            return answer.status, answer.read().decode("utf-8", "replace"), answer.headers
        return ask
    yield start
    for server, thread in ending:
        server.should_exit = True
        thread.join(20.0)


def test_list_filters_and_links_to_each_test(serve):
    ask = serve()
    status, page, headers = ask("/")
    assert status == 200 and "3 tests" in page and "default-src 'none'" in headers["Content-Security-Policy"]
    links = Balanced(page).links
    assert {"/tests/1", "/tests/2", "/tests/3"} <= set(links) and not [link for link in links if "//" in link]
    assert EVIL not in page and "&lt;script&gt;" in page
    assert "2 tests" in ask("/?campaign=winter")[1] and "1 test<" in ask("/?text=vin1")[1]
    assert "0 tests" in ask("/?text=%25")[1] and "1 test<" in ask("/?since=2026-11-23&text=key")[1]


def test_page_of_a_test_shows_picture_table_verdicts_and_files(serve):
    ask = serve()
    _, page, _ = ask("/tests/1")
    assert Balanced(page) and "<svg" in page and EVIL not in page
    assert "radial 1 (0\N{DEGREE SIGN})" in page and "verdict: <strong>fail</strong>" in page and "20 points" in page
    assert "at least 6.00" in ask("/tests/3")[1]
    _, table, headers = ask("/tests/1/files/results.csv")
    assert "radial,angle_deg" in table and 'filename="results.csv"' in headers["Content-Disposition"]
    assert json.loads(ask("/tests/2.json")[1])["campaign"] == "winter"
    status, page, _ = ask("/tests/77")
    assert status == 404 and "There is no test 77" in page and Balanced(page)
    assert ask("/tests/1/files/..%2f..%2fstore.sqlite")[0] == 404


def test_comparison_says_what_its_intervals_carry(serve):
    ask = serve()
    status, page, _ = ask("/compare?first=1&second=2")
    assert status == 200 and "No difference is shown" in page and page.count("<svg") == 2 and Balanced(page)
    page = ask("/compare?first=1&second=3")[1]
    assert "Different among all (Holm)" in page and 'class="different"' in page and "at least 5.9" in page
    assert ask("/compare?first=campaign%3Dwinter&second=1")[0] == 200
    status, page, _ = ask("/compare?first=1&second=")
    assert status == 404 and "mtr-results list" in page
    _, page, headers = ask("/report/compare.html?first=1&second=3")
    assert "attachment" in headers["Content-Disposition"] and "<nav>" not in page and Balanced(page).links == []


def test_trend_page_draws_each_distance(serve):
    ask = serve()
    assert Balanced(ask("/trend")[1])
    page = ask("/trend?set=scenario%3Dkey_press&line=1")[1]
    assert "radial 1 (0\N{DEGREE SIGN})" in page and "3 values make no limits" in page and page.count("<svg") == 1


def test_report_is_one_file_that_needs_nothing_else(store, tmp_path, capsys):
    out = tmp_path / "report.html"
    assert main(["report", "1", "--store", store.address, "--out", str(out)]) == 0
    page = out.read_text(encoding="utf-8")
    assert Balanced(page).links == [] and "<svg" in page and not re.findall(r"url\(|@import|<script", page)
    assert main(["report", "1", "2", "--store", store.address, "--out", str(out)]) == 0
    assert "No difference is shown" in out.read_text(encoding="utf-8")
    assert main(["report", "1", "--store", store.address, "--out", str(tmp_path / "no" / "r.html")]) == 2
    assert "make it first" in capsys.readouterr().err


def test_only_this_computer_reads_unless_a_token_and_tls_are_given(serve, tmp_path):
    token = tmp_path / "token"
    token.write_text("short\n")
    files = {"certificate": tmp_path / "c.pem", "key": tmp_path / "k.pem"}
    for access, words in ((Access("0.0.0.0"), "give --token-file"), (Access("lab.example"), "give --token-file"),
                          (Access("::", token_file=token), "16 are the fewest"),
                          (Access(behind_proxy=True), "give --token-file"),
                          (Access(certificate=tmp_path / "c.pem"), "both")):
        with pytest.raises(StoreError, match=words):
            access.token()
    token.write_text("a token that is long enough\n")
    with pytest.raises(StoreError, match="in the clear"):
        Access("0.0.0.0", token_file=token).token()
    assert Access("0.0.0.0", token_file=token, **files).token() == "a token that is long enough"
    assert Access("127.0.0.2").is_local and Access("::1").token() == "" and not Access("192.168.0.5").is_local


def test_token_is_asked_for_once_and_a_stranger_s_name_is_refused(serve, tmp_path):
    token = tmp_path / "token"
    token.write_text("a-token-that-is-long-enough")
    ask = serve(token_file=token)
    assert ask("/")[0] == 401 == ask("/tests/1")[0] == ask("/?token=wrong")[0]
    status, _, headers = ask("/?token=a-token-that-is-long-enough")
    assert status == 303 and headers["Location"] == "/" and "HttpOnly" in headers["Set-Cookie"]
    assert ask("/", Cookie=headers["Set-Cookie"].split(";")[0])[0] == 200
    assert ask("/", Host="evil.example")[0] == 421


def test_taken_port_is_a_sentence(store):
    _, listening = make_server(Pages(store.open(), None), following(store.open()), Access(port=0))
    with listening, pytest.raises(StoreError, match="choose another --port"):
        make_server(Pages(store.open(), None), following(store.open()), Access(port=listening.getsockname()[1]))
