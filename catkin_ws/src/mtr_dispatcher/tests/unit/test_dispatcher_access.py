"""Keys, roles, rates and the pairing window, without a socket."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_core.errors import ConfigurationError, RobotError
from mtr_dispatcher.access.authorised_keys import MAX_KEYS, AuthorisedKeys, Entry, KeysError, Role, keys_in
from mtr_dispatcher.access.curve import is_loopback
from mtr_dispatcher.access.gate import Gate, Sender
from mtr_dispatcher.access.pairing_window import FIRST_PAUSE_S, MAX_TRIES, PairingLimits, PairingWindow
from mtr_dispatcher.access.rates import Rates
from mtr_dispatcher.core import Dispatcher
from mtr_dispatcher.parameters import Parameters
from mtr_dispatcher.problems import VIEWER_COMMAND
from mtr_dispatcher.session import CommandResult
from mtr_dispatcher.status.builder import Identity
from mtr_dispatcher.status.inputs import Inputs
from mtr_proto import robot_link_pb2 as link


def public_key(number=0):
    return f"{number:040d}"


def entry(name="Jana", role=Role.CONTROLLER, number=1):
    return Entry(name, role, "2026-11-23", public_key(number))


JANA = AuthorisedKeys((entry(),))


def test_list_of_keys_is_the_same_after_its_file():
    listed = JANA.with_entry(entry("Řehoř: \"x\" #1", Role.VIEWER, 2))
    assert keys_in(listed.to_text()) == listed
    assert "viewer" in listed.lines()[1] and "2026-11-23" in listed.lines()[0]


def test_day_that_a_person_wrote_without_quotes_is_a_day():
    assert keys_in(JANA.to_text().replace("'2026-11-23'", "2026-11-23")) == JANA


@pytest.mark.parametrize("text", ["keys: [1]", "keys: 5", "[]x: {", "keys:\n- {name: a, role: king, date: d, key: k}",
                                  "keys:\n- {name: a, role: viewer, date: d, key: short}", "x" * 70000, "keys: [[[["])
def test_what_is_no_list_of_keys_is_a_sentence(text):
    with pytest.raises(KeysError, match=r"It is .*\.$"):
        keys_in(text)


def test_two_owners_of_one_name_are_told_apart_and_a_key_that_pairs_again_is_listed_once():
    two = JANA.with_entry(entry(number=2))
    assert [each.name for each in two.entries] == ["Jana", "Jana 2"]
    again = two.with_entry(entry(role=Role.VIEWER))
    assert [(each.name, each.role) for each in again.entries] == [("Jana 2", Role.CONTROLLER), ("Jana", Role.VIEWER)]


def test_a_full_list_takes_no_more():
    full = AuthorisedKeys(tuple(entry(str(number), number=number) for number in range(MAX_KEYS)))
    with pytest.raises(KeysError, match=f"allowed are {MAX_KEYS}"):
        full.with_entry(entry(number=MAX_KEYS))


def test_revoking_somebody_who_is_not_there_names_those_who_are():
    assert JANA.without("Jana") == AuthorisedKeys()
    with pytest.raises(KeysError, match="there are: Jana"):
        JANA.without("Eva")


def test_rate_counts_each_peer_for_itself_and_fills_up_again():
    rates = Rates(10.0, 3.0)
    assert [rates.allow("a", 0.0) for _ in range(5)] == [True, True, True, False, False]
    assert rates.allow("b", 0.0)
    assert rates.allow("a", 0.1) and not rates.allow("a", 0.1)


def test_rates_of_countless_peers_take_bounded_memory():
    rates = Rates(1.0, 1.0, max_peers=4)
    assert all(rates.allow(number, 0.0) for number in range(1000))
    assert len(rates._buckets) == 4


def test_gate_drops_the_commands_that_are_too_many_of_one_key_alone():
    known = JANA.with_entry(entry("Petr", number=2))
    gate = Gate(lambda: known, 50.0, lambda: 0.0)
    flood = [gate.sender(public_key(1), 0.0) for _ in range(1000)]
    assert sum(not sender.refusal for sender in flood) == 50
    assert "Jana sends more Commands" in flood[-1].refusal.text
    assert gate.sender(public_key(2), 0.0) == Sender(public_key(2), "Petr")


def test_parameters_say_when_the_link_is_encrypted():
    assert not Parameters().is_encrypted and not Parameters().is_exposed
    assert Parameters(encrypt_on_loopback=True).is_encrypted
    for address in ("10.42.0.1", "0.0.0.0", "robot", "*"):
        assert Parameters(bind_address=address).is_encrypted
        by_choice = Parameters(bind_address=address, allow_unencrypted=True)
        assert by_choice.is_exposed and not by_choice.is_encrypted
    with pytest.raises(ConfigurationError, match="contradict"):
        Parameters(allow_unencrypted=True, encrypt_on_loopback=True)


def test_loopback_is_what_only_this_computer_reaches():
    assert [is_loopback(each) for each in ("127.0.0.1", "127.3.4.5", "::1", "localhost")] == [True] * 4
    assert [is_loopback(each) for each in ("0.0.0.0", "*", "10.0.0.1", "::", "localhost.evil.example")] == [False] * 5


# The dispatcher's core

NOW_S = 100.0
OF_JANA, OF_PETR = Sender(public_key(1), "Jana"), Sender(public_key(2), "Petr")


@pytest.fixture
def core():
    dispatcher = Dispatcher(Parameters(), Identity(7, "1.2.3", 0.25, 0.0))
    dispatcher.status(Inputs(NOW_S, steady_s=NOW_S))
    return dispatcher


def order(number=1, session_id=5, at=(1, NOW_S), **content):
    """at: id and time of the answered Status."""
    return link.Command(session_id=session_id, id=number, seen_status_id=at[0], seen_robot_time_s=at[1],
                        **content).SerializeToString()


def told(core):
    return link.Status.FromString(core.status(Inputs(NOW_S, steady_s=NOW_S)))


def test_owner_of_the_key_is_logged_with_each_new_command_and_told_in_status(core):
    said = "Application 5 of Jana controls the robot now."
    assert core.receive(order(), NOW_S, OF_JANA) == (CommandResult.TAKEN, said)
    assert core.receive(order(2), NOW_S, OF_JANA) == (CommandResult.TAKEN, "Command 2 of Jana was taken.")
    assert core.receive(order(2), NOW_S, OF_JANA) == (CommandResult.REPEATED, "")
    assert told(core).controller_name == "Jana"
    core.receive(order(3, end_session=True), NOW_S, OF_JANA)
    assert not told(core).HasField("controller_name")


def test_link_without_keys_names_nobody(core):
    core.receive(order(), NOW_S)
    assert not told(core).HasField("controller_name")


def test_viewers_command_moves_nothing_and_is_told_in_one_sentence(core):
    viewer = Sender(public_key(3), "Eva", VIEWER_COMMAND(name="Eva"))
    result, sentence = core.receive(order(), NOW_S, viewer)
    assert result is CommandResult.FORBIDDEN and sentence == VIEWER_COMMAND(name="Eva").text
    status = told(core)
    assert status.rejected_messages == 1 and status.session_id == 0
    assert [notice.text for notice in status.notifications if notice.code == "key_refused"] == [sentence]


def test_command_in_the_name_of_anothers_session_is_refused(core):
    core.receive(order(), NOW_S, OF_JANA)
    result, sentence = core.receive(order(2), NOW_S, Sender(public_key(6), "Mallory"))
    assert result is CommandResult.FORBIDDEN and "Mallory" in sentence
    assert core.session.command.id == 1


def test_session_that_has_ended_or_lost_control_is_still_its_keys_alone(core):
    core.receive(order(), NOW_S, OF_JANA)
    core.receive(order(2, end_session=True), NOW_S, OF_JANA)
    core.receive(order(session_id=8), NOW_S, OF_JANA)
    later_s = NOW_S + 3.5
    core.status(Inputs(later_s, steady_s=later_s))
    assert core.receive(order(session_id=9, at=(2, later_s)), later_s, OF_PETR)[0] is CommandResult.TAKEN
    for session_id in (5, 8):
        late = order(3, session_id=session_id, at=(2, later_s))
        assert core.receive(late, later_s, OF_PETR)[0] is CommandResult.FORBIDDEN
        assert core.receive(late, later_s, OF_JANA)[0] is CommandResult.OUTDATED
    assert core.session.session_id == 9 and told(core).controller_name == "Petr"


def test_owner_who_has_a_new_name_goes_on_in_his_session_and_is_told_by_it(core):
    core.receive(order(), NOW_S, OF_JANA)
    renamed = Sender(OF_JANA.key, "Jana (laboratory)")
    assert core.receive(order(2, stop=True), NOW_S, renamed)[0] is CommandResult.TAKEN
    assert told(core).controller_name == "Jana (laboratory)"


def test_another_key_under_the_owners_name_does_not_speak_in_his_session(core):
    core.receive(order(), NOW_S, OF_JANA)
    assert core.receive(order(2), NOW_S, Sender(public_key(2), "Jana"))[0] is CommandResult.FORBIDDEN


def test_refused_connections_are_one_notice_with_their_number(core):
    for count in (1, 2, 3):
        core.refused_connections(count, NOW_S)
    texts = [notice.text for notice in told(core).notifications if notice.code == "connections_refused"]
    assert len(texts) == 1 and texts[0].startswith("3 connections")
    assert told(core).rejected_messages == 0


# Pairing

def test_window_closes_after_its_time():
    window = PairingWindow(PairingLimits(120.0), 1000.0)
    assert window.left_s(1000.0) == 120.0 and window.left_s(1119.0) == 1.0
    assert window.left_s(1120.0) == 0.0 and "120 s" in window.why_closed()


def test_wrong_tries_are_slowed_and_then_close_the_window():
    window, now_s, waited = PairingWindow(PairingLimits(), 0.0), 0.0, []
    while window.left_s(now_s):
        waited.append(window.pause_s(now_s))
        now_s += waited[-1]
        window.begin_try(now_s)
    assert waited == [0.0, FIRST_PAUSE_S, 2.0 * FIRST_PAUSE_S] and window.tries == MAX_TRIES
    assert "3 tries were wrong" in window.why_closed()


def test_window_is_not_open_for_ever():
    with pytest.raises(RobotError, match="allowed is 10 to 600 s"):
        PairingLimits(3600.0)
