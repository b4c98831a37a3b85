"""Files inside a page: pictures with their size, tables with the file that they are."""

from __future__ import annotations

import base64
import io
from dataclasses import dataclass
from pathlib import Path

from PIL import Image, UnidentifiedImageError

from equisection.errors import EquisectionError


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
    try:
        with Image.open(io.BytesIO(content), formats=["PNG"]) as image:
            width, height = image.size
            warning = str(image.info.get("Warning", ""))  # a text of the PNG specification
    except (UnidentifiedImageError, OSError, SyntaxError):
        raise EmbeddingError(f"{path}: is no PNG picture; delete it and run again") from None
    return Picture(data_address(content, "image/png"), width, height, warning)
