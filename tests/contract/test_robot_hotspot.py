"""The robot's access point: the one of before stays until the new one is up, and no command has the password."""
# SPDX-License-Identifier: Apache-2.0
import configparser
import os
import pathlib
import re
import shutil
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
NFT = '#!/bin/sh\nexit 0\n'
IW = '#!/bin/sh\necho "iw $*" >>"$TOLD"\n'


HERE = pathlib.Path(__file__).resolve().parents[2] / "setup" / "robot"


class Network:
    """What the script told NetworkManager, and what it wrote.

    Attributes:
        folder: folder of the test; the robot's / is `disk` in it.
        told: every command, one a line.
    """

    def __init__(self, folder):
        self.folder = folder
        self.told = ""
        for name, text in {"nmcli": NMCLI, "iw": IW, "nft": NFT}.items():
            (folder / name).write_text(text, encoding="ascii")
            (folder / name).chmod(0o755)

    def hotspot(self, *words, typed="", refused="", state="disconnected", path=None):
        """The finished command. path: of its programs; by default those of this machine behind the network's."""
        path = path or f"{self.folder}:{os.environ['PATH']}"
        environment = dict(os.environ, PATH=path, TOLD=str(self.folder / "told"),
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


def test_the_way_to_other_networks_is_closed_before_the_access_point_is_begun(network):
    assert network.hotspot("Robot", "12345678").returncode == 0
    disk, units = network.folder / "disk", network.folder / "disk" / "etc" / "systemd" / "system"
    rules = (disk / "etc" / "mtr" / "mtr-hotspot.nft").read_text(encoding="ascii")
    assert rules == (HERE / "mtr-hotspot.nft").read_text(encoding="ascii")
    # At each start of the robot: NetworkManager does not begin without them.
    unit = (units / "mtr-hotspot.service").read_text(encoding="ascii")
    assert "RequiredBy=NetworkManager.service" in unit and re.search(r"^Before=.*NetworkManager.service", unit, re.M)
    assert f"-f {pathlib.Path('/etc/mtr/mtr-hotspot.nft')}" in unit


def test_laptops_are_offered_neither_a_route_nor_names(network):
    network.hotspot("Robot", "12345678")
    offered = network.folder / "disk" / "etc" / "NetworkManager" / "dnsmasq-shared.d" / "mtr-hotspot.conf"
    lines = offered.read_text(encoding="ascii").splitlines()
    assert {"port=0", "dhcp-option=option:router", "dhcp-option=option:dns-server"} <= set(lines)


def test_without_nft_no_access_point_is_begun(network):
    (network.folder / "nft").unlink()
    needed = ("bash", "cat", "dirname", "grep", "sed", "mkdir", "install", "mv", "od", "tr")
    for program in needed:
        (network.folder / program).symlink_to(shutil.which(program))
    done = network.hotspot("Robot", "12345678", path=str(network.folder))
    assert done.returncode == 2 and "install nftables" in done.stderr
    assert "connection up" not in network.told and not network.files()


# Laptop, robot and LiDAR have a network each; $RULES are those of the robot, $WIFI is its interface to the laptop.
FORWARDS = """
set -e
for name in laptop lidar; do ip netns add $name; done
trap 'for name in laptop lidar; do ip netns delete $name; done' EXIT
ip link add "$WIFI" type veth peer name eth0 netns laptop
ip link add lan0 type veth peer name eth0 netns lidar
ip address add 10.42.0.1/24 dev "$WIFI" && ip link set "$WIFI" up
ip address add 192.168.131.1/24 dev lan0 && ip link set lan0 up
ip -n laptop address add 10.42.0.9/24 dev eth0 && ip -n laptop link set eth0 up
ip -n lidar address add 192.168.131.20/24 dev eth0 && ip -n lidar link set eth0 up
ip -n laptop route add default via 10.42.0.1 && ip -n lidar route add default via 192.168.131.1
echo 1 >/proc/sys/net/ipv4/ip_forward
nft -f "$RULES" && nft -f "$RULES"
nft -f - <<<'table ip shared { chain forward { type filter hook forward priority 0; policy accept; accept; }; }'
# A port on which nobody listens refuses at once where the way is open.
try() {
  local status=0
  ip netns exec "$1" timeout 2 bash -c "</dev/tcp/$2/9" 2>/dev/null || status=$?
  [[ $status == 124 ]] && echo "$1 does not reach $2" || echo "$1 reaches $2"
}
try laptop 10.42.0.1
try laptop 192.168.131.20
try lidar 10.42.0.9
"""


def reached(wifi):
    """Who reaches whom, in a network namespace of its own; skips where this machine cannot make one."""
    if not all(map(shutil.which, ("nft", "ip", "unshare"))):
        pytest.skip("nft, ip or unshare is missing")
    script = f"mount -t tmpfs none /run && mkdir -p /run/netns && {FORWARDS}"
    done = subprocess.run(["unshare", "--net", "--mount", "bash", "-c", script], text=True, capture_output=True,
                          check=False, env=dict(os.environ, RULES=str(HERE / "mtr-hotspot.nft"), WIFI=wifi))
    if done.returncode and "reach" not in done.stdout:
        pytest.skip(f"no network namespaces: {done.stderr.strip()}")
    return done.stdout.splitlines()


@pytest.mark.parametrize("wifi", ["wlan0", "wlp2s0", "wlx00c0ca"])
def test_laptop_in_the_wifi_reaches_the_robot_and_not_the_lidar(wifi):
    assert reached(wifi) == ["laptop reaches 10.42.0.1", "laptop does not reach 192.168.131.20",
                                       "lidar does not reach 10.42.0.9"]


def test_rules_leave_other_networks_alone():
    # Shows that the robot would forward, and that the case above can fail.
    assert "laptop reaches 192.168.131.20" in reached("eth9")
