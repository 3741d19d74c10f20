"""What `vibrotrough validate` does: runs the cases of validation/ and their negative controls, and prints the pages of verdicts for the manual."""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import time
import tomllib
from typing import Any

import claims
from validation_case import FAILS, HOLDS, ROOT

WRONG_INPUT, MISSING, INTERRUPTED = 2, 3, 130
FINDINGS_HEAD = """# Findings

What each study found about the statements of others and our own predictions, how its verdict was made, and the criteria that fail, if any.
"""


class Case:
    """A case of validation/ as FOLDER/case.toml describes it."""

    def __init__(self, folder: pathlib.Path) -> None:
        self.folder, self.name = folder, folder.name
        try:
            about = tomllib.loads((folder / "case.toml").read_text(encoding="utf-8"))
            self.title, self.question, self.control = (str(about[key]) for key in ("title", "question", "negative_control"))
        except (tomllib.TOMLDecodeError, KeyError) as error:
            message = f"{folder / 'case.toml'}: {error!r}; a case needs the keys title, question and negative_control"
            raise SystemExit(message) from error
        self.long: bool = about.get("long", False)
        self.figures: list[str] = about.get("figures", [])
        # What keeps its findings from being pre-registered, such as "limits set after a first look".
        self.caveat: str = about.get("caveat", "")

    def stored_verdict(self) -> dict[str, Any] | None:
        """The case's verdict.json, or None if it has not been judged."""
        path = self.folder / "verdict.json"
        return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None

    def run(self, options: argparse.Namespace, control: bool) -> tuple[int, str]:
        """Runs run.py, whose output goes to a log; returns its exit code and the log's path. Nothing of a control is stored."""
        output = self.folder if options.store and not control else options.output / self.name / ("negative_control" if control else "")
        output.mkdir(parents=True, exist_ok=True)
        command = [sys.executable, "-B", str(self.folder / "run.py"), "--program", options.program, "--output", str(output),
                   "--runs", str((options.runs / self.name).resolve()), "--jobs", str(options.jobs), "--points", str(options.points)]
        command += ["--negative-control"] if control else []
        command += ["--long"] if options.long and self.long and not control else []
        log = options.output / self.name / ("negative_control.log" if control else "log")
        log.parent.mkdir(parents=True, exist_ok=True)
        if options.verbose:
            return subprocess.run(command, check=False).returncode, "see above"
        with open(log, "w", encoding="utf-8") as file:
            return subprocess.run(command, stdout=file, stderr=subprocess.STDOUT, check=False).returncode, str(log)


def all_cases(folder: pathlib.Path) -> list[Case]:
    """The cases below `folder`, by name."""
    return [Case(path.parent) for path in sorted(folder.glob("*/case.toml"))]


def chosen(cases: list[Case], names: list[str]) -> list[Case]:
    """The named cases, or all."""
    known = {case.name: case for case in cases}
    for name in names:
        if name not in known:
            print(f"there is no case '{name}'; 'vibrotrough validate --list' shows all cases", file=sys.stderr)
            sys.exit(WRONG_INPUT)
    return [known[name] for name in names] if names else cases


def failures(log: str) -> list[str]:
    """The criteria that failed, for the terminal."""
    path = pathlib.Path(log)
    return [line for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("FAIL")] if path.exists() else []


def judge(case: Case, options: argparse.Namespace) -> bool:
    """Runs a case and its negative control; true when the case holds and the control fails."""
    begin = time.monotonic()
    print(f"{case.name:<24} ", end="", flush=True)
    code, log = case.run(options, control=False)
    control_code, control_log = case.run(options, control=True)
    good = code == HOLDS and control_code == FAILS
    text = {HOLDS: "holds", FAILS: "FAILS"}.get(code, f"ERROR {code}")
    control = {FAILS: "its negative control fails, as it must", HOLDS: "its negative control PASSES, which it must not"}.get(
        control_code, f"its negative control ends with ERROR {control_code}")
    print(f"{text}; {control}; {time.monotonic() - begin:.0f} s")
    if not good:
        for line in failures(log):
            print(f"    {line}")
        print(f"    more in {log}" + ("" if control_code == FAILS else f" and {control_log}"))
    return good


def verdict_text(verdict: dict[str, Any] | None) -> str:
    if verdict is None:
        return "not judged yet"
    failed = sum(not criterion["holds"] for criterion in verdict["criteria"])
    count = len(verdict["criteria"])
    return f"holds ({count} criteria)" if verdict["holds"] else f"**fails** ({failed} of {count} criteria)"


