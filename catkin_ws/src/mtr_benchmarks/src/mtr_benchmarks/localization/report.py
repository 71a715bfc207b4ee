"""All results of the benchmark as one JSON document and as lines for a person."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Dict, List, Sequence

from . import campaign, kidnapping, real_time, table
from .drives import CAMPAIGN, KIDNAP, PLAIN, SCENES
from .figures import scene_figures
from .methods import METHODS, THIS_SYSTEM, Outcome
from .one_drive import DriveResult

ABOUT = {
    "key position": "distance in m of the key (0.25 m ahead of base_link) in the Car's frame as measured from where it "
                    "truly is in the true Car's frame; the error of the Car's pose is in it",
    "online": "each 20 ms from 3.5 s after the end of the loop on; standstill: while the robot stands",
    "odometry_gyro, mrpt_icp": "are told where the Car is, by the best fit of their loop to the truth; this_system "
                               "locates the Car itself",
    "length_error_m, width_error_m": "95 % of the absolute errors of what was measured against the Car in the LiDAR's "
                                     "plane; _body: of what was published, the data sheet's size where the plane is "
                                     "below the widest line, against the widest parts; only drives in which the plane "
                                     "meets the body",
    "nees_ratio": "mean normalised squared error of the pose in the Car's frame by 3; 1 is honest, above is too sure",
}


def document(results: Sequence[DriveResult], in_real_time: Dict[str, Any]) -> Dict[str, Any]:
    """Everything that goes into localization.json; in_real_time as `real_time` gives it, empty if it was not run."""
    found = outcomes_of(results)
    kidnapped = [kidnapping.kidnapping(each.outcomes[THIS_SYSTEM].errors, each.segments) for each in results
                 if each.drive.variant == KIDNAP and THIS_SYSTEM in each.outcomes]
    return {
        "about": ABOUT,
        "table": table.rows(found, failures(results)),
        "scenes": {scene: {method: scene_figures(plain_outcomes(results, scene, method)) for method in METHODS}
                   for scene in SCENES},
        "variants": table.variants(found),
        "campaign": [campaign.figures(each.outcomes[THIS_SYSTEM].errors) for each in results
                     if each.drive.variant == CAMPAIGN and THIS_SYSTEM in each.outcomes],
        "kidnapped": kidnapping.figures(kidnapped),
        "real_time": in_real_time,
        "failures": failures(results),
        "drives": [drive_figures(each) for each in results],
    }


def outcomes_of(results: Sequence[DriveResult]) -> table.Outcomes:
    """This system's outcomes by scene, variant and seed."""
    found: table.Outcomes = {scene: {} for scene in SCENES}
    for each in results:
        if THIS_SYSTEM in each.outcomes:
            of_variant = found[each.drive.options.scene].setdefault(each.drive.variant, {})
            of_variant[each.drive.options.seed] = each.outcomes[THIS_SYSTEM]
    return found


def plain_outcomes(results: Sequence[DriveResult], scene: str, method: str) -> List[Outcome]:
    """One method's outcomes in a scene's plain drives."""
    return [each.outcomes[method] for each in results
            if each.drive.options.scene == scene and each.drive.variant == PLAIN and method in each.outcomes]


def failures(results: Sequence[DriveResult]) -> Dict[str, Dict[str, str]]:
    """Sentences of what failed, by drive and method."""
    return {each.drive.name: each.failures for each in results if each.failures}


def drive_figures(result: DriveResult) -> Dict[str, Any]:
    """What one drive was and gave, to find out where an error comes from."""
    options = result.drive.options
    return {"name": result.drive.name, "car": options.car, "lidar_height_m": options.lidar_height_m,
            "person": options.person, "failures": result.failures,
            **{method: {**{name: value for name, value in scene_figures([outcome]).items() if name in PER_DRIVE},
                        "car": outcome.car} for method, outcome in result.outcomes.items()}}


PER_DRIVE = ("online_rmse_m", "online_p95_m", "online_max_m", "moving_p95_m", "standstill_p95_m", "yaw_p95_deg",
             "nees_ratio", "cpu_ms_per_scan", "unknown_share")


def lines(written: Dict[str, Any]) -> List[str]:
    """The table, and what has no row in it."""
    said = [table.printed(row) for row in written["table"]]
    said += [campaign.sentence(each) for each in written["campaign"]]
    if written["kidnapped"]["robots"]:
        said.append(kidnapping.sentence(written["kidnapped"]))
    if written["real_time"]:
        said.append(real_time.sentence(written["real_time"]))
    for name, sentences in written["failures"].items():
        said += [f"{name}, {method}: {sentence}" for method, sentence in sentences.items()]
    return said
