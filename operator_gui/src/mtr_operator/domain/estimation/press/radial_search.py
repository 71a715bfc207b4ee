"""Bayesian search on one radial: the next press has the largest expected information per second.

It ends when the 95 % interval of the line's own d50 is as narrow as required, or after the allowed presses. Three rules
have priority. An unexpected failure is repeated, which distinguishes a hole from a random miss. An unexpected success
counts only if it repeats, so that another key's button does not extend the range. If no press worked, the nearest place
is tried several times, so that a sleeping key is not mistaken for a range of zero.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Iterator, Sequence

import numpy as np

from ..interval import SIGMAS_OF_LEVEL, FloatArray
from .campaign import Campaign
from .hypotheses import Hypotheses
from .information import PressInformation
from .likelihood import Press, PressLikelihood
from .line_boundary import LineBoundary
from .one_boundary import Uneven, parts_m, probability_of, uneven
from .plan import SearchPlan
from .posterior import RadialPosterior

# Minimum information of a press relative to the best place: a press at the current position is cheap but may be
# useless.
MIN_SHARE = 0.7
# Quantiles of d50 that are tried if an interval below half a wavelength is required.
_QUANTILES = np.linspace(0.1, 0.9, 9)
# A press that fails despite at least this probability of success is repeated, up to this number at its place.
SURE_TO_WORK = 0.95
PRESSES_IN_DOUBT = 3
# A press that works despite at most this probability is repeated as well. Omitting it without a repetition causes a
# bias of that size in the far tail of the curve; accepting another key's button would cause metres.
UNLIKELY_TO_WORK = 0.05
# Fewer presses look sharp by chance while the width is not known from other radials.
MIN_PRESSES = 9
# A smaller rate of random misses is ignored: an end caused by one would have a probability below 1 %. Before any
# measurement a higher rate is assumed.
_LAPSES_RARELY = 0.01
# Drawing the line's own interval needs some hundredths of a second. It is done at the end, and if the mean curve's
# interval is at most this times the required one.
_WORTH_DRAWING = 3.0
_DRAWS, _FINAL_DRAWS = 200, 1000
# A look before the last one decides by tails of 0.3 %, of which 1000 draws have three: 20 000 at most.
_DRAWS_IN_TAIL, _LEAST_TAIL = 30, 1.5e-3


class RadialSearch:
    """State of one radial.

    Attributes:
        presses: counted presses so far, in order.
        place_m: position of the key.
    """

    def __init__(self, plan: SearchPlan, hypotheses: Hypotheses, campaign: Campaign, radial: int, place_m: float):
        self._plan = plan
        self._hypotheses = hypotheses
        self._campaign = campaign
        self._radial = radial
        self._likelihood = PressLikelihood(hypotheses, plan.lattice)
        self._posterior: RadialPosterior | None = None
        self._boundary: LineBoundary | None = None
        self._doubted_m: float | None = None
        self._awaiting: Press | None = None
        self._repeats_failed = 0
        self._unconfirmed: list[Press] = []
        self.presses: list[Press] = []
        self.place_m = place_m

    def posterior(self) -> RadialPosterior:
        """Return the posterior after the presses so far."""
        if self._posterior is None:
            self._posterior = self._given(self._likelihood.log)
            if self.presses:
                self._campaign.keep_evidence(self._radial, self._posterior.log_evidence)
                self._campaign.keep_place(self._radial, self._posterior.places(), self._hypotheses)
        return self._posterior

    def posterior_without(self, distance_m: float) -> RadialPosterior:
        """Return the posterior from all presses except those at a place."""
        return self._given(self._likelihood.without(distance_m))

    def revisit(self) -> RadialPosterior:
        """Recompute the posterior after other radials were measured."""
        self._posterior = self._boundary = None
        return self.posterior()

    @property
    def unconfirmed(self) -> list[Press]:
        """Uncounted presses: unexpected successes whose repetition failed or is pending."""
        return self._unconfirmed if self._awaiting is None else [*self._unconfirmed, self._awaiting]

    def boundary(self) -> LineBoundary:
        """Return the line's own d50 and d95, see line_boundary."""
        return self._boundary_of(_FINAL_DRAWS)

    def boundaries(self, tail: float) -> Iterator[LineBoundary]:
        """Yield enough draws for a tail of this probability, in parts of some hundredths of a second each."""
        parts = math.ceil(_DRAWS_IN_TAIL / (max(tail, _LEAST_TAIL) * _FINAL_DRAWS))
        for part in range(parts):
            yield self._boundary_of(_FINAL_DRAWS, part)

    def _boundary_so_far(self) -> LineBoundary:
        if self._boundary is None:
            self._boundary = self._boundary_of(_DRAWS)
        return self._boundary

    def _boundary_of(self, draws: int, part: int = 0) -> LineBoundary:
        return LineBoundary(self.posterior(), self.presses, self._likelihood.lattice, draws, part)

    def add(self, press: Press) -> None:
        """Add the result of a press."""
        if self._awaiting is not None:
            self._confirm(self._awaiting, press)
        elif press.worked and self.posterior().works(press.distance_m) <= UNLIKELY_TO_WORK:
            self._awaiting, self._repeats_failed, self.place_m = press, 0, press.distance_m
        else:
            self._count(press)

    def _confirm(self, awaiting: Press, press: Press) -> None:
        """Add another press at the place of an unlikely one."""
        if press.worked:
            self._awaiting = None
            self._count(awaiting)
        self._count(press)
        self._repeats_failed += not press.worked
        if self._repeats_failed == PRESSES_IN_DOUBT - 1:
            self._unconfirmed.append(awaiting)
            self._awaiting = None

    def _count(self, press: Press) -> None:
        is_repeated = self._doubted_m is not None and self.place_of(press.distance_m) == self.place_of(self._doubted_m)
        doubtful = is_repeated or self.posterior().works(press.distance_m) >= SURE_TO_WORK
        self._doubted_m = press.distance_m if doubtful and not press.worked else None
        self.presses.append(press)
        self.place_m = press.distance_m
        self._likelihood.add(press)
        self.revisit()

    def place_of(self, distance_m: float) -> int:
        """Return the number of the half wavelength around a distance: its presses count as made at one place."""
        return self._likelihood.lattice.place_of(distance_m)

    def recall(self, presses: Sequence[Press]) -> None:
        """Restore the presses of a finished radial, without further confirmations."""
        self._likelihood.add(*presses)
        self.presses.extend(presses)
        self.revisit()
        self._note_discord()

    def is_finished(self) -> bool:
        """Return True if the interval is reached, or no press is left."""
        if len(self.presses) + len(self.unconfirmed) >= self._plan.attempts_limit:
            return True
        if len(self.presses) < MIN_PRESSES or self._place_in_doubt() is not None:
            return False
        return self._is_narrow() and self._place_to_prove() is None and not self._places_to_check_m()

    def next_place_m(self) -> float:
        """Return the place of the next press, with the largest information per second of robot time."""
        doubted_m = self._place_in_doubt()
        if doubted_m is not None:
            return doubted_m
        is_narrow = self._is_narrow()
        proved_m = self._place_to_prove() if is_narrow else None
        if proved_m is not None:
            return proved_m
        checked_m = self._place_to_check(is_narrow)
        if checked_m is not None:
            return checked_m
        posterior = self.posterior()
        places_m = self._candidates(posterior)
        if posterior.d50().half_width_m <= self._worth_drawing_m:
            works, own = self._boundary_so_far().information(places_m)
        else:
            works, own = PressInformation(posterior).at(places_m)
        seconds = self._plan.times.expected_s(np.abs(places_m - self.place_m), works)
        informative = own >= MIN_SHARE * np.max(own)
        return float(places_m[np.argmax(informative * own / seconds)])

    def _given(self, log_likelihood: FloatArray) -> RadialPosterior:
        return RadialPosterior(self._hypotheses, log_likelihood, self._campaign.log_shape_prior(self._radial),
                               self._campaign.log_place_prior(self._radial, self._hypotheses))

    @property
    def _worth_drawing_m(self) -> float:
        return _WORTH_DRAWING * max(self._plan.interval_m, self._plan.half_wavelength_m)

    def _is_narrow(self) -> bool:
        wanted_m = self._plan.interval_m
        if not self._is_end_within(self.posterior(), wanted_m):
            return False
        # The interval of a few draws is sometimes narrow by chance, given the number of presses.
        return not self._plan.is_fine or self.boundary().d50().half_width_m <= wanted_m

    def _place_to_prove(self) -> float | None:
        """Return the nearest place beyond the boundary that has failed only once: a random miss would be a wrong
        end."""
        if self.posterior().lapse < _LAPSES_RARELY:
            return None
        d50_m = self._boundary_so_far().d50().value_m
        beyond_m = [press.distance_m for press in self.presses if not press.worked and press.distance_m > d50_m]
        nearest_m = min(beyond_m, default=None)
        return nearest_m if nearest_m is not None and self._likelihood.presses_beside(nearest_m) == 1 else None

    def _place_to_check(self, is_narrow: bool) -> float | None:
        """Return the nearest place to be checked, if the boundary is known or the remaining presses are needed for
        checks."""
        plan = self._plan
        left = plan.attempts_limit - len(self.presses) - len(self.unconfirmed)
        places_m = self._places_to_check_m()
        if not places_m or not (is_narrow or left <= len(places_m)):
            return None
        return min(places_m, key=lambda place_m: abs(place_m - self.place_m))

    def _places_to_check_m(self) -> list[float]:
        """Return a place in each part of the path without a press, as far as holes are possible: on both sides of the
        boundary, because the hole may be the end that was found."""
        plan = self._plan
        edges_m = parts_m(plan.minimum_m, plan.maximum_m)
        places_m = plan.places_m()
        open_m = [(low_m + high_m) / 2.0 for low_m, high_m in zip(edges_m, edges_m[1:]) if low_m < plan.checked_m
                  and not any(low_m <= press.distance_m < high_m for press in self.presses)]
        return [float(places_m[np.argmin(np.abs(places_m - middle_m))]) for middle_m in open_m]

    def uneven(self, sigmas: float = SIGMAS_OF_LEVEL) -> Uneven | None:
        """Return the result without a curve if one falling curve does not describe the presses, else None; see
        one_boundary."""
        self._note_discord()
        if not self._campaign.is_uneven(self._radial):
            return None
        return uneven(self.presses, parts_m(self._plan.minimum_m, self._plan.maximum_m), sigmas)

    def _note_discord(self) -> None:
        plan = self._plan
        if self.presses and plan.checked_m > plan.minimum_m:
            self._campaign.keep_discord(self._radial, probability_of(
                self.posterior(), self.presses, self._likelihood.lattice, parts_m(plan.minimum_m, plan.maximum_m)))

    def _place_in_doubt(self) -> float | None:
        if self._awaiting is not None:
            return self._awaiting.distance_m
        nearest_m = self._plan.minimum_m
        tried = self._likelihood.presses_beside(nearest_m)
        if 0 < tried < PRESSES_IN_DOUBT and not any(press.worked for press in self.presses):
            return nearest_m
        doubted_m = self._doubted_m
        if doubted_m is not None and self._likelihood.presses_beside(doubted_m) < PRESSES_IN_DOUBT:
            return doubted_m
        return None

    def _candidates(self, posterior: RadialPosterior) -> FloatArray:
        """Return places half a wavelength apart, without the current one until the boundary is known to that
        resolution."""
        plan = self._plan
        step_m = plan.half_wavelength_m
        places_m = plan.places_m()
        if self._plan.is_fine and self._is_end_within(posterior, step_m):
            inner_m = self._boundary_so_far().likely_ends_m(_QUANTILES)
            return np.clip(np.concatenate((places_m, inner_m)), plan.minimum_m, plan.maximum_m)
        if posterior.d50().half_width_m > step_m:
            here = self.place_of(self.place_m)
            return np.asarray(places_m[self._likelihood.lattice.places_of(places_m) != here])
        return places_m

    def _is_end_within(self, posterior: RadialPosterior, half_width_m: float) -> bool:
        return (posterior.d50().half_width_m <= self._worth_drawing_m
                and self._boundary_so_far().d50().half_width_m <= half_width_m)
