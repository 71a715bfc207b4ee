"""Every event in every state is either a row of the table or an error."""
# SPDX-License-Identifier: Apache-2.0
import itertools

import pytest

from mtr_core.states import State
from mtr_state_machine.table import TABLE, Event, StateTable, UnknownEvent

NEXT = {(state, event): target for state, event, target in TABLE}


def table_in(state):
    table = StateTable()
    table.state = state
    return table


@pytest.mark.parametrize("state, event", itertools.product(State, Event))
def test_event_leads_to_the_next_state_or_is_an_error(state, event):
    table = table_in(state)
    if (state, event) in NEXT:
        assert table.fire(event) is NEXT[state, event] and table.state is NEXT[state, event]
    else:
        with pytest.raises(UnknownEvent, match=f"{event.value}.*{state.name}"):
            table.fire(event)
        assert table.state is state


def test_table_has_one_row_per_state_and_event():
    assert len(NEXT) == len(TABLE)


def test_every_state_can_be_left_and_reached():
    assert {state for state, _, _ in TABLE} == set(State)
    assert {target for _, _, target in TABLE} == set(State) - {State.STARTING}
