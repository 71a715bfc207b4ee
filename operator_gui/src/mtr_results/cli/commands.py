"""Arguments of all commands."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import math
import pathlib

from mtr_operator.domain.limits import DISTANCE

from ..store.database import shown_address
from ..store.place import ADDRESS_VARIABLE, default_address, default_spool
from ..store.reading import PAGE
from ..store.sets import FACTORS
from ..web.access import PORT
from .comparing import compare, show_trend, spread
from .exporting import export, query
from .importing import import_tests, list_waiting, upgrade
from .listing import list_tests, show_test
from .meant import FILTERS
from .reporting import report
from .serving import serve


def parser() -> argparse.ArgumentParser:
    """Return the parser of mtr-results.

    Parsed arguments have a `run` function, which accepts them and returns the exit code.
    """
    made = argparse.ArgumentParser(prog="mtr-results", description="Tests of the Operator's application in a store: "
                                   "imported, searched, compared, reported.")
    commands = made.add_subparsers(dest="command", required=True, metavar="COMMAND")
    _importing(commands)
    _listing(commands)
    _comparing(commands)
    _reporting(commands)
    _serving(commands)
    _exporting(commands)
    return made


def _importing(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    command = commands.add_parser("import", parents=[_of_store()], help="tests into the store; again changes nothing")
    command.add_argument("paths", nargs="*", type=pathlib.Path, metavar="PATH",
                         help="progress file, bundle, folder of a test, or folder with such; none: only what waits")
    command.add_argument("--station", action="append", default=[], metavar="KEY",
                         help="take only bundles that are signed with this key, or another one that is named so; "
                              "without any, each intact bundle is taken")
    command.add_argument("--campaign", default="", help="name under which the tests belong together")
    _add_spool(command)
    command.set_defaults(run=import_tests)
    command = commands.add_parser("spool", help="tests that wait on this computer, and for which store")
    _add_spool(command)
    command.add_argument("--json", action="store_true", help="for a program")
    command.set_defaults(run=list_waiting)
    command = commands.add_parser("upgrade", parents=[_of_store()], help="a store of an older version to this one")
    command.set_defaults(run=upgrade)


def _add_spool(command: argparse.ArgumentParser) -> None:
    command.add_argument("--spool", type=pathlib.Path, default=None,
                         help="folder in which tests wait while the store is away (default "
                              f"{plain_help(default_spool())})")


def _listing(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    command = commands.add_parser("list", parents=[_of_store(), of_search()], help="tests, newest first")
    command.set_defaults(run=list_tests)
    command = commands.add_parser("show", parents=[_of_store()], help="all that is known of one test")
    command.add_argument("test", help="its number, or the beginning of its key")
    command.add_argument("--trials", action="store_true", help="each point of each attempt, too")
    command.set_defaults(run=show_test)


def _comparing(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    of_set = "tests by their numbers, 12,17, or by what they have, campaign=winter,key=0042"
    command = commands.add_parser("compare", parents=[_of_store()], help="two tests, or two sets of tests")
    command.add_argument("first", help=of_set)
    command.add_argument("second", help="likewise")
    command.set_defaults(run=compare)
    of_distance = argparse.ArgumentParser(add_help=False)
    of_distance.add_argument("set", help=of_set)
    of_distance.add_argument("--line", type=int, default=0, help="number of the line in the first test; default all")
    of_distance.add_argument("--word", default="", help="what the distance is called; default all")
    command = commands.add_parser("spread", parents=[_of_store(), of_distance],
                                  help="repeatability, reproducibility, and what each factor adds")
    command.add_argument("--by", default="key,car,place", help=f"of {','.join(FACTORS)}; default %(default)s",
                         type=_factors)
    command.add_argument("--at-least", type=_metres, default=None, metavar="M",
                         help="lower limit of the distance, for Cpk and Ppk")
    command.add_argument("--at-most", type=_metres, default=None, metavar="M", help="upper limit, likewise")
    command.set_defaults(run=spread)
    command = commands.add_parser("trend", parents=[_of_store(), of_distance], help="over time, with control limits")
    command.add_argument("--baseline", type=int, default=0,
                         help="so many of the first tests make the limits; default all")
    command.set_defaults(run=show_trend)


def _metres(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not DISTANCE.allows(value):
        raise argparse.ArgumentTypeError(f"{text} is no distance; allowed is {DISTANCE.low:g} to "
                                         f"{DISTANCE.high:g} m.")
    return value


def _factors(text: str) -> str:
    unknown = [name for name in text.split(",") if name not in FACTORS]
    if unknown:
        raise argparse.ArgumentTypeError(f"{unknown[0]} is no factor; there are {', '.join(FACTORS)}.")
    return text


def _reporting(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    command = commands.add_parser("report", parents=[_of_store()],
                                  help="a test, or two sets beside each other, as one HTML file")
    command.add_argument("first", help="a test; with a second one also a set, as for compare")
    command.add_argument("second", nargs="?", default=None, help="what it is compared with")
    command.add_argument("--out", type=pathlib.Path, default=pathlib.Path("report.html"), help="default %(default)s")
    command.set_defaults(run=report)


def _serving(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    command = commands.add_parser("serve", parents=[_of_store()], help="the store in a browser")
    command.add_argument("--host", default="127.0.0.1",
                         help="where it listens; beyond this computer only with a token over TLS; default %(default)s")
    command.add_argument("--port", type=int, default=PORT, help="0 for any that is free; default %(default)s")
    command.add_argument("--follow", action="append", default=[], type=pathlib.Path, metavar="FOLDER",
                         help="show how tests go on that are measured into this folder; several times for several")
    command.add_argument("--token-file", type=pathlib.Path, default=None, help="file with the token of those who read")
    command.add_argument("--certificate", type=pathlib.Path, default=None, help="of TLS, PEM")
    command.add_argument("--key", type=pathlib.Path, default=None, help="likewise")
    command.add_argument("--behind-proxy", action="store_true", help="a proxy in front does TLS")
    command.set_defaults(run=serve)


def _exporting(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    command = commands.add_parser("export", parents=[_of_store()], help="all tables as Parquet files")
    command.add_argument("folder", type=pathlib.Path, help="made where there is none; its files are replaced")
    command.set_defaults(run=export)
    command = commands.add_parser("query", help="SQL over exported tables, by DuckDB")
    command.add_argument("folder", type=pathlib.Path, help="of mtr-results export")
    command.add_argument("sql", help="such as \"SELECT place, avg(first_m) FROM line JOIN measurement ...\"")
    command.add_argument("--json", action="store_true", help="for a program")
    command.set_defaults(run=query)


def plain_help(text: object) -> str:
    """Escape percent signs in a text for the help of argparse, which formats them as fields."""
    return str(text).replace("%", "%%")


def _of_store() -> argparse.ArgumentParser:
    common = argparse.ArgumentParser(add_help=False)
    common.add_argument("--store", default=default_address(), metavar="PATH|URL",
                        help=f"file of SQLite or postgresql://USER:PASSWORD@HOST/DATABASE; default "
                             f"{plain_help(shown_address(default_address()))}, or the variable {ADDRESS_VARIABLE}")
    common.add_argument("--files", type=pathlib.Path, default=None,
                        help="folder of the contents of files; default beside the file of SQLite, on a server none")
    common.add_argument("--json", action="store_true", help="for a program")
    return common


def of_search() -> argparse.ArgumentParser:
    """Return a parent parser with the search arguments."""
    common = argparse.ArgumentParser(add_help=False)
    common.add_argument("words", nargs="*", metavar="WORD", help="all have to occur in what is known of a test")
    for name, meaning in FILTERS.items():
        common.add_argument(f"--{name}", default="", help=meaning)
    common.add_argument("--limit", type=int, default=PAGE, help="at most so many, 0 for all; default %(default)s")
    return common
