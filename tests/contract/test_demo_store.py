"""Where the demo says its tests are seen is where the store serves them."""
# SPDX-License-Identifier: Apache-2.0
from mtr_results.web.access import Access
from mtr_simulation.demo import STORE_PAGE


def test_the_demo_names_the_address_at_which_mtr_results_serves():
    assert Access().address == STORE_PAGE
