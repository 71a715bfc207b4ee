"""The radio margins of the honest Cars equal the results of the former, slower computation."""
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

from mtr_simulation.car.choice import chosen_car
from mtr_simulation.car.honest.margins import Margins
from mtr_simulation.car.honest.radio.key_antenna import Attitude

PLACES = np.array([[0.05, 1.2, 1.0], [0.05, 2.4, 1.0], [-3.1, 0.4, 0.8], [2.9, -1.7, 1.2], [1.0, -4.5, 0.5],
                   [-0.6, -1.6, 1.1]])
TURNED = Attitude(0.7)
# Computed on 2026-11-23, one antenna at a time and with complex numbers.
FORMER_DB = {
    "honest": {
        "unlock_db": [36.101637032483445, 2.7069114147878213, 13.726336378577523, 0.8821745256297426,
                      -22.134650653871592, 14.542349039052086],
        "lock_db": [39.18230727912026, 14.706911414787822, 24.443982136997356, 12.882174525629743,
                    -10.134650653871592, 26.542349039052084],
        "button_db": [7.182307279120259, -1.712278181034911, -7.556017863002644, 5.470249589418749,
                      -12.4870651599147, -4.765326144296306]},
    "honest_868": {
        "unlock_db": [19.107053469087884, -1.2912580773739584, 14.635108436718303, 0.026637852210917967,
                      -22.18444418866864, 12.369340038271439],
        "lock_db": [19.107053469087884, 10.708741922626041, 26.635108436718305, 12.026637852210918,
                    -10.184444188668639, 24.36934003827144],
        "button_db": [-12.892946530912116, -9.109406605081475, 3.7429474116163277, 4.87234771794364,
                      -11.536722650343602, 3.6481812688315927]}}


@pytest.mark.parametrize("car", FORMER_DB)
@pytest.mark.parametrize("decision", ["unlock_db", "lock_db", "button_db"])
def test_margins_are_the_former_ones_at_many_places_and_at_one(car, decision):
    margin_db = getattr(Margins(chosen_car(car).honest), decision)
    assert margin_db(PLACES, TURNED) == pytest.approx(FORMER_DB[car][decision], abs=1e-9)
    assert [float(margin_db(place, TURNED)) for place in PLACES] == pytest.approx(FORMER_DB[car][decision], abs=1e-9)
