"""All results of the benchmark: figures for the file, rows of the table, and sentences about failures."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import asdict
from typing import Any, Dict, List, Optional, Sequence

from ..harness.report import BenchmarkReport
from .drives.selection import CAMPAIGN, KIDNAP, PLAIN, SCENES
from .judging import campaign, kidnapping, position_rows
from .judging.figures import scene_figures
from .methods.outcome import METHODS, THIS_SYSTEM, MethodOutcome
from .one_drive import DriveResult
from .real_time import RealTimeFigures

ABOUT = {
    "key position": "distance in m of the key (0.25 m ahead of base_link) in the Car's frame as measured from where it "
                    "truly is in the true Car's frame; the error of the Car's pose is in it",
    "online": "each 20 ms from 3.5 s after the end of the loop on; standstill: while the robot stands",
    "odometry_gyro, mrpt_icp": "are given the Car by the best fit of their loop to the truth; this_system locates it",
    "length_error_m, width_error_m": "95 % of the absolute errors of what was measured against the Car in the LiDAR's "
                                     "plane; _body: of what was published, the data sheet's size where the plane is "
                                     "below the widest line, against the widest parts; only drives in which the plane "
                                     "meets the body",
    "nees_ratio": "mean normalised squared error of the pose in the Car's frame by 3; 1 is honest, above is too sure",
}


PER_DRIVE = ("online_rmse_m", "online_p95_m", "online_max_m", "moving_p95_m", "standstill_p95_m", "yaw_p95_deg",
             "nees_ratio", "cpu_ms_per_scan", "unknown_share")


def report(results: Sequence[DriveResult], real_time: Optional[RealTimeFigures]) -> BenchmarkReport:
    """Everything that goes into localization.json; real_time is None if it was not measured."""
    campaigns = [campaign.figures(each.errors) for each in outcomes_in(results, CAMPAIGN)]
    kidnapped = kidnapping.figures([kidnapping.kidnapping(each.outcomes[THIS_SYSTEM].errors, each.segments)
                                    for each in results if each.drive.variant == KIDNAP
                                    and THIS_SYSTEM in each.outcomes])
    found, failed = outcomes_of(results), failures(results)
    rows = position_rows.rows(found, failed)
    rows += [row for each in campaigns for row in campaign.rows(each)]
    rows += kidnapping.rows(kidnapped, sum(position_rows.failed(failed, scene, KIDNAP) for scene in SCENES))
    rows += real_time.rows() if real_time else []
    figures = {
        "about": ABOUT,
        "scenes": {scene: {method: asdict(scene_figures(plain_outcomes(results, scene, method)))
                           for method in METHODS} for scene in SCENES},
        "variants": position_rows.variants(found),
        "campaign": [asdict(each) for each in campaigns],
        "kidnapped": asdict(kidnapped),
        "real_time": real_time.as_json() if real_time else {},
        "failures": failed,
        "drives": [drive_figures(each) for each in results],
    }
    remarks = [f"{name}, {method}: {sentence}" for name, sentences in failed.items()
               for method, sentence in sentences.items()]
    return BenchmarkReport(rows, figures, remarks)


def outcomes_in(results: Sequence[DriveResult], variant: str) -> List[MethodOutcome]:
    """This system's outcomes in all drives of a variant."""
    return [each.outcomes[THIS_SYSTEM] for each in results
            if each.drive.variant == variant and THIS_SYSTEM in each.outcomes]


def outcomes_of(results: Sequence[DriveResult]) -> position_rows.Outcomes:
    """This system's outcomes by scene, variant and seed."""
    found: position_rows.Outcomes = {scene: {} for scene in SCENES}
    for each in results:
        if THIS_SYSTEM in each.outcomes:
            of_variant = found[each.drive.options.scene].setdefault(each.drive.variant, {})
            of_variant[each.drive.options.seed] = each.outcomes[THIS_SYSTEM]
    return found


def plain_outcomes(results: Sequence[DriveResult], scene: str, method: str) -> List[MethodOutcome]:
    """One method's outcomes in a scene's plain drives."""
    return [each.outcomes[method] for each in results
            if each.drive.options.scene == scene and each.drive.variant == PLAIN and method in each.outcomes]


def failures(results: Sequence[DriveResult]) -> position_rows.Failures:
    """Sentences of what failed, by drive and method."""
    return {each.drive.name: each.failures for each in results if each.failures}


def drive_figures(result: DriveResult) -> Dict[str, Any]:
    """What one drive was and gave, to find out where an error comes from."""
    options = result.drive.options
    return {"name": result.drive.name, "car": options.car, "lidar_height_m": options.lidar_height_m,
            "person": options.person, "failures": result.failures,
            **{method: method_figures(outcome) for method, outcome in result.outcomes.items()}}


def method_figures(outcome: MethodOutcome) -> Dict[str, Any]:
    """What one method made of one drive."""
    found = asdict(scene_figures([outcome]))
    return {**{name: found[name] for name in PER_DRIVE}, "car": asdict(outcome.car) if outcome.car else {}}
