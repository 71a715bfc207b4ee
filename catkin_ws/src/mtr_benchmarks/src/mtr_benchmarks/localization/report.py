"""Collects all results of the benchmark: figures for the file, rows of the table, and sentences about failures."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import asdict
from typing import Any, Dict, List, Optional, Sequence

from ..harness.report import BenchmarkReport
from ..harness.rows import Row
from .drives.selection import ABDUCT, ANY_CAR, CAMPAIGN, KIDNAP, PLAIN, SCENES
from .judging import abduction, any_car, campaign, consistency, kidnapping, lidar_kinds, position_rows
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
ABOUT_ABDUCTED = {
    "wrong": "the key is off by more than 0.1 m and by more than 4 sigma in the error's direction; counted from 2 s on",
    "knew_before": "right and valid before it was carried away; a robot that was lost already proves nothing",
    "vague": "valid and more than 0.1 m off at 10 s, whatever its sigma: neither right nor lost",
    "key": "as published, frame map laid on the truth by the adjusted key frames: the Car locator has no part in it",
    "repeats": "drives that touched something or gave no map, and were made again with another seed",
}
ABOUT_ANY_CAR = {
    "right": "centre, length and width as published are off by at most 3 cm or 3 of their own sigmas, the heading by "
             "0.5 deg or 3 of its own",
    "close": "the same within 3 cm and 0.5 deg, whatever the sigmas are",
    "asked": "there is no map, or the Car locator publishes nothing and says why",
}

PER_DRIVE = ("online_rmse_m", "online_p95_m", "online_max_m", "moving_p95_m", "standstill_p95_m", "yaw_p95_deg",
             "nees_ratio", "cpu_ms_per_scan", "unknown_share")


def report(results: Sequence[DriveResult], real_time: Optional[RealTimeFigures]) -> BenchmarkReport:
    """Return the content of localization.json. real_time is None if it was not measured."""
    campaigns = [campaign.figures(each.errors) for each in outcomes_in(results, CAMPAIGN)]
    kidnapped = kidnapping.figures([kidnapping.kidnapping(each.outcomes[THIS_SYSTEM].errors, each.segments)
                                    for each in results if each.drive.variant == KIDNAP
                                    and THIS_SYSTEM in each.outcomes])
    found, failed = outcomes_of(results), failures(results)
    rows = position_rows.rows(found, failed) + consistency.rows(found, failed) + lidar_kinds.rows(found, failed)
    rows += [row for each in campaigns for row in campaign.rows(each)]
    rows += kidnapping.rows(kidnapped, sum(position_rows.failed(failed, scene, KIDNAP) for scene in SCENES))
    rows += abduction_rows(results) + any_car_rows(results)
    rows += real_time.rows() if real_time else []
    figures = {
        "about": ABOUT,
        "scenes": {scene: {method: asdict(scene_figures(plain_outcomes(results, scene, method)))
                           for method in METHODS} for scene in SCENES},
        "variants": position_rows.variants(found),
        "consistency": consistency.figures(found),
        "campaign": [asdict(each) for each in campaigns],
        "kidnapped": asdict(kidnapped),
        "abducted": abducted_figures(results),
        "any_car": any_car_figures(results),
        "real_time": real_time.as_json() if real_time else {},
        "failures": failed,
        "drives": [drive_figures(each) for each in results if each.drive.variant not in (ABDUCT, ANY_CAR)],
    }
    return BenchmarkReport(rows, figures, remarks(results))


def abduction_report(results: Sequence[DriveResult]) -> BenchmarkReport:
    """Return the content of abductions.json."""
    figures = {"abducted": abducted_figures(results), "failures": failures(results)}
    return BenchmarkReport(abduction_rows(results), figures, remarks(results))


def any_car_report(results: Sequence[DriveResult]) -> BenchmarkReport:
    """Return the content of any_car.json."""
    figures = {"any_car": any_car_figures(results), "failures": failures(results)}
    return BenchmarkReport(any_car_rows(results), figures, remarks(results))


def any_car_rows(results: Sequence[DriveResult]) -> List[Row]:
    """Return the rows of the random Cars."""
    mine = [each for each in results if each.drive.variant == ANY_CAR]
    return any_car.rows([each.car for each in mine if each.car], sum(bool(each.failures) for each in mine),
                        sum(len(each.repeats) for each in mine))


def any_car_figures(results: Sequence[DriveResult]) -> Dict[str, Any]:
    """Return each random Car with its properties and its result."""
    return {"about": ABOUT_ANY_CAR, "cars": [{"name": each.drive.name, **asdict(each.car)} for each in results
                                             if each.car]}


def abduction_rows(results: Sequence[DriveResult]) -> List[Row]:
    """Return the rows of the robots that were carried away while they drove."""
    missing = sum(position_rows.failed(failures(results), scene, ABDUCT) for scene in SCENES)
    return abduction.rows(abducted(results), missing)


def abducted(results: Sequence[DriveResult], scene: str = "") -> abduction.AbductionFigures:
    """Return the figures of the robots that were carried away while they drove, in one scene or in all."""
    mine = [each for each in results if each.drive.variant == ABDUCT and scene in ("", each.drive.options.scene)]
    return abduction.figures([each.fate for each in mine if each.fate], sum(len(each.repeats) for each in mine))


def abducted_figures(results: Sequence[DriveResult]) -> Dict[str, Any]:
    """Return the figures of all drives, by scene, and of each robot."""
    robots = [{"name": each.drive.name, "seed": each.drive.options.seed, "car": each.drive.options.car,
               "lidar_height_m": each.drive.options.lidar_height_m, "person": each.drive.options.person,
               **asdict(each.fate)} for each in results if each.fate]
    return {"about": ABOUT_ABDUCTED, "all": asdict(abducted(results)),
            "scenes": {scene: asdict(abducted(results, scene)) for scene in SCENES}, "robots": robots,
            "repeats": [sentence for each in results for sentence in each.repeats]}


def remarks(results: Sequence[DriveResult]) -> List[str]:
    """Return the sentences below the table: failures, robots with wrong valid poses, and repeated drives."""
    said = [f"{name}, {method}: {sentence}" for name, sentences in failures(results).items()
            for method, sentence in sentences.items()]
    said += [f"{each.drive.name}: {abduction.sentence(each.fate)}" for each in results
             if each.fate and each.fate.first_wrong]
    said += [f"{each.drive.name}: {each.car.verdict}: {each.car.sentence}" for each in results
             if each.car and each.car.verdict != any_car.RIGHT]
    return said + [f"Repeated: {sentence}" for each in results for sentence in each.repeats]


def outcomes_in(results: Sequence[DriveResult], variant: str) -> List[MethodOutcome]:
    """Return this system's outcomes in all drives of a variant."""
    return [each.outcomes[THIS_SYSTEM] for each in results
            if each.drive.variant == variant and THIS_SYSTEM in each.outcomes]


