"""Valid bytes and texts made wrong: flipped, cut, doubled, moved, and words put in that readers stumble over."""
# SPDX-License-Identifier: Apache-2.0
import random
import re
from typing import Sequence

# Numbers and words that a reader may take for something else.
WORDS = ("", "0", "-1", "1e999", ".nan", ".inf", "-.inf", "NaN", "1" * 400, "0x10", "1_000", "yes", "null", "~", "[]",
         "{}", "'", '"', "&a", "*a", "!!python/object:os.system {}", "!!binary aGk=", "\0", "\t", "- - -", "? :",
         "2020-13-45", "2020-01-01", "190:20:30", "\N{RIGHT-TO-LEFT OVERRIDE}", "a" * 5000, "../../etc/passwd",
         "/dev/zero", "<<: [*a]", "%YAML 9.9", "---\n---", "4294967296", "18446744073709551616", "-9223372036854775809")
# Of four bytes, as lengths and numbers are written.
LENGTHS = (b"\0\0\0\0", b"\xff\xff\xff\xff", b"\xff\xff\xff\x7f", b"\0\0\0\x80")
_TOKEN = re.compile(r"[A-Za-z_]\w*|-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?|[^\s\w]")


def spoilt_bytes(chance: random.Random, data: bytes, others: Sequence[bytes] = ()) -> bytes:
    """With one to four things wrong. others: of which a piece may be put in."""
    content = bytearray(data)
    for _ in range(chance.randint(1, 4)):
        place = chance.randrange(len(content) + 1)
        kind = chance.randrange(7)
        if kind == 0 and place < len(content):
            content[place] ^= 1 << chance.randrange(8)
        elif kind == 1:
            del content[place:]
        elif kind == 2:
            content[place:place + chance.randint(1, 8)] = chance.getrandbits(32).to_bytes(4, "little")
        elif kind == 3:
            end = place + chance.randint(1, 64)
            content[place:place] = content[place:end] * chance.choice((1, 2, 50))
        elif kind == 4:
            del content[place:place + chance.randint(1, 64)]
        elif kind == 5:
            content[place:place + 4] = chance.choice(LENGTHS)
        elif others:
            other = chance.choice(others)
            start = chance.randrange(len(other) + 1)
            content[place:place] = other[start:start + chance.randint(1, 64)]
    return bytes(content)


def spoilt_text(chance: random.Random, text: str) -> str:
    """With one to three words replaced, lines lost, doubled or moved in, or bytes wrong."""
    for _ in range(chance.randint(1, 3)):
        kind = chance.randrange(8)
        lines = text.split("\n")
        place = chance.randrange(len(lines))
        if kind < 4:
            text = _with_other_word(chance, text)
        elif kind == 4:
            text = "\n".join(lines[:place] + lines[place:place + 1] * chance.choice((0, 2, 30)) + lines[place + 1:])
        elif kind == 5:
            lines[place] = " " * chance.randint(0, 12) + lines[place].strip()
            text = "\n".join(lines)
        elif kind == 6:
            other = chance.randrange(len(lines))
            lines[place], lines[other] = lines[other], lines[place]
            text = "\n".join(lines)
        else:
            content = spoilt_bytes(chance, text.encode("utf-8", "surrogateescape"))
            text = content.decode("utf-8", "surrogateescape")
    return text


def _with_other_word(chance: random.Random, text: str) -> str:
    tokens = list(_TOKEN.finditer(text))
    if not tokens:
        return chance.choice(WORDS)
    token = chance.choice(tokens)
    word = chance.choice((chance.choice(WORDS), chance.choice(tokens).group()))
    return text[:token.start()] + word + text[token.end():]
