"""Factors of a plan: discrete values, or a distribution."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import sys
from dataclasses import dataclass
from statistics import NormalDist
from typing import Any, Sequence, Union

from ..errors import CampaignError
from .run import Value

# A different seed for each of a million repetitions exceeds any campaign.
MAX_VALUES = 1_000_000
# Larger numbers of runs are not written out.
_MAX_WRITTEN = 10 ** 15
_WAYS = "a list of values, {from: 1, to: 10}, {low: 0.5, high: 2.0} or {mean: 0.0, sigma: 0.01}"


@dataclass(frozen=True)
class Values:
    """Discrete values."""

    values: Sequence[Value]

    def at(self, part: float) -> Value:
        """Return the value of a quantile, 0 to 1."""
        return self.values[min(int(part * len(self.values)), len(self.values) - 1)]

    def ends(self) -> tuple[Value, ...]:
        """Return the values to validate, so that all values are possible if these are."""
        return tuple(self.values) if len(self.values) <= 64 else (self.values[0], self.values[-1])


@dataclass(frozen=True)
class Uniform:
    """Uniform distribution between two ends."""

    low: float
    high: float

    def at(self, part: float) -> Value:
        """See Values."""
        return self.low + part * (self.high - self.low)

    def ends(self) -> tuple[Value, ...]:
        """See Values."""
        return self.low, self.high


@dataclass(frozen=True)
class Normal:
    """Normal distribution, truncated at three sigmas."""

    mean: float
    sigma: float

    def at(self, part: float) -> Value:
        """See Values."""
        whole = NormalDist(self.mean, self.sigma)
        least = NormalDist().cdf(-3.0)
        return whole.inv_cdf(least + part * (1.0 - 2.0 * least))

    def ends(self) -> tuple[Value, ...]:
        """See Values."""
        return self.mean - 3.0 * self.sigma, self.mean + 3.0 * self.sigma


Factor = Union[Values, Uniform, Normal]


def factor_from(name: str, content: Any) -> Factor:
    """Convert a factor of a plan; CampaignError lists the allowed forms."""
    if isinstance(content, list) and content and all(is_single(each) for each in content):
        if len({(type(each), each) for each in content}) != len(content):
            raise CampaignError(f"The values of {name:.60} hold one twice; each is run once.")
        return Values(tuple(content))
    if not isinstance(content, dict):
        raise CampaignError(f"{name:.60} is {short(content)}; allowed is {_WAYS}.")
    if set(content) == {"from", "to"} and all(_is_whole(each) for each in content.values()):
        return _whole_numbers(name, content["from"], content["to"])
    if set(content) == {"low", "high"} and all(is_number(each) for each in content.values()):
        if content["low"] >= content["high"]:
            raise CampaignError(f"{name:.60} reaches from {content['low']:g} to {content['high']:g}; low has to be the "
                                "smaller one.")
        return Uniform(float(content["low"]), float(content["high"]))
    if set(content) == {"mean", "sigma"} and all(is_number(each) for each in content.values()):
        if content["sigma"] <= 0.0:
            raise CampaignError(f"sigma of {name:.60} is {content['sigma']:g}; allowed is more than 0.")
        return Normal(float(content["mean"]), float(content["sigma"]))
    raise CampaignError(f"{name:.60} is {short(content)}; allowed is {_WAYS}.")


def _whole_numbers(name: str, first: int, last: int) -> Values:
    if not first <= last:
        raise CampaignError(f"{name:.60} reaches from {first} to {last}; allowed is up to a larger number.")
    if last - first >= MAX_VALUES:
        raise CampaignError(f"{name:.60} has {count_text(last - first + 1)} values; allowed are at most {MAX_VALUES}.")
    # A range is lazy: a plan may be rejected because of its size.
    return Values(range(first, last + 1))


def is_single(value: Any) -> bool:
    """True for a number, a text, or a truth value."""
    return isinstance(value, (str, bool)) or is_number(value)


def is_number(value: Any) -> bool:
    """True for a finite number; integers in YAML may exceed the range of floats."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) <= sys.float_info.max


def count_text(count: int) -> str:
    """Return a count for a sentence."""
    return str(count) if count <= _MAX_WRITTEN else f"more than {_MAX_WRITTEN}"


def short(value: Any) -> str:
    """Return a shortened wrong value for a sentence."""
    return f"{value!r:.60}"


def _is_whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)
