"""Web server with graceful shutdown."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import socket

import uvicorn

from ..errors import StoreError
from .access import Access
from .application import application
from .live_pages import LivePages
from .pages import Pages

# Browsers that follow a test keep their connections open; the shutdown does not wait longer for them, in s.
_FAREWELL_S = 1


def make_server(pages: Pages, live: LivePages, access: Access) -> tuple[uvicorn.Server, socket.socket]:
    """Return a server and its listening socket; StoreError if the port is in use or TLS cannot be configured."""
    app = application(pages, live, access.token(), access.hosts)
    config = uvicorn.Config(app, log_level="warning", lifespan="off", server_header=False,
                            timeout_graceful_shutdown=_FAREWELL_S,
                            ssl_certfile=access.certificate, ssl_keyfile=access.key)
    try:
        family = socket.AF_INET6 if ":" in access.host else socket.AF_INET
        listening = socket.create_server((access.host, access.port), family=family)
        config.load()
    except (OSError, OverflowError) as error:
        raise StoreError(f"Nothing can be served on {access.address}: {getattr(error, 'strerror', '') or error}; "
                         "choose another --port, or look at --host, --certificate and --key.") from None
    return uvicorn.Server(config), listening
