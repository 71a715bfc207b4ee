"""Moving figures on a site: what the LiDARs measure of them, and detection of contact."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math

import numpy as np
import pytest

from mtr_core.errors import ConfigurationError
from mtr_core.schedule import SIMULATION_START_NS
from mtr_core.se2 import Pose2
from mtr_simulation.sim import Sim
from mtr_simulation.site.figures import BODIES, FIGURES, figure_named
from mtr_simulation.site.scenario import Scenario
from mtr_simulation.site.scenario_file import chosen_scenario
from mtr_simulation.site.surroundings import Walk

FAR_AWAY = Pose2(60.0, 0.0, 0.0)
OPEN = Scenario(world_from_car=FAR_AWAY, start_in_car=FAR_AWAY.inverse(), start_offset_m=0.0, start_offset_rad=0.0)
# Distance ahead of the front LiDAR.
AHEAD_M = 2.0


def sim_with(figure, stands_s):
    """A figure ahead of the robot that stands for a while and then walks straight towards it."""
    return Sim(1, dataclasses.replace(OPEN, person=Walk((AHEAD_M, 0.0), (-5.0, 0.0), 1.6, stands_s, figure)))


def seen(figure):
    """Points measured by the front LiDAR, in its frame."""
    sim = sim_with(figure, 60.0)
    scan = next(each for each in (sim.step().front_scan for _ in range(8)) if each is not None)
    angles = scan.angle_min_rad + scan.angle_increment_rad * np.arange(len(scan.ranges_m))
    # Nearer returns are the robot's own mast, farther ones the Car.
    is_near = (np.asarray(scan.ranges_m) > 0.6) & (np.asarray(scan.ranges_m) < 4.0)
    return np.stack([scan.ranges_m * np.cos(angles), scan.ranges_m * np.sin(angles)], axis=1)[is_near]


@pytest.mark.parametrize("figure", sorted(FIGURES))
def test_figure_is_seen_as_wide_as_it_is(figure):
    places = seen(figure)
    if figure == "lying":
        assert len(places) == 0, "0.2 m is below the plane of 0.3 m"
        return
    size_m = math.dist(places.min(axis=0), places.max(axis=0))
    assert (size_m > 0.5) == (figure in ("pair", "pram", "wheelchair")), size_m


@pytest.mark.parametrize("figure", sorted(FIGURES))
def test_touch_of_a_figure_is_one_of_its_bodies(figure):
    sim = sim_with(figure, 0.0)
    sim.scans_wanted = False
    touched = set()
    while not touched and sim.time_ns < SIMULATION_START_NS + 2_000_000_000:
        sim.step()
        touched = sim.contacts() - {"world"}
    assert touched and touched <= BODIES


def test_unknown_figure_is_refused_with_those_that_there_are(tmp_path):
    with pytest.raises(ConfigurationError, match="figure is 'tank'; allowed is person, pair, wheelchair"):
        figure_named("tank")
    for text in ("tank", "[person]", "3"):
        path = tmp_path / "site.yaml"
        path.write_text(f"person: {{start: [0, 5], end: [0, 9], figure: {text}}}", encoding="utf-8")
        with pytest.raises(ConfigurationError, match="Entry person.figure is .*; allowed is person, pair"):
            chosen_scenario(str(path))


def test_site_file_names_a_figure(tmp_path):
    path = tmp_path / "site.yaml"
    path.write_text("person: {start: [0, 5], end: [0, 9], figure: wheelchair}", encoding="utf-8")
    assert chosen_scenario(str(path)).person == Walk((0.0, 5.0), (0.0, 9.0), figure="wheelchair")
