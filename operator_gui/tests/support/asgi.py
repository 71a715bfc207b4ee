"""What a server's application answers, without a server."""
# SPDX-License-Identifier: Apache-2.0
import asyncio


def asked(app, address):
    """Status and content that a server's application answers with, without a server."""
    path, _, query = address.partition("?")
    answered, content = [], []

    async def receive():
        return {"type": "http.request", "body": b"", "more_body": False}

    async def send(message):
        answered.append(message.get("status"))
        content.append(message.get("body", b""))
    scope = {"type": "http", "http_version": "1.1", "method": "GET", "scheme": "http", "path": path,
             "raw_path": path.encode(), "query_string": query.encode(), "root_path": "",
             "headers": [(b"host", b"localhost")], "client": None, "server": None}
    asyncio.run(app(scope, receive, send))
    return answered[0], b"".join(content)
