"""Command that serves the store to a browser."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import dataclasses

from mtr_operator.cli.exit_codes import EXIT_PASS

from .meant import place_of
from .output import print_json


def serve(options: argparse.Namespace) -> int:
    """Serve until Ctrl-C."""
    from ..live.followed import Followed
    from ..live.watch import Watch
    from ..web.access import Access
    from ..web.live_pages import LivePages
    from ..web.pages import Pages
    from ..web.server import make_server
    place = place_of(options)
    access = Access(options.host, options.port, options.token_file, options.certificate, options.key,
                    options.behind_proxy)
    database = place.open()
    live = LivePages(Watch(Followed(options.follow), database))
    server, listening = make_server(Pages(database, place.kept_files()), live, access)
    # With port 0, the operating system chooses the port.
    address = dataclasses.replace(access, port=listening.getsockname()[1]).address
    if options.json:
        print_json({"address": address})
    else:
        print(f"The store is at {address} (Ctrl-C ends)", flush=True)
    server.run(sockets=[listening])
    return EXIT_PASS
