"""Periods of time as entered by a person, for comparison with the stored start times of tests."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime
import re

from ..errors import StoreError

_WRITTEN = re.compile(r"(\d{4})(?:-(\d\d)(?:-(\d\d)(?:[T ](\d\d):(\d\d)(?::(\d\d)(?:\.\d{1,6})?)?"
                      r"(Z|[+-]\d\d:\d\d)?)?)?)?", re.ASCII)
_MAX_SHOWN = 40
_UTC = datetime.timezone.utc


def first_moment(name: str, text: str) -> str:
    """Return the first moment of a year, month, day or moment, in the format of started_utc without an offset.

    Raises StoreError with the name of the argument if the text is not a period.
    """
    return _stored(_period(name, text)[0])


def next_moment(name: str, text: str) -> str:
    """Return the first moment after the period, as an exclusive upper end."""
    return _stored(_period(name, text)[1])


def _stored(moment: datetime.datetime) -> str:
    return moment.replace(tzinfo=None).isoformat()


def _period(name: str, text: str) -> tuple[datetime.datetime, datetime.datetime]:
    found = _WRITTEN.fullmatch(text.strip())
    if found:
        year, month, day, hour, minute, second, zone = found.groups()
        try:
            begin = datetime.datetime(int(year), int(month or 1), int(day or 1), int(hour or 0), int(minute or 0),
                                      int(second or 0), tzinfo=_zone(zone))
            return begin.astimezone(_UTC), _end(begin, month, day, hour, second).astimezone(_UTC)
        # Python dates are limited to the years 1 to 9999.
        except (ValueError, OverflowError):
            pass
    raise StoreError(f"{name} is {text[:_MAX_SHOWN]!r}; allowed is a day such as 2026-11-22, a month, a year, or a "
                     "moment such as 2026-11-22T15:36, in UTC.")


def _end(begin: datetime.datetime, *written: str | None) -> datetime.datetime:
    month, day, hour, second = written
    if day is None:
        later = begin.year * 12 + begin.month - 1 + (1 if month else 12)
        return begin.replace(year=later // 12, month=later % 12 + 1)
    if hour is None:
        return begin + datetime.timedelta(days=1)
    return begin + (datetime.timedelta(minutes=1) if second is None else datetime.timedelta(seconds=1))


def _zone(text: str | None) -> datetime.timezone:
    if text in (None, "Z"):
        return _UTC
    hours, minutes = map(int, str(text)[1:].split(":"))
    return datetime.timezone((-1 if str(text)[0] == "-" else 1) * datetime.timedelta(hours=hours, minutes=minutes))