def outcomes_of(results: Sequence[DriveResult]) -> position_rows.Outcomes:
    """Return this system's outcomes by scene, variant and seed."""
    found: position_rows.Outcomes = {scene: {} for scene in SCENES}
    for each in results:
        if THIS_SYSTEM in each.outcomes:
            of_variant = found[each.drive.options.scene].setdefault(each.drive.variant, {})
            of_variant[each.drive.options.seed] = each.outcomes[THIS_SYSTEM]
    return found


def plain_outcomes(results: Sequence[DriveResult], scene: str, method: str) -> List[MethodOutcome]:
    """Return one method's outcomes in a scene's plain drives."""
    return [each.outcomes[method] for each in results
            if each.drive.options.scene == scene and each.drive.variant == PLAIN and method in each.outcomes]


def failures(results: Sequence[DriveResult]) -> position_rows.Failures:
    """Return the failures as sentences, by drive and method."""
    return {each.drive.name: each.failures for each in results if each.failures}


def drive_figures(result: DriveResult) -> Dict[str, Any]:
    """Return properties and results of one drive, for finding the source of an error."""
    options = result.drive.options
    return {"name": result.drive.name, "car": options.car, "lidar_height_m": options.lidar_height_m,
            "person": options.person, "failures": result.failures,
            **{method: method_figures(outcome) for method, outcome in result.outcomes.items()}}


def method_figures(outcome: MethodOutcome) -> Dict[str, Any]:
    """Return the figures of one method in one drive."""
    found = asdict(scene_figures([outcome]))
    return {**{name: found[name] for name in PER_DRIVE}, "car": asdict(outcome.car) if outcome.car else {}}
