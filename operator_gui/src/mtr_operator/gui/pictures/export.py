"""A protocol sheet as content of a file: PNG, PDF or SVG."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QRectF, QSize
from PyQt5.QtGui import QImage, QPageLayout, QPageSize, QPainter, QPdfWriter
from PyQt5.QtSvg import QSvgGenerator

from .protocol_sheet import HEIGHT, WIDTH, ProtocolSheet

PNG_SCALE = 2
# 2376 by 6720 pixels are 64 MB while they are painted.
_MAX_FINE_PAGES = 4
_PDF_DPI = 300


def png(sheet: ProtocolSheet) -> bytes:
    """The pages as a bitmap, one below the other; many of them are painted coarser."""
    scale = PNG_SCALE if sheet.pages <= _MAX_FINE_PAGES else 1
    image = QImage(QSize(scale * round(WIDTH), scale * round(HEIGHT) * sheet.pages), QImage.Format.Format_RGB32)
    painter = QPainter(image)
    painter.scale(scale, scale)
    _paint_below_each_other(sheet, painter)
    painter.end()
    with _Buffer() as buffer:
        image.save(buffer, "PNG")
        return buffer.content()


def pdf(sheet: ProtocolSheet) -> bytes:
    """The pages in A4 landscape."""
    with _Buffer() as buffer:
        writer = QPdfWriter(buffer)
        writer.setResolution(_PDF_DPI)
        paper = QPageSize(QPageSize.PageSizeId.A4)
        writer.setPageLayout(QPageLayout(paper, QPageLayout.Orientation.Landscape, QMarginsF()))
        painter = QPainter(writer)
        painter.scale(writer.width() / WIDTH, writer.height() / HEIGHT)
        for page in range(sheet.pages):
            if page:
                writer.newPage()
            sheet.paint(painter, page)
        painter.end()
        return buffer.content()


def svg(sheet: ProtocolSheet) -> bytes:
    """The pages as scalable graphics, one below the other."""
    with _Buffer() as buffer:
        generator = QSvgGenerator()
        generator.setOutputDevice(buffer)
        generator.setSize(QSize(round(WIDTH), round(HEIGHT) * sheet.pages))
        generator.setViewBox(QRectF(0, 0, WIDTH, HEIGHT * sheet.pages))
        painter = QPainter(generator)
        _paint_below_each_other(sheet, painter)
        painter.end()
        return buffer.content()


def _paint_below_each_other(sheet: ProtocolSheet, painter: QPainter) -> None:
    for page in range(sheet.pages):
        painter.save()
        painter.translate(0.0, HEIGHT * page)
        sheet.paint(painter, page)
        painter.restore()


class _Buffer(QBuffer):
    """A file in memory."""

    def __enter__(self) -> _Buffer:
        self.open(QIODevice.OpenModeFlag.WriteOnly)
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def content(self) -> bytes:
        """What was written."""
        return bytes(QByteArray(self.data()))
