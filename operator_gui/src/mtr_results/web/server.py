"""The server itself, until it is ended."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import socket

import uvicorn

from ..errors import StoreError
from .access import Access
from .application import application
from .pages import Pages


def make_server(pages: Pages, access: Access) -> tuple[uvicorn.Server, socket.socket]:
    """A server and its socket, which already listens; StoreError when the port is taken or TLS cannot be done."""
    app = application(pages, access.token(), access.hosts)
    config = uvicorn.Config(app, log_level="warning", lifespan="off", server_header=False,
                            ssl_certfile=access.certificate, ssl_keyfile=access.key)
    try:
        family = socket.AF_INET6 if ":" in access.host else socket.AF_INET
        listening = socket.create_server((access.host, access.port), family=family)
        config.load()
    except (OSError, OverflowError) as error:
        raise StoreError(f"Nothing can be served on {access.address}: {getattr(error, 'strerror', '') or error}; "
                         "choose another --port, or look at --host, --certificate and --key.") from None
    return uvicorn.Server(config), listening