def findings_count(findings: list[dict[str, Any]]) -> str:
    """How many findings are supported, and how many are not or are undecided."""
    found = [one["borne_out"] for one in findings]
    counts = [(found.count(True), "met"), (found.count(False), "missed"), (found.count(None), "undecided")]
    return ", ".join(f"{count} {word}" for count, word in counts if count)


def findings_text(findings: list[dict[str, Any]]) -> str:
    words = {True: "supported", False: "**not supported**", None: "undecided"}
    return "".join(f"- {words[one['borne_out']]}: {one['claim']}. {one['measured']}\n" for one in findings)


def overview(cases: list[Case]) -> str:
    """The table of the studies, from the stored verdicts, with links as from the folder `validation`."""
    lines = ["| study | claim | regression check | pre-registered | date |\n|---|---|---|---|---|\n"]
    for case in cases:
        verdict = case.stored_verdict()
        count = findings_count(verdict["findings"]) if verdict else ""
        count = f"[{count}](findings.md#{case.name})" + (f", but {case.caveat}" if case.caveat else "") if count else ""
        lines.append(f"| [`{case.name}`]({case.name}/README.md){' (long)' if case.long else ''} | {case.title} | {verdict_text(verdict)} | "
                     f"{count} | {verdict['date'] if verdict else ''} |\n")
    return "".join(lines)


def findings_page(cases: list[Case]) -> str:
    """The page of findings, from the stored verdicts."""
    lines = [FINDINGS_HEAD]
    for case in cases:
        verdict = case.stored_verdict()
        if not verdict:
            continue
        lines.append(f"\n## {case.name}\n\n`{verdict['command']}`, judged in {verdict['seconds']:.0f} s. {verdict['made_by']}.\n")
        broken = [criterion for criterion in verdict["criteria"] if not criterion["holds"]]
        found = [f"- **fails**: {one['what']}: {one['value']:.4g}, wanted {one['least']:.4g} to {one['most']:.4g}\n" for one in broken]
        found.append(findings_text(verdict["findings"]))
        lines += ["\n", *found] if any(found) else []
    return "".join(lines)


def show_list(cases: list[Case]) -> None:
    for case in cases:
        verdict = case.stored_verdict()
        state = "not judged yet" if verdict is None else ("holds" if verdict["holds"] else "FAILS") + " " + verdict["date"]
        print(f"{case.name:<24} {'long' if case.long else 'seconds':<8} {state:<18} {case.title}")


def judge_claims(options: argparse.Namespace) -> bool:
    """Compares the numbers of all pages with their tables, or writes them."""
    root = options.cases.resolve().parent
    if options.store:
        for name in claims.write(root):
            print(f"written: {name}")
    problems = claims.check(root)
    print("\n".join(problems) if problems else claims.summary(root))
    return not problems


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser()
    parser.add_argument("names", nargs="*")
    parser.add_argument("--program", required=True)
    parser.add_argument("--cases", type=pathlib.Path, default=ROOT / "validation")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("runs/validation"))
    parser.add_argument("--runs", type=pathlib.Path, default=pathlib.Path("runs"))
    parser.add_argument("--jobs", type=int, required=True)
    parser.add_argument("--points", type=int, default=300)
    for flag in ("--list", "--long", "--store", "--verbose", "--page", "--claims"):
        parser.add_argument(flag, action="store_true")
    return parser.parse_args()


def main() -> None:
    options = parse()
    cases = all_cases(options.cases)
    if options.list:
        show_list(chosen(cases, options.names))
        return
    if options.page:
        print(overview(cases) + "\n" + findings_page(cases), end="")
        return
    if options.claims:
        sys.exit(0 if judge_claims(options) else 1)
    good = [judge(case, options) for case in chosen(cases, options.names)]
    if options.store:
        print(f"stored in {options.cases}")
        claims.write(options.cases.resolve().parent)
    print(f"{sum(good)} of {len(good)} cases hold and have a negative control that fails")
    sys.exit(0 if all(good) else 1)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit(INTERRUPTED)
    except BrokenPipeError:  # the reader of our output has ended
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)
    except OSError as failure:
        print(f"validate: {failure}; choose another folder with --output", file=sys.stderr)
        sys.exit(MISSING)
