"""Creates a new test from the Operator's selection, which is remembered for the next one."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime

from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.domain.verdict.suitability import check_before_start
from mtr_operator.storage.given_files import Given, GivenPaths
from mtr_operator.storage.identity_file import GivenIdentity

from ..connection import Connection
from ..identity_entry import check_begin, remembering
from ..settings_file import SettingsStore
from ..test import Test, new_test


def begun_test(store: SettingsStore, connection: Connection, scenario: AnyScenario, parameters: ScenarioParameters,
               *, paths: GivenPaths, who: GivenIdentity) -> Test:
    """Return the new test; OperatorError if a selected file no longer matches it, or the laboratory requires more."""
    check_begin(store, who)
    given = Given(*paths)
    if given.limits is not None:
        check_before_start(given.limits, scenario, parameters)
    settings = store.settings.with_parameters(scenario.name, parameters.to_mapping())
    settings = settings.with_given(scenario.name, paths)
    store.change(remembering(settings, who.identity, datetime.date.today()))
    return new_test(scenario, parameters, settings.progress_folder, connection, given, who=who)
