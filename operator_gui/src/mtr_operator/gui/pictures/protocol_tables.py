"""Further pages of a protocol: minimum, mean and maximum per side, every line, and the course of the test."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Iterator, Sequence, Tuple

from PyQt5.QtCore import QPointF, QRectF, Qt
from PyQt5.QtGui import QColor

from mtr_operator.domain.results.figure import Kind
from mtr_operator.domain.results.line_result import has_intervals
from mtr_operator.domain.verdict.verdict import Verdict
from mtr_operator.report.figures import INTERVAL, figures_of, meanings
from mtr_operator.report.side_summary import SideSummary, side_summaries

from ..figure_text import cell_text, interval_text, sigma_heading, sigma_text
from ..i18n import translate
from ..names import domain_word
from ..sentences import translated
from ..theme.palette import LIGHT
from .layers.layer import Canvas
from .protocol_picture import Protocol

ROW, TEXT_PX = 19.0, 12.5
_LONGEST = 150
# Part of the width, and whether it holds figures.
Columns = Sequence[Tuple[float, bool]]
_SIDE_COLUMNS = ((0.2, False), (0.08, True), (0.17, True), (0.17, True), (0.17, True), (0.1, True), (0.11, True))
WHOLE = ((1.0, False),)
_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter


@dataclass(frozen=True)
class Row:
    """One row of a page: cells with the parts of the width that they take, each with its alignment.

    is_head: bold, with a line below. is_signed: a line below each cell, to write on.
    """

    cells: tuple[tuple[str, float, bool], ...]
    is_head: bool = False
    is_signed: bool = False


def table_rows(protocol: Protocol) -> list[Row]:
    """All rows of the further pages."""
    return [*_sides(protocol), *_lines(protocol), *_history(protocol)]


def pages_of(rows: Sequence[Row], size: int) -> list[list[Row]]:
    """Rows in pages of at most so many; no page ends with a heading, and none begins with an empty row."""
    pages: list[list[Row]] = [[]]
    for row in rows:
        if len(pages[-1]) == size:
            last = pages[-1]
            pages.append([last.pop()] if last[-1].is_head and size > 1 else [])
        if row.cells or pages[-1]:
            pages[-1].append(row)
    return pages


def paint_rows(canvas: Canvas, rows: Sequence[Row], area: QRectF) -> None:
    """Paint rows below each other."""
    painter, top = canvas.painter, area.top()
    for row in rows:
        painter.setFont(canvas.font(TEXT_PX, row.is_head))
        painter.setPen(QColor(LIGHT.ink))
        left = area.left()
        for text, part, is_right in row.cells:
            width = part * area.width()
            painter.drawText(QRectF(left, top, width - 6.0, ROW), _RIGHT if is_right else _LEFT, text)
            if row.is_signed:
                painter.drawLine(QPointF(left, top + ROW), QPointF(left + width - 18.0, top + ROW))
            left += width
        if row.is_head:
            painter.setPen(QColor(LIGHT.border))
            painter.drawLine(QPointF(area.left(), top + ROW), QPointF(area.right(), top + ROW))
        top += ROW


def _sides(protocol: Protocol) -> Iterator[Row]:
    judgement = protocol.assessment.judgement
    summaries = side_summaries(protocol.scenario, protocol.parameters, protocol.progress, judgement)
    for word in dict.fromkeys(summary.word for summary in summaries):
        headings = (domain_word(word).capitalize(), translate("Protocol", "Lines"),
                    translate("Protocol", "Minimum [m]"), translate("Protocol", "Mean [m]"),
                    translate("Protocol", "Maximum [m]"), translate("Protocol", "Worst line"),
                    "" if judgement is None else domain_word("verdict").capitalize())
        yield table_row(headings, _SIDE_COLUMNS, is_head=True)
        for summary in summaries:
            if summary.word == word:
                yield table_row(_side_cells(summary), _SIDE_COLUMNS)
        yield table_row((), WHOLE)


def _side_cells(summary: SideSummary) -> tuple[str, ...]:
    figures = (cell_text(figure) if figure.kind is not Kind.NOT_REACHED else "\N{EN DASH}"
               for figure in (summary.minimum, summary.mean, summary.maximum))
    verdict = "" if summary.verdict is Verdict.NOT_SET else domain_word(summary.verdict.word)
    return (domain_word(summary.side), str(summary.count), *figures,
            "" if summary.worst_line is None else str(summary.worst_line), verdict)


def _lines(protocol: Protocol) -> Iterator[Row]:
    results, words = protocol.progress.results, protocol.scenario.distance_words
    judgement, shows_intervals = protocol.assessment.judgement, has_intervals(protocol.progress.results)
    per_word = ((0.15, True), (0.09, True), *(((0.15, True),) if shows_intervals else ()))
    columns = ((0.05, False), (0.13, False), *(per_word * len(words)), (0.12, True))
    heads: list[str] = ["#", domain_word(protocol.scenario.line_word).capitalize()]
    for word in words:
        heads += [f"{domain_word(word).capitalize()} [m]", sigma_heading(results),
                  *([f"{INTERVAL} [m]"] if shows_intervals else [])]
    yield table_row((*heads, "" if judgement is None else domain_word("verdict").capitalize()), columns, is_head=True)
    for result in results:
        cells = [str(result.number), domain_word(result.place)]
        for distance, figure in zip(result.distances, figures_of(protocol.scenario, protocol.parameters, result)):
            cells += [cell_text(figure, distance.uncertainty_m), sigma_text(distance.uncertainty_m),
                      *([interval_text(distance)] if shows_intervals else [])]
        verdict = "" if judgement is None else domain_word(judgement.of_line(result.number).word.replace("_", " "))
        yield table_row((*cells, verdict), columns)
    for result in results:
        for finding in result.findings:
            yield from sentence_rows(f"{result.number} ({domain_word(result.place)}): {translated(finding)}")
    for sentence in meanings(results):
        yield from sentence_rows(translated(sentence))
    yield table_row((), WHOLE)


def _history(protocol: Protocol) -> Iterator[Row]:
    """Interruptions, frames and checks, and why lines are invalid."""
    progress = protocol.progress
    rows = [f"{domain_word(protocol.scenario.line_word)} {result.number}: {translated(result.reason)}"
            for result in progress.results if result.reason]
    rows += [f"{domain_word(name)}: {translated(value)}" for name, value in progress.session.items()
             if name not in ("units", "coordinates")]
    rows += list(progress.frame_record.sentences())
    yield table_row((translate("Protocol", "Course of the test"),), WHOLE, is_head=True)
    for text in rows:
        yield from sentence_rows(text)


def sentence_rows(text: str, longest: int = _LONGEST) -> Iterator[Row]:
    """A sentence in as many rows of so many letters as it takes."""
    words, line = text.split(), ""
    for word in words:
        if line and len(line) + 1 + len(word) > longest:
            yield table_row((line,), WHOLE)
            line = ""
        line = f"{line} {word}".strip()
    yield table_row((line,), WHOLE)


def table_row(texts: Sequence[str], columns: Columns, is_head: bool = False) -> Row:
    """A row of texts in these columns."""
    return Row(tuple((text, part, is_right) for text, (part, is_right) in zip(texts, columns)), is_head)
