"""Identity and signatures on the pages of a protocol."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from mtr_operator.domain.identity.identity import Identity
from mtr_operator.report.identity.identity_rows import identity_rows
from mtr_operator.report.identity.signature import DATE, SIGNATURE, signatories

from ..i18n import decimal_sign, translate
from ..names import domain_word, identity_title
from .protocol_picture import Protocol
from .protocol_tables import WHOLE, Row, sentence_rows, table_row

_COLUMNS = ((0.2, False), (0.8, False))
_SIGN_COLUMNS = ((0.4, False), (0.2, False), (0.4, False))
# Above a line there is room for a signature.
_SIGN_ROWS = 2
# Letters of a value in one row.
_LONGEST = 120


def subtitle(identity: Identity | None) -> str:
    """Whose car and key, and who measured, in one line."""
    if identity is None:
        return ""
    car = " ".join(filter(None, (identity.car_model, identity.car_vin)))
    return ", ".join(filter(None, (car, identity.key_serial, identity.operator)))


def identity_table(protocol: Protocol) -> list[Row]:
    """Everything that is known of car, key and people; nothing where nothing is."""
    known = identity_rows(protocol.progress.identity)
    if not known:
        return []
    rows = [table_row((translate("Protocol", "Identity"),), WHOLE, is_head=True)]
    before = ""
    for title, value in known:
        shown = value.replace(".", decimal_sign()) if title == "Key's battery" else value
        for text in (each.cells[0][0] for each in sentence_rows(shown, _LONGEST)):
            rows.append(table_row((identity_title(title) if title != before else "", text), _COLUMNS))
            before = title
    return [*rows, table_row((), WHOLE)]


def signed(pages: list[list[Row]], protocol: Protocol, size: int) -> list[list[Row]]:
    """Pages of at most so many rows with the signatures at the end of the last one, or on one of their own."""
    block: list[Row] = []
    for signatory in signatories(protocol.progress.identity):
        block += _SIGN_ROWS * [table_row((), WHOLE)]
        words: Sequence[str] = (domain_word(signatory.role), domain_word(DATE), domain_word(SIGNATURE))
        block += [Row(table_row((signatory.name, "", ""), _SIGN_COLUMNS).cells, is_signed=True),
                  table_row(words, _SIGN_COLUMNS)]
    if pages and len(pages[-1]) + len(block) <= size:
        return [*pages[:-1], pages[-1] + block]
    return [*pages, block]
