"""Proof of a NetCDF file by its bytes, without opening it as NetCDF.

The length of a file must be what its own header says, and its last bytes are the SHA-256 of all
that stand before them. They are written last, behind the end of the file that HDF5 knows, so every
reader of NetCDF-4 opens it as before. The digest is compared before the HDF5 library sees the file:
what that library does with a damaged one ranges from other values to no return.
"""

from __future__ import annotations

import hashlib
import struct
from pathlib import Path

_HDF5_SIGNATURE = b"\x89HDF\r\n\x1a\n"
#: Where the superblock of each version keeps the address at which the file ends.
_END_OF_FILE_OFFSET = {0: 40, 1: 44, 2: 28, 3: 28}
#: What the digest follows at the end of a file.
_MARK = b"\nequisection sha256 "
_LENGTH = len(_MARK) + 64 + 1
#: Faults of files, for messages.
CUT_SHORT = "truncated or not NetCDF-4"
ALTERED = "not as it was written: its content does not have its digest"
WITHOUT_DIGEST = (
    "without a digest: it is from before digests were written, or another program has written it "
    "('equisection seal' takes it as it is)"
)


def is_whole(path: Path) -> bool:
    """Tell from the first bytes and the size whether an HDF5 file is as long as it says.

    Cheap (one read of 64 bytes). The layout is that of the HDF5 file format specification,
    "Superblock", with 8-byte addresses as the library writes them.
    """
    return _beyond_end(path) >= 0


def _beyond_end(path: Path) -> int:
    """Return how many bytes stand behind the end of HDF5 (B); negative if it is not there."""
    try:
        with path.open("rb") as stream:
            head = stream.read(64)
        size = path.stat().st_size
    except OSError:
        return -1
    if len(head) < 64 or head[:8] != _HDF5_SIGNATURE or head[8] not in _END_OF_FILE_OFFSET:
        return -1
    (end,) = struct.unpack_from("<Q", head, _END_OF_FILE_OFFSET[head[8]])
    return int(size - end) if end > 0 else -1


def append_digest(path: Path) -> None:
    """Write the digest of a file's bytes behind them, which must be the last thing written."""
    with path.open("r+b") as stream:
        digest = hashlib.file_digest(stream, "sha256").hexdigest()
        stream.write(_MARK + digest.encode() + b"\n")


def fault_of(path: Path) -> str:
    """Return what is wrong with the bytes of a file; empty if they are as they were written.

    Returns
    -------
    str
        Empty, :data:`CUT_SHORT`, :data:`ALTERED` or :data:`WITHOUT_DIGEST`.
    """
    beyond = _beyond_end(path)
    if beyond == 0:
        return WITHOUT_DIGEST
    if beyond != _LENGTH:
        return CUT_SHORT
    try:
        content = memoryview(path.read_bytes())
    except OSError:
        return CUT_SHORT
    digest = hashlib.sha256(content[:-_LENGTH]).hexdigest().encode()
    return "" if content[-_LENGTH:] == _MARK + digest + b"\n" else ALTERED
