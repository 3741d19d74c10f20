"""Checks that every relative link of the documentation leads somewhere: to a file or folder and, after a '#', to a heading.

usage: links.py REPOSITORY
Reads every *.md that git tracks (without git: every *.md outside build and runs). Exit code 1 and a line per broken link.
"""

import pathlib
import re
import subprocess
import sys
from collections.abc import Iterator


def pages(root: pathlib.Path) -> list[pathlib.Path]:
    listed = subprocess.run(["git", "-C", str(root), "ls-files", "-z", "--", "*.md"], capture_output=True, text=True, check=False)
    if listed.returncode == 0 and listed.stdout:
        return [path for path in (root / name for name in listed.stdout.split("\0") if name) if path.exists()]
    return [path for path in sorted(root.rglob("*.md")) if path.relative_to(root).parts[0] not in ("build", "runs")]


def prose(page: pathlib.Path) -> str:
    """The text of a page without its code: fenced, indented and inline."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"^(    |\t).*$", "", text, flags=re.MULTILINE)
    return re.sub(r"`[^`\n]*`", "code", text)


def anchors(page: pathlib.Path) -> set[str]:
    """The names that headings have as targets of links: lower case, hyphens for spaces, no punctuation."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    headings = re.findall(r"^#+ +(.*?) *$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken(page: pathlib.Path) -> Iterator[str]:
    for target in re.findall(r"\]\(([^()\s]+)\)", prose(page)):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        if "src/manual" in str(page) and re.search(r"(^|/)(reference/|findings\.md$)", path):
            continue  # generated when the manual is built, which holds these links
        goal = page.parent / path if path else page
        if not goal.exists():
            yield f"{target}: there is no such file"
        elif anchor and anchor not in anchors(goal):
            yield f"{target}: there is no such heading"


def main() -> None:
    root = pathlib.Path(sys.argv[1]).resolve()
    found = pages(root)
    wrong = [f"{page.relative_to(root)}: {link}" for page in found for link in broken(page)]
    print("\n".join(wrong) or f"all links of {len(found)} pages lead somewhere")
    sys.exit(1 if wrong or not found else 0)


main()
