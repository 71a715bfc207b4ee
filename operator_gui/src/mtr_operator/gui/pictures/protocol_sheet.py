"""A protocol as a sheet: the picture with legend, result, parameters and circumstances; on further pages all tables."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QPointF, QRectF, Qt
from PyQt5.QtGui import QColor, QPainter

from mtr_operator.report.protocol_rows import (
    Row,
    assessment_rows,
    date_text,
    finding_rows,
    numbers_with_effect,
    session_rows,
    summary_rows,
)

from ..i18n import decimal_sign, translate
from ..names import choice_title, choice_word, domain_word, flag_title, parameter_title, scenario_title, yes_or_no
from ..sentences import translated
from ..theme.palette import LIGHT
from .identity_tables import identity_table, signed, subtitle
from .layers.layer import Canvas, paint_all
from .legend import ROW_PX, legend_texts, paint_entry
from .protocol_picture import Protocol, ProtocolPicture
from .protocol_tables import ROW, pages_of, paint_rows, table_rows
from .viewport import Viewport

# A4 landscape in units of a quarter of a millimetre, nearly those of a 96 dpi screen.
WIDTH, HEIGHT = 1188.0, 840.0
_MARGIN = 36.0
_PANEL = 380.0
_ROW = 18.0
_TEXT_PX = 12.5
_MAX_REASON = 90
# Of the further pages: their headline, and how many rows fit below it.
_HEAD = 40.0
_ROWS = int((HEIGHT - 2 * _MARGIN - _HEAD) // ROW)
_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
_WRAPPED = Qt.TextFlag.TextWordWrap | Qt.AlignmentFlag.AlignLeft


class ProtocolSheet:
    """Paints its pages on any painter whose window is WIDTH by HEIGHT, always in the light colours.

    Attributes: picture: the layers on the left of the first page. pages: how many there are.
    """

    def __init__(self, protocol: Protocol):
        self._protocol = protocol
        self._tables = signed(pages_of([*identity_table(protocol), *table_rows(protocol)], _ROWS), protocol, _ROWS)
        self.picture = ProtocolPicture(protocol, protocol.picture)
        self.pages = 1 + len(self._tables)

    def paint(self, painter: QPainter, page: int = 0) -> None:
        """Paint a page; the first one is 0."""
        if page == 0:
            self._paint_picture(painter)
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(QRectF(0, 0, WIDTH, HEIGHT), QColor(LIGHT.surface))
        canvas = Canvas(painter, Viewport(WIDTH, HEIGHT), LIGHT)
        area = QRectF(_MARGIN, _MARGIN, WIDTH - 2 * _MARGIN, HEIGHT - 2 * _MARGIN)
        painter.setFont(canvas.font(14.0, True))
        painter.setPen(QColor(LIGHT.ink))
        painter.drawText(QRectF(area.left(), area.top(), area.width(), _ROW + 2), _LEFT, self._title())
        painter.drawText(QRectF(area.left(), area.top(), area.width(), _ROW + 2), _RIGHT,
                         translate("Protocol", "page {page} of {count}").format(page=page + 1, count=self.pages))
        paint_rows(canvas, self._tables[page - 1], area.adjusted(0, _HEAD, 0, 0))

    def _title(self) -> str:
        protocol = self._protocol
        title = translate("Protocol", "{scenario} protocol").format(scenario=scenario_title(protocol.scenario))
        return f"{title}, {date_text(str(protocol.progress.session.get('started', '')))}"

    def _paint_picture(self, painter: QPainter) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(QRectF(0, 0, WIDTH, HEIGHT), QColor(LIGHT.surface))
        width, height = WIDTH - _PANEL - 3 * _MARGIN, HEIGHT - 2 * _MARGIN
        viewport = Viewport(width, height).fitted(
            [point for layer in self.picture.layers for point in layer.points()], 40.0)
        painter.save()
        painter.translate(_MARGIN, _MARGIN)
        painter.setClipRect(QRectF(0, 0, width, height))
        paint_all(self.picture.layers, Canvas(painter, viewport, LIGHT))
        painter.restore()
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QColor(LIGHT.border))
        painter.drawRect(QRectF(_MARGIN, _MARGIN, width, height))
        self._paint_panel(Canvas(painter, viewport, LIGHT), WIDTH - _PANEL - _MARGIN)

    def _paint_panel(self, canvas: Canvas, left: float) -> None:
        protocol, painter = self._protocol, canvas.painter
        progress = protocol.progress
        top = _MARGIN
        title = translate("Protocol", "{scenario} protocol").format(scenario=scenario_title(protocol.scenario))
        for text, pixels, is_bold in ((title, 24.0, True), (date_text(str(progress.session.get("started", ""))), 14.0,
                                                            False)):
            painter.setFont(canvas.font(pixels, is_bold))
            painter.setPen(QColor(LIGHT.ink))
            painter.drawText(QRectF(left, top, _PANEL, pixels + 8), _LEFT, text)
            top += pixels + 10
        who = subtitle(progress.identity)
        if who:
            painter.drawText(QRectF(left, top, _PANEL, _ROW), _LEFT,
                             painter.fontMetrics().elidedText(who, Qt.TextElideMode.ElideRight, round(_PANEL)))
            top += _ROW + 6
        painter.setFont(canvas.font(14.0))
        sets = protocol.picture.point_sets
        for index in range(len(legend_texts(sets))):
            paint_entry(canvas, sets, index, QPointF(left, top))
            top += ROW_PX
        top += 10
        for heading, rows in ((translate("Protocol", "Result"), self._result_rows()),
                              (translate("Protocol", "Parameters"), self._parameter_rows()),
                              (translate("Protocol", "Test"), self._session_rows())):
            top = _paint_table(canvas, heading, rows, (left, top)) + 12
        self._paint_reasons(canvas, left, top)

    def _result_rows(self) -> list[Row]:
        rows = summary_rows(self._protocol.scenario, self._protocol.progress)
        rows += assessment_rows(self._protocol.assessment)
        counted = [(domain_word(name), ", ".join(map(_count, value.split(", "))).replace(".", decimal_sign()))
                   for name, value in rows]
        return counted + [(domain_word(place), translated(finding))
                          for place, finding in finding_rows(self._protocol.progress)]

    def _parameter_rows(self) -> list[Row]:
        protocol = self._protocol
        stored = protocol.progress.parameters
        rows = [(choice_title(name), choice_word(stored.get(name, choice.default)))
                for name, choice in protocol.scenario.parameters_type.choices().items()]
        for name, declared, value in numbers_with_effect(protocol.scenario, protocol.progress):
            if value is not None:
                shown = declared.shown_text(value).replace(".", decimal_sign())
                rows.append((parameter_title(name, declared), shown))
        return rows + [(flag_title(name), yes_or_no(bool(stored.get(name))))
                       for name in protocol.scenario.parameters_type.flags()]

    def _session_rows(self) -> list[Row]:
        (car, size), *rows = session_rows(self._protocol.progress)
        return _in_words([(car, size.replace(".", decimal_sign())), *rows])

    def _paint_reasons(self, canvas: Canvas, left: float, top: float) -> None:
        canvas.painter.setFont(canvas.font(10.5))
        canvas.painter.setPen(QColor(LIGHT.invalid))
        for result in self._protocol.progress.results:
            if result.reason and top + 2 * _ROW < HEIGHT - _MARGIN:
                text = f"{result.number}: {translated(result.reason)}"
                if len(text) > _MAX_REASON:
                    text = text[:_MAX_REASON - 1] + "\N{HORIZONTAL ELLIPSIS}"
                canvas.painter.drawText(QRectF(left, top, _PANEL, 2 * _ROW), _WRAPPED, text)
                top += 2 * _ROW


def _in_words(rows: list[Row]) -> list[Row]:
    return [(domain_word(name), value) for name, value in rows]


def _count(part: str) -> str:
    """Such as "3 not reached", in the language in use."""
    count, _, words = part.partition(" ")
    return f"{count} {domain_word(words)}" if words and count.isdecimal() else domain_word(part)


def _paint_table(canvas: Canvas, heading: str, rows: list[Row], corner: tuple[float, float]) -> float:
    """Paint rows below each other; the height at which the table ends."""
    (left, top), painter = corner, canvas.painter
    painter.setFont(canvas.font(14.0, True))
    painter.setPen(QColor(LIGHT.ink))
    painter.drawText(QRectF(left, top, _PANEL, _ROW + 2), _LEFT, heading)
    top += _ROW + 4
    painter.setFont(canvas.font(_TEXT_PX))
    for name, value in rows:
        painter.setPen(QColor(LIGHT.ink_soft))
        painter.drawText(QRectF(left, top, _PANEL, _ROW), _LEFT, name)
        painter.setPen(QColor(LIGHT.ink))
        painter.drawText(QRectF(left, top, _PANEL, _ROW), _RIGHT, value)
        top += _ROW
    return top
