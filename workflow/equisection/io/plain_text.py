"""Text of a file that a user gives: a real file of sensible size, decoded, without odd characters.

A file is read as UTF-8 or UTF-16 with a byte-order mark, as UTF-8 without one, else as Windows-1252
(of which Latin-1's printable characters are a part). Control characters are refused, so that none
of them reaches a terminal by a message.
"""

from __future__ import annotations

import codecs
import re
import stat
from pathlib import Path

from equisection.errors import EquisectionError

#: What is no text: control characters but tab and line ends, and invisible marks that turn the
#: direction of writing or join words.
_NO_TEXT = re.compile(
    "[\x00-\x08\x0b-\x0c\x0e-\x1f\x7f-\x9f\xad\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff"
    "\ufff9-\uffff\ud800-\udfff\U000e0000-\U000e0fff]"
)


def plain_text(path: Path, kind: str, most_bytes: int, refused: type[EquisectionError]) -> str:
    """Return the text of a file; its lines end as those of Unix.

    Parameters
    ----------
    path
        The file.
    kind
        What it is, for messages: ``polar``.
    most_bytes
        Largest file that is read (bytes).
    refused
        Kind of the error.

    Raises
    ------
    FileNotFoundError
        There is no such file.
    EquisectionError
        Of the kind ``refused``: the file cannot be read, is no text, or is far too large.
    """
    try:
        found = path.stat()
        if not stat.S_ISREG(found.st_mode):
            raise refused(
                f"{path}: cannot be read as a text file: it is a folder or a device; name a file"
            )
        if found.st_size > most_bytes:
            raise refused(
                f"{path}: {found.st_size:,} bytes; a {kind} file has {most_bytes:,} at most; give "
                "fewer points, or another file"
            )
        text = decoded(path.read_bytes()).replace("\r\n", "\n").replace("\r", "\n")
    except FileNotFoundError:
        raise
    except UnicodeError as error:
        raise refused(
            f"{path}: cannot be read as a text file: {error}; save the {kind} as plain text (UTF-8)"
        ) from None
    except (OSError, ValueError) as error:
        raise refused(f"{path}: cannot be read as a text file: {error}") from error
    strange = _NO_TEXT.search(text)
    if strange:
        line = text.count("\n", 0, strange.start()) + 1
        raise refused(
            f"{path}, line {line}: an invisible character (U+{ord(strange[0]):04X}), so that it "
            f"cannot be read as a text file; save the {kind} as plain text (UTF-8)"
        )
    return text


def decoded(data: bytes) -> str:
    """Return the text of a file.

    Raises
    ------
    UnicodeError
        It is of none of the encodings.
    """
    marked = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    for encoding in ["utf-16"] if marked else ["utf-8-sig", "cp1252"]:
        try:
            return data.decode(encoding)
        except UnicodeDecodeError:
            continue
    raise UnicodeError("its bytes are neither UTF-8 nor UTF-16 nor Windows-1252")
