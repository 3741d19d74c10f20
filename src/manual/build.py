"""Builds the manual: copies its pages, generates the reference and starts Sphinx, for which a warning is an error.

usage: build.py PROGRAM FOLDER
Writes FOLDER/html/index.html. The pages that the manual has in common with other folders keep their names in SHARED.
"""

import csv
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
MANUAL = ROOT / "src/manual"
sys.path.insert(0, str(ROOT / "postprocess"))
import theory_map  # noqa: E402
import validate  # noqa: E402

SHARED = {"src/CHANGES.md": "changes.md", "input_templates/tutorial/design.md": "tutorial_design.md",
          "input_templates/tutorial/depth.md": "tutorial_depth.md"}
FOLDERS = ("validation/", "input_templates/pictures/")  # copied with their pages, pictures and tables
GENERATED = {f"input_templates/plant/{name}.csv": f"reference/plant.md#{name}" for name in ("materials", "drives", "motors")}
LINK = re.compile(r"(?P<image>!?)\[(?P<text>(?:[^\[\]]|\[[^\]]*\])*)\]\((?P<target>[^()\s]+)\)")


def printed(program: str, *words: str) -> str:
    return subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout


def place(path: str) -> str | None:
    """Where a file of the repository lies in the manual, or None."""
    if path in SHARED | GENERATED:
        return (SHARED | GENERATED)[path]
    if path.startswith("src/manual/"):
        return path.removeprefix("src/manual/")
    return path if path.startswith(FOLDERS) else None


def with_links(text: str, page: str) -> str:
    """The text with its links as they are in the manual; a link to a file that is only in the sources becomes that file's name."""
    own = place(page) or page

    def moved(link: re.Match[str]) -> str:
        path, hash_sign, anchor = link["target"].partition("#")
        if not path or re.match("[a-z]+:", path):
            return link[0]
        full = os.path.normpath(os.path.join(os.path.dirname(page), path))
        target = place(full)
        if target is None or (ROOT / full).is_dir():
            return link["text"] if link["text"].startswith("`") else f"{link['text']} (`{full}`)"
        return f"{link['image']}[{link['text']}]({os.path.relpath(target, os.path.dirname(own) or '.')}{hash_sign}{anchor})"

    return LINK.sub(moved, text)


def write(source: pathlib.Path, name: str, text: str) -> None:
    path = source / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def copy_pages(source: pathlib.Path) -> None:
    shutil.copytree(MANUAL, source)
    for folder in FOLDERS:
        for file in (ROOT / folder).rglob("*"):
            if file.suffix in (".png", ".csv", ".py", ".toml", ".md") and "__pycache__" not in file.parts:
                target = source / file.relative_to(ROOT)
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(file, target)
    for page, name in SHARED.items():
        shutil.copyfile(ROOT / page, source / name)
    original = {name: page for page, name in SHARED.items()}
    for copy in source.rglob("*.md"):
        name = str(copy.relative_to(source))
        page = original.get(name, name if name.startswith(FOLDERS) else f"src/manual/{name}")
        copy.write_text(with_links(copy.read_text(encoding="utf-8"), page), encoding="utf-8")
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    write(source, "parts/first_result.md", with_links(re.split(r"^## .*\n", readme, flags=re.MULTILINE)[1], "README.md"))


def as_prose(help_text: re.Match[str]) -> str:
    """The text below the options of a command: paragraphs as prose, what is indented as it is."""
    parts = []
    for part in re.split(r"\n\n+", help_text[1].strip("\n")):
        is_prose = not re.search(r"^ ", part, re.MULTILINE)
        parts.append(re.sub(r"([\\`*_\[\]<>#|$])", r"\\\1", part) if is_prose else f"```text\n{part}\n```")
    return "\n\n".join(parts).replace("\n```\n\n```text\n", "\n\n") + "\n"


def exit_codes(text: str) -> str:
    """The table of exit codes, from the lines of `vibrotrough --help`."""
    rows = re.findall(r"^ +(\d+)  (.*(?:\n {7}.*)*)", text, re.MULTILINE)
    return "| code | what happened |\n|---|---|\n" + "".join(f"| {code} | {' '.join(what.split())} |\n" for code, what in rows)


def commands(source: pathlib.Path, program: str) -> None:
    """A page for each command, and one that lists them."""
    head, *pages = re.split(r"^## (?=vibrotrough )", printed(program, "manual", "--markdown"), flags=re.MULTILINE)
    names = []
    for page in pages:
        title, body = page.split("\n", 1)
        names.append(title.removeprefix("vibrotrough ").replace(" ", "-"))
        write(source, f"reference/commands/{names[-1]}.md", f"# {title}\n" + re.sub(r"```text\n(.*?)```\n", as_prose, body, flags=re.DOTALL))
    head = re.sub(r"\(#vibrotrough-([a-z-]+)\)", r"(commands/\1.md)", head)
    listed = "\n".join(f"commands/{name}" for name in names)
    write(source, "reference/commands.md", f"{head}\n```{{toctree}}\n:hidden:\n{listed}\n```\n")
    write(source, "parts/exit_codes.md", exit_codes(head))


