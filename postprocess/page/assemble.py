"""Makes one HTML file of the page's parts: a page that is opened from a disk may not load another file.

usage: assemble.py PARTS BUILT VERSION

PARTS  folder of page.html, page.css and the scripts
BUILT  folder of theory_page.js and theory_page.wasm, in which page.html is written
"""

import base64
import gzip
import pathlib
import re
import sys

# In this order: later ones use what earlier ones declare.
SCRIPTS = ("german", "words", "numbers", "theory", "state", "inputs", "sentences", "answers", "curve", "measured", "campaign", "designs", "map", "motion", "main")
LARGEST = 3_000_000  # bytes


def assembled(parts: pathlib.Path, built: pathlib.Path, version: str) -> str:
    texts = {"page.css": (parts / "page.css").read_text(encoding="utf-8").strip(),
             "theory_page.js": (built / "theory_page.js").read_text(encoding="utf-8").strip(),
             "theory_page.wasm": base64.b64encode(gzip.compress((built / "theory_page.wasm").read_bytes(), mtime=0)).decode("ascii"),
             "scripts": "\n".join((parts / f"{name}.js").read_text(encoding="utf-8").strip() for name in SCRIPTS),
             "version": version}
    return re.sub(r"<!--=(\S+?)-->", lambda place: texts[place[1]], (parts / "page.html").read_text(encoding="utf-8"))


def main(parts: str, built: str, version: str) -> None:
    page = assembled(pathlib.Path(parts), pathlib.Path(built), version)
    size = len(page.encode())
    if size > LARGEST:
        sys.exit(f"the page has {size} bytes, more than {LARGEST}")
    (pathlib.Path(built) / "page.html").write_text(page, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
