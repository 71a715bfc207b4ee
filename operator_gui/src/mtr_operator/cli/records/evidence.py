"""Commands that bundle a test's evidence, and verify bundles."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import pathlib

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import CAR_PROFILE
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.verdict.assessment import Assessment
from mtr_operator.report.assessed import assess
from mtr_operator.storage.progress_file import FILE_NAME, open_progress
from mtr_operator.terminal import show, show_error

from ..exit_codes import EXIT_CHANGED, EXIT_PASS


def bundle_test(options: argparse.Namespace) -> None:
    """Bundle a test that was measured earlier."""
    path = options.results / FILE_NAME if options.results.is_dir() else options.results
    scenario, parameters, progress = open_progress(path, SCENARIOS)
    if progress.car is None or not progress.results:
        raise OperatorError(f"The test in {path} has no measured line; there is nothing to bundle.")
    print(write_for(path, scenario, progress, assess(scenario, parameters, progress), options.out))


def write_for(path: pathlib.Path, scenario: AnyScenario, progress: Progress, assessment: Assessment | None,
              target: pathlib.Path | None = None) -> str:
    """Write the bundle of a test; return a sentence on it."""
    # The import needs a package that no other command needs.
    from mtr_operator.evidence.bundle import BundleWatch, bundle_path, write_bundle

    class Missing(BundleWatch):
        """Collects a line for each omitted file."""

        def __init__(self) -> None:
            self.lines: list[str] = []

        def left_out(self, name: str, reason: str) -> None:
            """See BundleWatch."""
            self.lines.append(f"without {name}: {reason}")

    place, missing = target or bundle_path(path), Missing()
    manifest = write_bundle(place, path, scenario, progress, assessment, profile=progress.session.get(CAR_PROFILE, ""),
                            watch=missing)
    return "\n".join([f"bundle {manifest.number} of {manifest.station} with {len(manifest.files)} files is in {place}; "
                      f"its key is {manifest.key}", *missing.lines])


def verify_bundles(options: argparse.Namespace) -> int:
    """Print the state, signer and date of each bundle; return the exit code."""
    from mtr_operator.evidence.verification import chain_problems, verify_bundle
    found = [verify_bundle(path) for path in options.bundles]
    for path, each in zip(options.bundles, found):
        for problem in each.problems:
            show_error(f"{path}: {problem}")
        manifest = each.manifest
        if manifest is not None and each.is_intact:
            show(f"{path}: intact, {len(manifest.files)} files; bundle {manifest.number} of {manifest.station}, "
                 f"signed {manifest.created} {_whose(manifest.key, options.key)}")
    problems = chain_problems(found)
    for problem in problems:
        show_error(problem)
    strange = [each for each in found if options.key and each.manifest is not None and each.manifest.key != options.key]
    return EXIT_PASS if all(each.is_intact for each in found) and not problems and not strange else EXIT_CHANGED


def _whose(key: str, wanted: str | None) -> str:
    if wanted is None:
        return f"with the key {key}: compare it with the station's"
    return "with the key that is wanted" if key == wanted else f"with ANOTHER key than is wanted, {key}"
