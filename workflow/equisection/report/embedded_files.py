"""Files inside a page: pictures with their size, tables with the file that they are."""

from __future__ import annotations

import base64
import struct
from dataclasses import dataclass
from pathlib import Path

from equisection.errors import EquisectionError

#: First bytes of a PNG file, before the width and height of its header.
_PNG = b"\x89PNG\r\n\x1a\n"


class EmbeddingError(EquisectionError):
    """A file cannot be put into a page."""


@dataclass(frozen=True)
class Picture:
    """A picture as a page has it.

    Attributes
    ----------
    address
        Its address.
    width, height
        In pixels.
    empty
        Why nothing is drawn in it; empty where something is.
    """

    address: str
    width: int
    height: int
    empty: str = ""


def data_address(content: bytes, media_type: str) -> str:
    """Return the address of content that a page has in itself (RFC 2397)."""
    return f"data:{media_type};base64,{base64.b64encode(content).decode('ascii')}"


def picture(path: Path) -> Picture:
    """Read a picture.

    Raises
    ------
    EmbeddingError
        The file cannot be read, or is no PNG.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise EmbeddingError(f"{path}: cannot be read ({error.strerror}); run again") from None
    if not content.startswith(_PNG) or len(content) < 24:
        raise EmbeddingError(f"{path}: is no PNG picture; delete it and run again")
    width, height = struct.unpack(">II", content[16:24])
    return Picture(data_address(content, "image/png"), width, height, _warning(content))


def _warning(content: bytes) -> str:
    """Return the text of a PNG of the keyword ``Warning``, before its pixels; empty for none."""
    place = len(_PNG)
    while place + 12 <= len(content):
        length, kind = struct.unpack(">I4s", content[place : place + 8])
        keyword, _, text = content[place + 8 : place + 8 + length].partition(b"\0")
        if kind == b"IDAT":
            break
        if kind == b"tEXt" and keyword == b"Warning":
            return text.decode("latin-1")
        place += length + 12
    return ""
