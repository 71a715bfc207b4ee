"""Wi-Fi of a robot that is a client and of one that is the access point, from the output of iw."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_commissioning.preflight.wifi import Station, access_points_in, own_stations, stations_in, wifi_finding

# Output of iw 5.4 and 5.19.
CLIENT = """phy#1
\tInterface wlx00c0
\t\tifindex 4
\t\twdev 0x100000001
\t\taddr 00:c0:ca:aa:bb:cc
\t\tssid laboratory
\t\ttype managed
\t\tchannel 1 (2412 MHz), width: 20 MHz, center1: 2412 MHz
\t\ttxpower 20.00 dBm
"""
ACCESS_POINT = """phy#0
\tUnnamed/non-netdev interface
\t\twdev 0x2
\t\taddr 12:00:00:00:00:01
\t\ttype P2P-device
\tInterface wlp2s0
\t\tifindex 3
\t\twdev 0x1
\t\taddr 12:00:00:00:00:00
\t\tssid type AP
\t\ttype AP
\t\tchannel 36 (5180 MHz), width: 20 MHz, center1: 5180 MHz
"""
STATIONS = """Station 12:34:56:78:9a:bc (on wlp2s0)
\tinactive time:\t1304 ms
\trx bytes:\t619400
\ttx failed:\t2
\tsignal:  \t-41 [-41, -55] dBm
\tsignal avg:\t-42 [-42, -54] dBm
\ttx bitrate:\t54.0 MBit/s
\tconnected time:\t340 seconds
Station aa:34:56:78:9a:bc (on wlp2s0)
\tinactive time:\t120 ms
\tsignal:  \t{level} dBm
Station bb:34:56:78:9a:bc (on wlp2s0)
\tinactive time:\t45000 ms
\tsignal:  \t-90 dBm
Station cc:34:56:78:9a:bc (on wlp2s0)
\tinactive time:\t5 ms
"""


def said(interfaces, stations=""):
    """Return the program iw of a computer; it is not installed if the interfaces are None."""
    return lambda command: {"iw dev": interfaces, "iw dev wlp2s0 station dump": stations}[" ".join(command)]


def test_interfaces_that_are_an_access_point():
    assert access_points_in(CLIENT + ACCESS_POINT) == access_points_in(ACCESS_POINT + CLIENT) == ["wlp2s0"]
    assert access_points_in(CLIENT) == access_points_in("") == access_points_in("command failed: no such device") == []


def test_stations_with_their_level_and_their_silence():
    assert stations_in(STATIONS.format(level=-56)) == [
        Station("12:34:56:78:9a:bc", 1.304, -41.0), Station("aa:34:56:78:9a:bc", 0.12, -56.0),
        Station("bb:34:56:78:9a:bc", 45.0, -90.0), Station("cc:34:56:78:9a:bc", 0.005, None)]
    assert stations_in("") == []


@pytest.mark.parametrize("interfaces", [None, "", CLIENT])
def test_robot_without_a_wifi_of_its_own_has_no_stations(interfaces):
    assert own_stations(said(interfaces)) is None


@pytest.mark.parametrize("level, is_bad", [(-56, False), (-75, False), (-76, True)])
def test_weakest_of_those_that_are_heard_now_is_judged(level, is_bad):
    finding = wifi_finding(None, own_stations(said(ACCESS_POINT, STATIONS.format(level=level))))
    assert finding.is_bad is is_bad and finding.value == level
    assert finding.text.startswith(f"The robot's own hears aa:34:56:78:9a:bc with {level} dBm, the weakest of 2")


@pytest.mark.parametrize("stations", ["", None, STATIONS.partition("Station bb")[0].replace("\t120 ms", "\t12000 ms")
                                      .replace("\t1304 ms", "\t13040 ms")])
def test_wifi_without_a_laptop_is_not_bad(stations):
    finding = wifi_finding(("wlan1", -80.0), own_stations(said(ACCESS_POINT, stations)))
    assert not finding.is_bad and finding.text == "The robot's own, in which no laptop is heard now."


@pytest.mark.parametrize("signal, is_bad, text", [
    (("wlan0", -56.0), False, "wlan0 receives -56 dBm."), (None, False, "No connection"),
    (("wlan0", -76.0), True, "wlan0 receives -76 dBm, at least -75 dBm are needed: bring the access point nearer")])
def test_weak_connection_is_bad_and_a_cable_is_not_judged(signal, is_bad, text):
    finding = wifi_finding(signal, None)
    assert finding.is_bad is is_bad and finding.text.startswith(text)
