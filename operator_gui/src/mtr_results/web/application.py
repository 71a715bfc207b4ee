"""HTTP routes of the pages, error pages, and authorization."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import hmac
import mimetypes
from typing import Callable, Mapping

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.convertors import IntegerConvertor, register_url_convertor
from starlette.requests import Request
from starlette.responses import HTMLResponse, JSONResponse, RedirectResponse, Response, StreamingResponse
from starlette.routing import Route

from mtr_operator.domain.errors import OperatorError

from ..errors import StoreAway
from ..report.pages import render
from .live_pages import LivePages
from .pages import Pages

COOKIE = "mtr_results"
# Pages contain their pictures and style and load nothing; a file of a test is never displayed as a page.
HEADERS = {"Content-Security-Policy": "default-src 'none'; style-src 'unsafe-inline'; form-action 'self'; "
                                      "base-uri 'none'; frame-ancestors 'none'",
           "X-Content-Type-Options": "nosniff", "Referrer-Policy": "same-origin", "Cache-Control": "no-store"}
# A page that follows a test runs the script of this server, which connects to this server only.
LIVE_HEADERS = {**HEADERS, "Content-Security-Policy": HEADERS["Content-Security-Policy"].replace(
    "default-src 'none';", "default-src 'none'; script-src 'self'; connect-src 'self';")}
Answer = Callable[[Request], Response]


class TestNumber(IntegerConvertor):
    """A number within the range of every database; a longer one is not a valid address."""

    # Without this, pytest would collect the class because of its name.
    __test__ = False
    regex = "[0-9]{1,9}"


register_url_convertor("test", TestNumber())


def application(pages: Pages, live: LivePages, token: str = "", hosts: frozenset[str] = frozenset()) -> Starlette:
    """Return the web application.

    token: required from readers, empty for none. hosts: accepted host names of requests, empty for any; they prevent
    DNS rebinding, that is, a foreign page that resolves its own name to this computer.
    """

    def route(path: str, answer: Answer, headers: Mapping[str, str] = HEADERS) -> Route:
        async def endpoint(request: Request) -> Response:
            refused = _refusal(request, token, hosts)
            response = refused or await run_in_threadpool(_answered, answer, request)
            response.headers.update(headers)
            return response
        return Route(path, endpoint, methods=["GET"])

    return Starlette(routes=[
        route("/", lambda request: HTMLResponse(pages.tests(request.query_params))),
        route("/compare", lambda request: HTMLResponse(pages.comparison(request.query_params))),
        route("/trend", lambda request: HTMLResponse(pages.trend(request.query_params))),
        route("/live", lambda request: HTMLResponse(live.list())),
        route("/live.js", lambda request: Response(live.script(), media_type="text/javascript")),
        route("/live/{name}", lambda request: HTMLResponse(live.page(request.path_params["name"])), LIVE_HEADERS),
        route("/live/{name}/events", lambda request: _events(live, request.path_params["name"])),
        route("/report/compare.html", lambda request: _download(
            pages.comparison(request.query_params, served=False).encode(), "comparison.html")),
        route("/report/{number:test}.html", lambda request: _download(
            pages.test(request.path_params["number"], served=False).encode(),
            f"test_{request.path_params['number']}.html")),
        route("/tests/{number:test}", lambda request: HTMLResponse(pages.test(request.path_params["number"]))),
        route("/tests/{number:test}.json", lambda request: JSONResponse(
            pages.test_document(request.path_params["number"]))),
        route("/tests/{number:test}/files/{name:path}", lambda request: _download(
            pages.file(request.path_params["number"], request.path_params["name"]), request.path_params["name"]))])


def _events(live: LivePages, name: str) -> Response:
    test = live.test(name)
    if live.is_full:
        return HTMLResponse(render("problem.html", "Not possible", True,
                                   sentence="So many browsers follow tests that no more are served."), 503)
    return StreamingResponse(live.events(test.name), media_type="text/event-stream",
                             headers={"X-Accel-Buffering": "no"})


def _answered(answer: Answer, request: Request) -> Response:
    try:
        return answer(request)
    except OperatorError as error:
        status = 503 if isinstance(error, StoreAway) else 404
        return HTMLResponse(render("problem.html", "Not possible", True, sentence=str(error)), status)


def _refusal(request: Request, token: str, hosts: frozenset[str]) -> Response | None:
    host = request.headers.get("host", "").rpartition(":")[0] or request.headers.get("host", "")
    if hosts and host not in hosts:
        return HTMLResponse(render("problem.html", "Refused", sentence=f"This server is not {host}."), 421)
    if not token or _is_same(request.cookies.get(COOKIE, ""), token):
        return None
    if _is_same(request.query_params.get("token", ""), token):
        # Redirect, so that the token does not remain in an address that may be shared.
        response = RedirectResponse(request.url.path, 303)
        response.set_cookie(COOKIE, token, httponly=True, samesite="strict", secure=request.url.scheme == "https")
        return response
    sentence = "Open this page once with ?token= and the token of this server behind its address."
    return HTMLResponse(render("problem.html", "Who are you?", sentence=sentence), 401)


def _is_same(given: str, token: str) -> bool:
    return hmac.compare_digest(given.encode(), token.encode())


def _download(content: bytes, name: str) -> Response:
    kind = mimetypes.guess_type(name)[0] or "application/octet-stream"
    plain = name.rpartition("/")[2].encode("ascii", "replace").decode().replace('"', "_").replace("?", "_")
    return Response(content, media_type=kind, headers={"Content-Disposition": f'attachment; filename="{plain}"'})
