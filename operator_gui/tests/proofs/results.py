"""A store of many tests on SQLite and PostgreSQL: import rate, size, memory, times of pages; none lost or twice.

Usage: results.py [--tests N] [--lines N] [--seed N] [--short] [--out FOLDER]
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import random
import resource
import statistics
import sys
import tempfile
import time

import measured
import postgresql
import table
from sqlalchemy import func, select, text

from mtr_operator.domain.identity.identity import Identity
from mtr_operator.history.statistics.comparison import compare_sets
from mtr_results.intake.record import read_record
from mtr_results.model.tests import Measurement, Test
from mtr_results.store import reading
from mtr_results.store.database import Database, engine_of
from mtr_results.store.writing import add
from mtr_results.web.pages import Pages

# Issue 20's table: ms, and MiB for what must be flat.
LIST_MS, COMPARE_MS, PAGE_MS, GROWTH_MIB = 50.0, 100.0, 200.0, 32.0
PRESSES = 14
REPEATED = 11
MS_PER_S = 1000.0
MIB = 1024.0 ** 2


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tests", type=int, default=10_000, help="default %(default)s")
    parser.add_argument("--lines", type=int, default=40, help="default %(default)s")
    parser.add_argument("--seed", type=int, default=1, help="default %(default)s")
    parser.add_argument("--short", action="store_true", help="no time must be met")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/bench"), help="default %(default)s")
    options = parser.parse_args()
    counts, rows = {}, []
    with tempfile.TemporaryDirectory() as folder:
        store = pathlib.Path(folder) / "store.sqlite"
        use("SQLite", Database(engine_of(str(store))), options, counts, rows)
        with postgresql.server() as url:
            use("PostgreSQL", Database(engine_of(url.format("postgres"))), options, counts, rows)
    figures = {"tests": options.tests, "lines": options.lines, "presses_a_line": PRESSES}
    return table.finish(options.out / "results.json", figures, counts, rows)


def use(name, database, options, counts, rows):
    """Fill a store, and read from it as a person does."""
    database.make_ready()
    took_s, growth_mib = fill(database, options)
    with database.reading() as connection:
        there = connection.execute(select(func.count(Test.id))).scalar_one()
        distances = connection.execute(select(func.count()).select_from(Measurement)).scalar_one()
        size = size_of(database, connection)
    counts[f"{name}: tests lost or twice"] = abs(there - options.tests)
    counts[f"{name}: distances lost or twice"] = abs(distances - options.tests * options.lines)
    pages = Pages(database, None)
    limits = (None,) * 4 if options.short else (LIST_MS, COMPARE_MS, PAGE_MS, GROWTH_MIB)
    rows += [(f"{name}: import", "tests/s", round(options.tests / took_s, 1), None),
             (f"{name}: size of a test", "KiB", round(size / options.tests / 1024.0, 1), None),
             (f"{name}: list with a filter", "ms", median_ms(lambda: listed(database)), limits[0]),
             (f"{name}: comparison of two", "ms", median_ms(lambda: compared(database)), limits[1]),
             (f"{name}: page of a test", "ms", median_ms(lambda: pages.test(1)), limits[2]),
             (f"{name}: growth of memory, second half", "MiB", round(growth_mib, 1), limits[3])]


def fill(database, options):
    """Import made-up tests; s for reading and writing alone, and by how much the memory grew in the second half."""
    generator = random.Random(options.seed)
    took_s = half_mib = 0.0
    with tempfile.TemporaryDirectory() as folder:
        for number in range(options.tests):
            path = measured.in_folder(pathlib.Path(folder), *results(generator, options.lines), lines=options.lines,
                                      mark=f"m{number}", identity=Identity(car_model=f"Car {number % 9}"),
                                      started=f"2026-{1 + number % 12:02}-{1 + number % 28:02}T10:00:00+00:00")
            began_s = time.monotonic()
            add(database, None, read_record(path))
            took_s += time.monotonic() - began_s
            if number == options.tests // 2:
                half_mib = memory_mib()
    return took_s, memory_mib() - half_mib


def results(generator, lines):
    """Radials with borders between 4 and 6 m."""
    for number in range(1, lines + 1):
        border_m = generator.uniform(4.0, 6.0)
        places_m = sorted(generator.uniform(3.0, 7.0) for _ in range(PRESSES))
        yield measured.searched(number, border_m, lines=lines, attempts=PRESSES,
                                worked_at_m=tuple(place_m for place_m in places_m if place_m < border_m),
                                failed_at_m=tuple(place_m for place_m in places_m if place_m >= border_m))


def listed(database):
    with database.reading() as connection:
        return reading.find(connection, reading.Search(text="key press", car="Car 3", since="2026-06"))


def compared(database):
    with database.reading() as connection:
        sides = [reading.side(connection, number) for number in (1, 2)]
    return compare_sets(sides[:1], sides[1:])


def median_ms(action):
    """Of some calls; the first one, which fills caches, counts for one."""
    times_s = []
    for _ in range(REPEATED):
        began_s = time.monotonic()
        action()
        times_s.append(time.monotonic() - began_s)
    return round(MS_PER_S * statistics.median(times_s), 1)


def size_of(database, connection):
    """Bytes."""
    if database.file is not None:
        return database.file.stat().st_size
    return connection.execute(text("SELECT pg_database_size(current_database())")).scalar_one()


def memory_mib():
    """The most that this process has had."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024.0 / MIB


if __name__ == "__main__":
    sys.exit(main())
