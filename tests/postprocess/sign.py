"""Gives a file that a test made or changed with h5py the last line of vibrotrough's files, without which they are damaged."""

import hashlib
import os
import pathlib

BEGIN = b"\nvibrotrough sha256 "


def sign(path: str | os.PathLike[str]) -> None:
    """Replaces the line, or adds it."""
    file = pathlib.Path(path)
    body = file.read_bytes().partition(BEGIN)[0]
    file.write_bytes(body + BEGIN + hashlib.sha256(body).hexdigest().encode() + b"\n")
