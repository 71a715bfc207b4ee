"""The settings screens: what may be typed, what is said about the rest, and the preview."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.gui.forms.parameter_form import ParameterForm

ALL = [(name, field) for name, scenario in SCENARIOS.items() for field in scenario.parameters_type.declarations()]


def usual(name):
    parameters_type = SCENARIOS[name].parameters_type
    return parameters_type.from_mapping(parameters_type.proposed())


@pytest.fixture
def form_of(qtbot):
    def make(name):
        form = ParameterForm(SCENARIOS[name].parameters_type)
        qtbot.addWidget(form)
        return form
    return make


@pytest.mark.parametrize("name", list(SCENARIOS))
def test_every_parameter_has_a_field_with_unit_range_default_and_tool_tip(form_of, name):
    form = form_of(name)
    declarations = SCENARIOS[name].parameters_type.declarations()
    assert list(form.fields) == list(declarations)
    for field, declared in zip(form.fields.values(), declarations.values()):
        assert declared.shown[0] in field.note.text()
        assert field.toolTip() == declared.doc
        assert field.edit.accessibleName()
    assert form.parameters == usual(name)


@pytest.mark.parametrize(("name", "field"), ALL)
@pytest.mark.parametrize("text", ["abc", "-1", "1e300", "nan", "1,2,3"])
def test_bad_text_is_told_at_the_field_with_the_range(form_of, name, field, text):
    form = form_of(name)
    declared = form.fields[field].declared
    if declared.only is not None:
        form.choices[declared.only[0]].show_word(declared.only[1])
    form.fields[field].edit.setText(text)
    fault = form.fields[field].fault
    if text == "-1" and declared.low <= -1.0:
        # A coordinate of the Car's frame lies to either side.
        assert not fault
        return
    assert "llowed" in fault
    assert " to " in fault
    assert form.parameters is None
    form.fields[field].edit.setText("")
    optional = SCENARIOS[name].parameters_type.declarations()[field].default is None
    assert form.fields[field].fault.startswith("Enter a value") is not optional


def test_comma_is_a_decimal_sign(form_of):
    form = form_of("autolock")
    form.fields["maximum_distance_m"].edit.setText("3,25")
    assert form.parameters.maximum_distance_m == 3.25


def test_centimetres_and_kilometres_per_hour_become_si(form_of):
    form = form_of("autolock")
    form.fields["key_height_m"].edit.setText("85")
    form.fields["maximum_speed_mps"].edit.setText("1.8")
    assert form.parameters.key_height_m == pytest.approx(0.85)
    assert form.parameters.maximum_speed_mps == pytest.approx(0.5)


@pytest.mark.parametrize("text", ["1.44; 0.36", "1,44;0,36", " 1.44 0.36 ", "1,44; 0,36;"])
def test_list_of_speeds_is_typed_with_semicolons_or_spaces(form_of, text):
    form = form_of("autolock")
    form.fields["passes"].edit.setText("2")
    form.fields["measuring_speeds_mps"].edit.setText(text)
    assert form.parameters.measuring_speeds_mps == pytest.approx((0.4, 0.1))
    again = form_of("autolock")
    again.show_mapping(form.parameters.to_mapping())
    assert again.fields["measuring_speeds_mps"].edit.text() == "1.44; 0.36"
    assert again.parameters == form.parameters


@pytest.mark.parametrize("text", ["1.44; x", "1.44; 9", "; ".join(9 * ["1"])])
def test_list_with_a_bad_number_or_too_many_is_told_at_the_field(form_of, text):
    form = form_of("autolock")
    form.fields["measuring_speeds_mps"].edit.setText(text)
    assert form.fields["measuring_speeds_mps"].fault
    assert form.parameters is None


def test_whole_number_is_asked_for(form_of):
    form = form_of("key_press")
    form.choices["method"].show_word("scan")
    form.fields["attempts"].edit.setText("2.5")
    assert form.fields["attempts"].fault.startswith("Only whole numbers")


@pytest.mark.parametrize(("name", "values", "part"), [
    ("autolock", {"minimum_distance_m": "5"}, "has to be below"),
    ("autolock", {"straightening_distance_m": "3.6"}, "has to be below"),
    ("autolock", {"minimum_distance_m": "0.1"}, "Clearance"),
    ("autolock", {"measuring_speed_mps": "7"}, " is 7 km/h; allowed is at most "),
    ("key_press", {"minimum_distance_m": "7"}, "at most"),
    ("key_press", {"straightening_distance_m": "4"}, "at most"),
])
def test_parameters_that_contradict_each_other_are_told(form_of, name, values, part):
    form = form_of(name)
    for field, text in values.items():
        form.fields[field].edit.setText(text)
    assert part in form.fault.text()
    assert form.parameters is None
    assert set(values) <= marked(form) and len(marked(form)) < len(form.fields)
    for field in values:
        form.fields[field].show_value(getattr(usual(name), field))
    assert marked(form) == set()


def marked(form):
    """Names of the fields that are framed as wrong."""
    return {name for name, field in form.fields.items() if field.edit.property("faulty")}


def test_fault_in_a_hidden_field_shows_it(form_of):
    form = form_of("autolock")
    assert not form.more.isChecked()
    form.fields["clearance_m"].edit.setText("x")
    assert form.more.isChecked()


def test_usual_values_come_back(form_of, qtbot):
    form = form_of("autolock")
    form.fields["maximum_distance_m"].edit.setText("9")
    form.usual.click()
    assert form.parameters == usual("autolock")


def test_new_key_press_test_searches_and_a_scan_can_be_chosen(form_of):
    form = form_of("key_press")
    assert form.parameters.method == "adaptive"
    form.choices["method"].show_word("scan")
    assert form.parameters.method == "scan"
    form.usual.click()
    assert form.parameters.method == "adaptive"


def test_fields_that_mean_nothing_with_the_method_are_hidden_and_hinder_nothing(form_of):
    form = form_of("key_press")
    assert form.fields["interval_m"].isVisibleTo(form) and not form.fields["approach_distance_m"].isVisibleTo(form)
    form.fields["interval_m"].edit.setText("x")
    assert form.parameters is None
    form.choices["method"].show_word("scan")
    assert form.parameters.method == "scan"
    assert form.fields["approach_distance_m"].isVisibleTo(form) and not form.fields["interval_m"].isVisibleTo(form)


def test_preview_shows_lines_duration_and_battery(operator, opener):
    screen = operator.choose("autolock")
    assert screen.notice.text().startswith("28 lines (axis), about 8 min.")
    assert "its size is a guess" in screen.notice.text()
    assert "at 80 %, suffices" in screen.notice.text()
    screen.form.fields["measurements_distance_m"].edit.setText("1")
    assert screen.notice.text().startswith("16 lines")
    opener.spoil_with(battery_percent=16)
    operator.wait(lambda: "may not suffice" in screen.notice.text())


def test_parameters_that_do_not_suit_the_car_are_told_before_the_start(operator):
    screen = operator.choose("key_press")
    screen.form.fields["minimum_distance_m"].edit.setText("2")
    assert "Remote key and Car" in screen.form.fault.text()
    assert not screen.start.isEnabled()
    assert screen.notice.text() == "No preview of the lines while the parameters are not right."
    assert marked(screen.form) == {"minimum_distance_m", "clearance_m"}
    screen.form.fields["minimum_distance_m"].edit.setText("3")
    assert marked(screen.form) == set()


def test_attempts_and_interval_are_told_before_the_start_with_what_an_interval_out_of_reach_takes(operator):
    screen = operator.choose("key_press")
    assert "Attempts on each line: " in screen.notice.text()
    assert "Expected 95 % interval: \N{PLUS-MINUS SIGN}0.25 to " in screen.notice.text()
    assert screen.caution.text() == ""
    screen.form.fields["attempts_limit"].edit.setText("8")
    assert screen.caution.text().startswith("8 presses on each radial reach an interval of ")
    assert "\N{LEFT DOUBLE QUOTATION MARK}Presses at most" in screen.caution.text()
    screen.form.choices["method"].show_word("scan")
    assert screen.caution.text() == "" and "Expected 95 % interval" not in screen.notice.text()
    assert "Attempts on each line: " in screen.notice.text()


def test_zone_map_tells_presses_and_coverage_before_the_start_and_what_an_interval_out_of_reach_takes(operator):
    screen = operator.choose("zone_map")
    screen.form.fields["presses_limit"].edit.setText("60")
    screen.form.fields["coverage_percent"].edit.setText("15")
    assert "Expected 95 % interval of the coverage: \N{PLUS-MINUS SIGN}15 %." in screen.notice.text()
    assert screen.caution.text() == ""
    screen.form.fields["presses_limit"].edit.setText("10")
    assert screen.caution.text().startswith("10 presses in each zone reach an interval of the coverage of ")


def test_speed_that_the_connected_cars_cycle_makes_meaningless_is_told_with_its_sigma(operator):
    screen = operator.choose("autolock")
    screen.form.fields["passes"].edit.setText("1")
    told = screen.caution.text()
    assert "km/h, with a message of the Car every 0.20 s, the distance of a pass has a sigma of " in told
    assert " Pass at " in told and "m/s" not in told


def test_used_parameters_are_remembered(operator, start):
    operator.begin("key_press", maximum_distance_m="6")
    operator.finish()
    application = start()
    stored = application.flow.store.settings.parameters["key_press"]
    assert (stored["maximum_distance_m"], stored["angle_between_radials_deg"]) == (6.0, 90.0)
    operator.click(operator.window.protocol.done)
    assert operator.choose("key_press").form.fields["maximum_distance_m"].text == "6"


def test_another_scenario_appears_by_itself(qtbot):
    from mtr_operator.domain.scenarios.key_press import KeyPress
    from mtr_operator.gui.screens.measurement_type import MeasurementTypeScreen

    class Trunk(KeyPress):
        """Open the trunk."""
        name, title = "trunk", "Trunk"
    screen = MeasurementTypeScreen({**SCENARIOS, "trunk": Trunk()})
    qtbot.addWidget(screen)
    assert [tile.title for tile in screen.tiles.values()] == [*(each.title for each in SCENARIOS.values()), "Trunk"]
    with qtbot.waitSignal(screen.chosen) as chosen:
        screen.tiles["trunk"].click()
    assert chosen.args == ["trunk"]
