"""Copies headers for Doxygen: every name of a declaration such as `double a, b;  ///< text` gets the same documentation.

usage: doxygen_headers.py FOLDER COPY
Doxygen itself gives the text to the last name only. Line numbers stay as they are. A filter of Doxygen would be a process for each header.
"""

import itertools
import pathlib
import re
import shutil
import sys

SEVERAL = re.compile(r"^(\s+)([\w:<>*&\s]+?[\w>*&]) (\w+(?:(?: = [^,;(){}]+)?, \w+)+(?: = [^,;(){}]+)?);(?:\s*///< (.*))?$")


def spread(line: str, above: str) -> str:
    """The line with one declaration per name. `above`: the text of `///` lines right above it, for the names after the first."""
    found = SEVERAL.match(line)
    if not found or found[2].split()[0] in ("return", "using", "friend"):
        return line
    indent, kind, names, text = found.groups()
    if text:
        return indent + " ".join(f"{kind} {name}; /**< {text} */" for name in names.split(", "))
    first, *others = names.split(", ")
    return f"{indent}{kind} {first}; " + " ".join((f"/** {above} */ " if above else "") + f"{kind} {name};" for name in others)


def documented(text: str) -> str:
    """The text of a header, for Doxygen."""
    above: list[str] = []
    lines, result = text.splitlines(), []
    for number, line in enumerate(lines):
        below = itertools.takewhile(lambda later: later.strip().startswith("///<"), lines[number + 1:])
        further = [later.strip().removeprefix("///<").strip() for later in below]
        if further and SEVERAL.match(line):  # a long text goes on below the declaration
            line = " ".join([line if "///<" in line else f"{line}  ///<", *further])
        result.append(spread(line, " ".join(above)))
        comment = re.match(r"\s*///(?!<) ?(.*)", line)
        above = [*above, comment[1]] if comment else []
    return "\n".join(result) + "\n"


def main() -> None:
    folder, copy = (pathlib.Path(text) for text in sys.argv[1:])
    shutil.rmtree(copy, ignore_errors=True)
    for header in folder.rglob("*.hpp"):
        target = copy / header.relative_to(folder)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(documented(header.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
