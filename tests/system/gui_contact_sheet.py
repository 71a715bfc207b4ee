"""All pictures of a theme beside each other on one sheet, to be looked at in one go."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
from typing import List

from PyQt5.QtCore import QRect, Qt
from PyQt5.QtGui import QColor, QImage, QPainter

_COLUMNS, _WIDTH, _TEXT = 4, 560, 24
# As high as the pictures of the squarest screen become at that width.
_HEIGHT = 384


def contact_sheet(pictures: List[pathlib.Path], path: pathlib.Path) -> None:
    """Write the sheet; each picture with its name below, as large as there is room."""
    rows = max(math.ceil(len(pictures) / _COLUMNS), 1)
    sheet = QImage(_COLUMNS * _WIDTH, rows * (_HEIGHT + _TEXT), QImage.Format_RGB32)
    sheet.fill(QColor("white"))
    painter = QPainter(sheet)
    for index, picture in enumerate(pictures):
        left, top = index % _COLUMNS * _WIDTH, index // _COLUMNS * (_HEIGHT + _TEXT)
        image = QImage(str(picture)).scaled(_WIDTH - 8, _HEIGHT, Qt.KeepAspectRatio, Qt.SmoothTransformation)
        painter.drawImage(left, top, image)
        painter.drawText(QRect(left, top + _HEIGHT, _WIDTH, _TEXT), Qt.AlignLeft | Qt.AlignVCenter, picture.stem)
    painter.end()
    sheet.save(str(path))
