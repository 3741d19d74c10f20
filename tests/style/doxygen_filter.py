"""Doxygen's input filter: gives every name of a declaration such as `double a, b;  ///< text` the same documentation.

usage: doxygen_filter.py HEADER
Doxygen itself gives the text to the last name only. Line numbers stay as they are.
"""

import itertools
import pathlib
import re
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


def main() -> None:
    above: list[str] = []
    lines = pathlib.Path(sys.argv[1]).read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines):
        below = itertools.takewhile(lambda later: later.strip().startswith("///<"), lines[number + 1:])
        text = [later.strip().removeprefix("///<").strip() for later in below]
        if text and SEVERAL.match(line):  # a long text goes on below the declaration
            line = " ".join([line if "///<" in line else f"{line}  ///<", *text])
        print(spread(line, " ".join(above)))
        comment = re.match(r"\s*///(?!<) ?(.*)", line)
        above = [*above, comment[1]] if comment else []


if __name__ == "__main__":
    main()
