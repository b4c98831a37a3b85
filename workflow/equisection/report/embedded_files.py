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
    """A picture as a page has it: its address, and its width and height in pixels."""

    address: str
    width: int
    height: int


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
    return Picture(data_address(content, "image/png"), width, height)
