"""Cases of one test whose failure names the case; rosunit's report keeps no word of a failed subTest."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
from typing import Iterator


@contextlib.contextmanager
def case(what: object) -> Iterator[None]:
    """Context of one case; AssertionError names it."""
    try:
        yield
    except AssertionError as error:
        raise AssertionError(f"{what}: {error}") from error
