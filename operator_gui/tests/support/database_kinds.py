"""Small CAN databases of each kind with repeated names and identifiers, for tests."""
# SPDX-License-Identifier: Apache-2.0
from typing import NamedTuple, Sequence, Tuple

PROFILE = "database: {}\nmessage: DOORS\nsignal: LOCK\nstates: {{1: locked, 2: unlocked}}\ncycle_time_s: 0.1\n"


class Frame(NamedTuple):
    """A message. signals: name, first bit and number of bits."""

    name: str
    identifier: int
    signals: Sequence[Tuple[str, int, int]]


def written(folder, suffix, text):
    """Path of a profile with its database."""
    (folder / f"car{suffix}").write_text(text)
    path = folder / "car.yaml"
    path.write_text(PROFILE.format(f"car{suffix}"))
    return str(path)


def dbc(frames):
    """The messages as a DBC file."""
    lines = ["BU_: A"]
    for frame in frames:
        lines += [f"BO_ {frame.identifier} {frame.name}: 8 A"]
        lines += [f' SG_ {name} : {start}|{length}@1+ (1,0) [0|0] "" A' for name, start, length in frame.signals]
    return "\n".join(lines) + "\n"


def kcd(*buses):
    """The messages of each bus as a KCD file."""
    text = '<NetworkDefinition xmlns="http://kayak.2codeornot2code.org/1.0"><Document name="x"/>'
    for number, frames in enumerate(buses):
        text += f'<Bus name="bus{number}">'
        for frame in frames:
            text += f'<Message id="{frame.identifier}" name="{frame.name}" length="8">'
            text += "".join(f'<Signal name="{name}" offset="{start}" length="{length}"/>'
                            for name, start, length in frame.signals) + "</Message>"
        text += "</Bus>"
    return text + "</NetworkDefinition>"


def sym(frames):
    """The messages as a SYM file."""
    text = 'FormatVersion=6.0 // Do not edit this line!\nTitle="x"\n\n{SENDRECEIVE}\n'
    for frame in frames:
        text += f"\n[{frame.name}]\nID={frame.identifier:03X}h\nLen=8\n"
        text += "".join(f"Var={name} unsigned {start},{length}\n" for name, start, length in frame.signals)
    return text


def arxml(frames):
    """The messages as an AUTOSAR system, each in a package of its own."""
    packages, triggers = "", ""
    for number, frame in enumerate(frames):
        packages += _package(f"P{number}", frame)
        triggers += (f"<CAN-FRAME-TRIGGERING><SHORT-NAME>T{number}</SHORT-NAME><FRAME-REF DEST=\"CAN-FRAME\">"
                     f"/P{number}/{frame.name}</FRAME-REF><CAN-ADDRESSING-MODE>STANDARD</CAN-ADDRESSING-MODE>"
                     f"<IDENTIFIER>{frame.identifier}</IDENTIFIER></CAN-FRAME-TRIGGERING>")
    cluster = ("<AR-PACKAGE><SHORT-NAME>C</SHORT-NAME><ELEMENTS><CAN-CLUSTER><SHORT-NAME>Bus</SHORT-NAME>"
               "<CAN-CLUSTER-VARIANTS><CAN-CLUSTER-CONDITIONAL><BAUDRATE>500000</BAUDRATE><PHYSICAL-CHANNELS>"
               "<CAN-PHYSICAL-CHANNEL><SHORT-NAME>Ch</SHORT-NAME>"
               f"<FRAME-TRIGGERINGS>{triggers}</FRAME-TRIGGERINGS></CAN-PHYSICAL-CHANNEL></PHYSICAL-CHANNELS>"
               "</CAN-CLUSTER-CONDITIONAL></CAN-CLUSTER-VARIANTS></CAN-CLUSTER></ELEMENTS></AR-PACKAGE>")
    return ('<?xml version="1.0"?><AUTOSAR xmlns="http://autosar.org/schema/r4.0" '
            'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" '
            'xsi:schemaLocation="http://autosar.org/schema/r4.0 AUTOSAR_4-2-2.xsd">'
            f"<AR-PACKAGES>{packages}{cluster}</AR-PACKAGES></AUTOSAR>")


def _package(name, frame):
    """Frame, PDU and signals; each signal in a package below it, so that two may have one name."""
    signals, places = "", ""
    for number, (signal, start, length) in enumerate(frame.signals):
        signals += (f"<AR-PACKAGE><SHORT-NAME>S{number}</SHORT-NAME><ELEMENTS><I-SIGNAL><SHORT-NAME>{signal}"
                    f"</SHORT-NAME><LENGTH>{length}</LENGTH><SYSTEM-SIGNAL-REF DEST=\"SYSTEM-SIGNAL\">/{name}/S{number}"
                    "/sys</SYSTEM-SIGNAL-REF></I-SIGNAL><SYSTEM-SIGNAL><SHORT-NAME>sys</SHORT-NAME></SYSTEM-SIGNAL>"
                    "</ELEMENTS></AR-PACKAGE>")
        places += (f"<I-SIGNAL-TO-I-PDU-MAPPING><SHORT-NAME>M{number}</SHORT-NAME><I-SIGNAL-REF DEST=\"I-SIGNAL\">"
                   f"/{name}/S{number}/{signal}</I-SIGNAL-REF><PACKING-BYTE-ORDER>MOST-SIGNIFICANT-BYTE-LAST</"
                   f"PACKING-BYTE-ORDER><START-POSITION>{start}</START-POSITION></I-SIGNAL-TO-I-PDU-MAPPING>")
    return (f"<AR-PACKAGE><SHORT-NAME>{name}</SHORT-NAME><ELEMENTS><CAN-FRAME><SHORT-NAME>{frame.name}</SHORT-NAME>"
            "<FRAME-LENGTH>8</FRAME-LENGTH><PDU-TO-FRAME-MAPPINGS><PDU-TO-FRAME-MAPPING><SHORT-NAME>m</SHORT-NAME>"
            f"<PDU-REF DEST=\"I-SIGNAL-I-PDU\">/{name}/pdu</PDU-REF></PDU-TO-FRAME-MAPPING></PDU-TO-FRAME-MAPPINGS>"
            f"</CAN-FRAME><I-SIGNAL-I-PDU><SHORT-NAME>pdu</SHORT-NAME><LENGTH>8</LENGTH><I-SIGNAL-TO-PDU-MAPPINGS>"
            f"{places}</I-SIGNAL-TO-PDU-MAPPINGS></I-SIGNAL-I-PDU></ELEMENTS><AR-PACKAGES>{signals}</AR-PACKAGES>"
            "</AR-PACKAGE>")
