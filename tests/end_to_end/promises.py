#!/usr/bin/python3
"""Writes the page .github/PROMISES.md: the sentences that tests hold the program to, from the first paragraphs of their docstrings.

usage: promises.py [--write]

Without --write, exit code 1 when the page differs.
"""

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

HERE = Path(__file__).resolve().parent
PAGE = HERE.parent.parent / ".github" / "PROMISES.md"
FILES = ("security_test.py", "foreign_files_test.py", "persons_files_test.py")
# Tests elsewhere, as ctest calls them.
FURTHER = (
    ("clusters.hostile", "No text of a campaign file reaches a shell, and no deck runs one, except the lines of `run.slurm.setup` when the person gives `--allow-setup`, and commands for which the person gives `--allow-extra`."),
    ("fuzz.notes", "JSON that is nested deeper than 100 levels, or holds numbers and texts that no note of the program can have, is damaged, and what it says is not believed."),
    ("end_to_end.archive", "A bundle from elsewhere writes nothing outside a private folder and fills neither memory nor disk; a file of it that was changed is noticed."),
    ("end_to_end.archive", "No link in a campaign's folder is followed when a bundle is made."),
    ("end_to_end.one_writer", "One driver works in a campaign's folder, under whatever path."),
    ("end_to_end.one_writer", "A process that only has the number of an engine that has ended is not killed."),
    ("end_to_end.deck", "`deck` writes nothing through a symbolic link, and replaces no file that it did not write."),
)
TITLE = """# What the program promises about files, folders and commands

Written by `tests/end_to_end/promises.py --write` from the tests. [SECURITY.md](SECURITY.md) says whom the program trusts.

| sentence | test |
|---|---|
"""


def sentences() -> Iterator[tuple[str, str]]:
    """Each test with its sentence."""
    for name in FILES:
        tree = ast.parse((HERE / name).read_text(encoding="utf-8"))
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef) and node.name.startswith("test_"):
                sentence = " ".join((ast.get_docstring(node) or "").split("\n\n")[0].split())
                if not sentence.endswith("."):
                    sys.exit(f"{name}: {node.name} has no sentence that it tests as its docstring")
                yield node.name, sentence
    yield from FURTHER


def main() -> int:
    text = TITLE + "".join(f"| {sentence} | `{test}` |\n" for test, sentence in sentences())
    if "--write" in sys.argv:
        PAGE.write_text(text, encoding="utf-8")
    if PAGE.read_text(encoding="utf-8") != text:
        print(f"{PAGE} differs from the tests; write it again: tests/end_to_end/promises.py --write")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
