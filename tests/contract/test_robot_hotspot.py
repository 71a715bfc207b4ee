"""The robot's access point: the one of before stays until the new one is up, and no command has the password."""
# SPDX-License-Identifier: Apache-2.0
import configparser
import os
import pathlib
import subprocess

import pytest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "setup" / "install-robot.sh"
# Says what it was told, and begins no access point in the bands of $REFUSED.
NMCLI = """#!/bin/bash
echo "$*" >>"$TOLD"
case $* in
  *device) echo "wifi:${STATE:-disconnected}" ;;
  *show) echo "wired:0"; echo "mtr-hotspot:former" ;;
  "connection load "*) cp "$3" "$LOADED" ;;
  "connection up uuid former") ;;
  "connection up "*) band=$(sed -n s/^band=//p "$LOADED"); [[ " $REFUSED " != *" $band "* ]] ;;
esac
"""
IW = '#!/bin/sh\necho "iw $*" >>"$TOLD"\n'


class Network:
    """What the script told NetworkManager, and what it wrote.

    Attributes:
        folder: folder of the test; the robot's / is `disk` in it.
        told: every command, one a line.
    """

    def __init__(self, folder):
        self.folder = folder
        self.told = ""
        for name, text in {"nmcli": NMCLI, "iw": IW}.items():
            (folder / name).write_text(text, encoding="ascii")
            (folder / name).chmod(0o755)

    def hotspot(self, *words, typed="", refused="", state="disconnected"):
        """The finished command."""
        environment = dict(os.environ, PATH=f"{self.folder}:{os.environ['PATH']}", TOLD=str(self.folder / "told"),
                           LOADED=str(self.folder / "loaded"), REFUSED=refused, STATE=state)
        done = subprocess.run([SCRIPT, "hotspot", *words, "--staging", str(self.folder / "disk")], check=False,
                              input=typed, text=True, capture_output=True, env=environment)
        told = self.folder / "told"
        self.told = told.read_text(encoding="utf-8") if told.exists() else ""
        return done

    def files(self):
        """NetworkManager's files of connections."""
        return list((self.folder / "disk").rglob("*.nmconnection"))

    def settings(self):
        """The only file, as GLib reads it."""
        found = configparser.RawConfigParser(delimiters="=")
        found.read(self.files()[0], encoding="utf-8")
        return found


@pytest.fixture
def network(tmp_path):
    return Network(tmp_path)


def test_the_password_is_read_and_stands_in_no_command_but_in_a_file_of_root_alone(network):
    done = network.hotspot("Robot", typed=" a secret\n")
    assert done.returncode == 0, done.stderr
    assert "secret" not in network.told + done.stdout
    assert network.settings()["wifi-security"]["psk"] == r"\sa\ssecret"
    assert network.files()[0].stat().st_mode & 0o777 == 0o600


def test_a_password_that_is_given_is_taken_as_before(network):
    assert network.hotspot("Robot", "12345\\678").returncode == 0
    assert network.settings()["wifi-security"]["psk"] == r"12345\\678" and "12345" not in network.told


def test_a_name_is_written_by_its_bytes(network):
    network.hotspot("R 2;", "12345678")
    assert network.settings()["wifi"]["ssid"] == "82;32;50;59;"


@pytest.mark.parametrize("words, typed", [(["Robot"], "short\n"), (["Robot"], ""), (["Robot", "1" * 64], ""), ([], "")])
def test_a_command_that_is_not_whole_changes_nothing(network, words, typed):
    assert network.hotspot(*words, typed=typed).returncode == 2
    assert not network.told and not network.files()


def test_the_former_access_point_is_removed_when_the_new_one_is_up(network):
    network.hotspot("Robot", "12345678")
    commands = network.told.splitlines()
    up = next(index for index, command in enumerate(commands) if command.startswith("connection up"))
    assert commands.index("connection delete uuid former") > up and network.settings()["wifi"]["band"] == "a"


def test_without_5_ghz_it_is_one_at_2_4_ghz_and_says_so(network):
    done = network.hotspot("Robot", "12345678", refused="a")
    assert done.returncode == 0 and "2.4 GHz" in done.stdout and network.settings()["wifi"]["band"] == "bg"


def test_an_access_point_that_cannot_begin_leaves_the_former_one(network):
    done = network.hotspot("Robot", "12345678", refused="a bg")
    assert done.returncode == 2 and "the one of before stays" in done.stderr
    assert "delete" not in network.told and network.told.endswith("connection up uuid former\n") and not network.files()


def test_a_country_is_told_to_the_kernel_now_and_after_each_start(network):
    assert network.hotspot("Robot", "12345678", "--country", "DE").returncode == 0
    told = network.told.splitlines()
    up = next(index for index, command in enumerate(told) if command.startswith("connection up"))
    assert told.index("iw reg set DE") < up
    kept = network.folder / "disk" / "etc" / "modprobe.d" / "mtr-country.conf"
    assert kept.read_text(encoding="ascii") == "options cfg80211 ieee80211_regdom=DE\n"


@pytest.mark.parametrize("country", ["Germany", "de", ""])
def test_a_word_that_is_no_country_is_refused(network, country):
    assert network.hotspot("Robot", "12345678", "--country", country).returncode == 2 and not network.told


def test_without_wifi_in_network_manager_it_names_netplan(network):
    done = network.hotspot("Robot", "12345678", state="unmanaged")
    assert done.returncode == 2 and "netplan" in done.stderr and not network.files()
