"""A protocol sheet as content of a file: PNG, PDF or SVG."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QRectF, QSize
from PyQt5.QtGui import QImage, QPageLayout, QPageSize, QPainter, QPdfWriter
from PyQt5.QtSvg import QSvgGenerator

from .protocol_sheet import HEIGHT, WIDTH, ProtocolSheet

PNG_SCALE = 2
_PDF_DPI = 300


def png(sheet: ProtocolSheet) -> bytes:
    """The sheet as a bitmap."""
    image = QImage(QSize(PNG_SCALE * round(WIDTH), PNG_SCALE * round(HEIGHT)), QImage.Format.Format_RGB32)
    painter = QPainter(image)
    painter.scale(PNG_SCALE, PNG_SCALE)
    sheet.paint(painter)
    painter.end()
    with _Buffer() as buffer:
        image.save(buffer, "PNG")
        return buffer.content()


def pdf(sheet: ProtocolSheet) -> bytes:
    """The sheet as one page of A4 landscape."""
    with _Buffer() as buffer:
        writer = QPdfWriter(buffer)
        writer.setResolution(_PDF_DPI)
        page = QPageSize(QPageSize.PageSizeId.A4)
        writer.setPageLayout(QPageLayout(page, QPageLayout.Orientation.Landscape, QMarginsF()))
        painter = QPainter(writer)
        painter.scale(writer.width() / WIDTH, writer.height() / HEIGHT)
        sheet.paint(painter)
        painter.end()
        return buffer.content()


def svg(sheet: ProtocolSheet) -> bytes:
    """The sheet as scalable graphics."""
    with _Buffer() as buffer:
        generator = QSvgGenerator()
        generator.setOutputDevice(buffer)
        generator.setSize(QSize(round(WIDTH), round(HEIGHT)))
        generator.setViewBox(QRectF(0, 0, WIDTH, HEIGHT))
        painter = QPainter(generator)
        sheet.paint(painter)
        painter.end()
        return buffer.content()


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