def quantities(source: pathlib.Path, program: str) -> None:
    """The page of quantities, and its table of outcomes as a part of the page on troubles."""
    text = with_links(printed(program, "quantities"), "src/store/quantities.md")
    body, outcomes = text.split("\n## Outcomes\n")
    write(source, "reference/quantities.md", body)
    write(source, "parts/outcomes.md", outcomes)


def plant_title(column: str) -> str:
    """A column's name and unit as a heading: size_low_mm is "size [mm]"."""
    name = column.replace("_low", "")
    unit = next((one for one in ("kg_mm", "mm", "kN", "kW") if name.endswith("_" + one)), None)
    if unit:
        return f"{name.removesuffix('_' + unit).replace('_', ' ')} [{unit.replace('_', ' ')}]"
    return {"bulk_density": "bulk density [kg/m\u00b3]", "rpm": "speed [1/min]", "rolling": "rolling friction"}.get(name, name.replace("_", " "))


def between(row: dict[str, str], column: str) -> str:
    """What a row has in a column, or in one for the low end of a range and the next for the high one."""
    high = row.get(column.replace("_low", "_high"), "") if "_low" in column else ""
    return f"{row[column]} to {high}" if high else row[column]


def plant_tables(source: pathlib.Path) -> None:
    """The page of the tables that come with `vibrotrough design`: their comments as prose, their rows."""
    parts = ["# Materials, drives and motors\n\nThese tables come with the program.\n"]
    for name in ("materials", "drives", "motors"):
        lines = (ROOT / f"input_templates/plant/{name}.csv").read_text(encoding="utf-8").splitlines()
        prose = " ".join(line.removeprefix("#").strip() for line in lines if line.startswith("#"))
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        shown = [{plant_title(key): between(row, key) for key in row if "_high" not in key} for row in rows]
        table = [list(shown[0]), ["---"] * len(shown[0]), *(list(row.values()) for row in shown)]
        parts.append(f"## {name.capitalize()}\n\n{prose}\n\n" + "".join(f"| {' | '.join(row)} |\n" for row in table))
    write(source, "reference/plant.md", "\n".join(parts))


def design_example(source: pathlib.Path, program: str) -> None:
    """The first command of the page on designs, and what it prints."""
    page = (MANUAL / "howto/design.md").read_text(encoding="utf-8")
    command = re.search(r"^    vibrotrough ((?:.*\\\n)*.*)$", page, re.MULTILINE)
    assert command
    words = shlex.split(command[1].replace("\\\n", " "))
    write(source, "parts/design_answer.md", f"```text\n{printed(program, *words)}```\n")


def libraries() -> str:
    return subprocess.run(["cmake", "-P", str(ROOT / "src/dependencies.cmake")], check=True, capture_output=True, text=True).stdout


def headers() -> str:
    """The public headers of the theory's library, which document themselves."""
    lines = ["# The C++ library: its headers\n\nThe comments of the public headers are the reference; [the library](../cpp.md) says how to use it.\n"]
    for header in sorted((ROOT / "src/theory").glob("*.hpp")):
        lines.append(f"## {header.name}\n\n```cpp\n{header.read_text(encoding='utf-8').rstrip()}\n```\n")
    return "\n".join(lines)


def generate(source: pathlib.Path, program: str) -> None:
    commands(source, program)
    quantities(source, program)
    write(source, "reference/keys.md", with_links(printed(program, "keys"), "src/scenario/keys.md"))
    plant_tables(source)
    design_example(source, program)
    write(source, "reference/headers.md", headers())
    write(source, "reference/theory_map.md", theory_map.page(program))
    write(source, "parts/libraries.md", libraries())
    cases = validate.all_cases(ROOT / "validation")
    write(source, "parts/verdicts.md", validate.overview(cases).replace("](", "](validation/"))
    write(source, "validation/findings.md", validate.findings_page(cases))
    write(source, "validation/README.md", "# Studies\n\n```{toctree}\n" + "\n".join(f"{case.name}/README" for case in cases) + "\nhistory/README\nfindings\n```\n")


def main() -> None:
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    source = folder / "source"
    shutil.rmtree(folder, ignore_errors=True)
    copy_pages(source)
    generate(source, program)
    version = re.search(r"VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8").split("project(")[1])[1]
    environment = os.environ | {"VIBROTROUGH_SOURCE": str(ROOT), "VIBROTROUGH_VERSION": version, "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run([sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html", "-d", str(folder / "doctrees"), str(source),
                           str(folder / "html")], check=False, env=environment)
    sys.exit(done.returncode)


main()
