"""Whoever has no controller's key moves nothing on the running robot, and its Operator hardly feels that he tries."""
# SPDX-License-Identifier: Apache-2.0
import shutil
import subprocess
import time

import pytest
from attacks import INSIDERS, STRANGERS
from robot_under_attack import TOP, RobotUnderAttack

from mtr_benchmarks.harness.tails import percentile
from mtr_dispatcher.access.command_line import NOT_PAIRED
from mtr_dispatcher.access.pairing_window import FIRST_PAUSE_S, MAX_TRIES
from mtr_simulation.stack import free_port

OUT = TOP / "out" / "test" / "security"
# Of one attack: nobody controls the robot that long, then so many Commands of its Operator are timed.
IDLE_S, COMMANDS = 6.0, 150
# What 99 of 100 of his Commands may take, s: one that is older has expired. `make red-team` asks that they take at
# most twice as long as ever.
LONGEST_S = 1.0
LIMIT_S = 120.0
# A notice each of connections, of keys and of what was cut off; and one more line in ten seconds of each.
MAX_LINES = 12
REFUSED = {"connections_refused", "connections_cut_off", "key_refused", "bad_message"}


@pytest.fixture(scope="module")
def robot():
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    with RobotUnderAttack(OUT) as running:
        yield running


def test_same_orders_of_a_controller_move_wheels_and_buttons(robot):
    """Else it would prove nothing that they move nothing when others give them."""
    words = robot.words_to_controller()
    assert words["moves"] and words["press"], words


@pytest.mark.parametrize("attacks", [STRANGERS, INSIDERS], ids=["strangers", "insiders"])
def test_attack_moves_nothing_and_the_operator_is_told_once(robot, attacks):
    found = robot.attacked([each.__name__ for each in attacks], IDLE_S, COMMANDS)
    assert all(found.tries.values()) and not found.tries.get("unknown_keys", {}).get("let in"), found.tries
    assert not found.words["moves"] and not found.words["press"] and found.words["stands"] > 10 * IDLE_S
    assert found.notices == 1 and REFUSED & set(found.codes) and found.log_lines <= MAX_LINES
    assert percentile(found.delays_s, 0.99) < LONGEST_S


def test_guesses_of_the_code_are_counted_slowed_and_pair_nobody(robot):
    port, known, began_s = free_port(), robot.keys.authorised(), time.monotonic()
    pairing = subprocess.Popen(["rosrun", "mtr_dispatcher", "pair", "--keys", str(robot.folder / "keys"), "--port",
                                str(port)], env=robot.stack.environment(), text=True, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE)
    assert "Code" in pairing.stdout.readline()
    with robot.attackers(["pairing_guesses"], port, "127.0.0.1") as attackers:
        said, why = pairing.communicate(timeout=LIMIT_S)
        tries = attackers.communicate(timeout=LIMIT_S)[0]
    assert pairing.returncode == NOT_PAIRED and f"{MAX_TRIES} tries were wrong" in why, said + why
    assert '"paired"' not in tries and f'"guesses": {MAX_TRIES}' in tries, tries
    assert time.monotonic() - began_s >= FIRST_PAUSE_S * (1.0 + 2.0)
    assert robot.keys.authorised() == known


def test_operator_drives_the_robot_when_all_is_over(robot):
    """What the others have sent moves the wheels at once when it comes from him: the witness sees."""
    before = robot.witness.counts["moves"]
    robot.operator.until(lambda: robot.witness.counts["moves"] > before, "a drive", map_car_id=7)
    robot.operator.until(robot.stands, "standstill", stop=True)
