"""What `vibrotrough validate` does: runs the cases of validation/, their wrong twins, and writes the page of verdicts."""

import argparse
import json
import pathlib
import subprocess
import sys
import time
import tomllib

from validation_case import FAILS, HOLDS, ROOT

WRONG_INPUT, MISSING, INTERRUPTED = 2, 3, 130
PAGE_HEAD = """# validation

One folder per claim: its question, source, formula, what deviation to expect and why, inputs, reference, a criterion with its reason, and a
deliberately wrong twin that the criterion must notice. This page is written by `vibrotrough validate --store`; [`postprocess/README.md`](../postprocess/README.md)
tells how a case is made.

    vibrotrough validate               # all cases and their twins; those of long simulations from their stored tables
    vibrotrough validate NAME --long   # run the simulations of one again, minutes to an hour

"""


class Case:
    def __init__(self, folder):
        self.folder, self.name = folder, folder.name
        try:
            self.about = tomllib.loads((folder / "case.toml").read_text(encoding="utf-8"))
            self.title, self.question, self.twin = (self.about[key] for key in ("title", "question", "wrong_twin"))
        except (tomllib.TOMLDecodeError, KeyError) as wrong:
            raise SystemExit(f"{folder / 'case.toml'}: {wrong!r}; a case has title, question and wrong_twin") from wrong
        self.long = self.about.get("long", False)
        self.figures = self.about.get("figures", [])

    def stored_verdict(self):
        path = self.folder / "verdict.json"
        return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None

    def run(self, options, twin):
        """Exit code of run.py, which writes to its own log; nothing of a twin is kept."""
        output = self.folder if options.store and not twin else options.output / self.name / ("wrong_twin" if twin else "")
        output.mkdir(parents=True, exist_ok=True)
        command = [sys.executable, "-B", str(self.folder / "run.py"), "--program", options.program, "--output", str(output),
                   "--runs", str((options.runs / self.name).resolve()), "--jobs", str(options.jobs), "--points", str(options.points)]
        command += ["--wrong-twin"] if twin else []
        command += ["--long"] if options.long and self.long and not twin else []
        log = options.output / self.name / ("wrong_twin.log" if twin else "log")
        log.parent.mkdir(parents=True, exist_ok=True)
        if options.verbose:
            return subprocess.run(command, check=False).returncode, "see above"
        with open(log, "w", encoding="utf-8") as file:
            return subprocess.run(command, stdout=file, stderr=subprocess.STDOUT, check=False).returncode, str(log)


def all_cases(folder):
    return [Case(path.parent) for path in sorted(folder.glob("*/case.toml"))]


def chosen(cases, names):
    known = {case.name: case for case in cases}
    for name in names:
        if name not in known:
            print(f"there is no case '{name}'; 'vibrotrough validate --list' names them", file=sys.stderr)
            sys.exit(WRONG_INPUT)
    return [known[name] for name in names] if names else cases


def failures(log):
    """The criteria that failed, for the terminal."""
    path = pathlib.Path(log)
    return [line for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("FAIL")] if path.exists() else []


def judge(case, options):
    """Runs a case and its twin; True when the case holds and the twin fails."""
    begin = time.monotonic()
    print(f"{case.name:<24} ", end="", flush=True)
    code, log = case.run(options, twin=False)
    twin_code, twin_log = case.run(options, twin=True)
    good = code == HOLDS and twin_code == FAILS
    text = {HOLDS: "holds", FAILS: "FAILS"}.get(code, f"ERROR {code}")
    twin = {FAILS: "its wrong twin is noticed", HOLDS: "its wrong twin PASSES"}.get(twin_code, f"its wrong twin ends with ERROR {twin_code}")
    print(f"{text}; {twin}; {time.monotonic() - begin:.0f} s")
    if not good:
        for line in failures(log):
            print(f"    {line}")
        print(f"    more in {log}" + ("" if twin_code == FAILS else f" and {twin_log}"))
    return good


def verdict_text(verdict):
    if verdict is None:
        return "not judged yet"
    failed = sum(not criterion["holds"] for criterion in verdict["criteria"])
    count = len(verdict["criteria"])
    return f"holds ({count} criteria)" if verdict["holds"] else f"**fails** ({failed} of {count} criteria)"


def findings_text(findings):
    words = {True: "borne out", False: "**not borne out**", None: "undecided"}
    return "".join(f"- {words[one['borne_out']]}: {one['claim']}. {one['measured']}\n" for one in findings)


def page(cases):
    lines = [PAGE_HEAD, "| case | claim | verdict | date | figure |\n|---|---|---|---|---|\n"]
    for case in cases:
        verdict = case.stored_verdict()
        figures = ", ".join(f"[{name}]({case.name}/{name})" for name in case.figures)
        lines.append(f"| [`{case.name}`]({case.name}/README.md){' (long)' if case.long else ''} | {case.title} | {verdict_text(verdict)} | "
                     f"{verdict['date'] if verdict else ''} | {figures} |\n")
    for case in cases:
        verdict = case.stored_verdict()
        if not verdict:
            continue
        lines.append(f"\n## {case.name}\n\n{case.question}\n\n`{verdict['command']}`, judged in {verdict['seconds']:.0f} s. {verdict['made_by']}.\n\n")
        broken = [criterion for criterion in verdict["criteria"] if not criterion["holds"]]
        lines += [f"- **fails**: {one['what']}: {one['value']:.4g}, wanted {one['least']:.4g} to {one['most']:.4g}\n" for one in broken]
        lines.append(findings_text(verdict["findings"]))
        lines.append(f"\nWrong twin, which fails as it must: {case.twin}\n")
        if case.figures:
            lines.append(f"\n![{case.title}]({case.name}/{case.figures[0]})\n")
    return "".join(lines)


def show_list(cases):
    for case in cases:
        verdict = case.stored_verdict()
        state = "not judged yet" if verdict is None else ("holds" if verdict["holds"] else "FAILS") + " " + verdict["date"]
        print(f"{case.name:<24} {'long' if case.long else 'seconds':<8} {state:<18} {case.title}")


def parse():
    parser = argparse.ArgumentParser()
    parser.add_argument("names", nargs="*")
    parser.add_argument("--program", required=True)
    parser.add_argument("--cases", type=pathlib.Path, default=ROOT / "validation")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("runs/validation"))
    parser.add_argument("--runs", type=pathlib.Path, default=pathlib.Path("runs"))
    parser.add_argument("--jobs", type=int, required=True)
    parser.add_argument("--points", type=int, default=300)
    for flag in ("--list", "--long", "--store", "--verbose", "--page"):
        parser.add_argument(flag, action="store_true")
    return parser.parse_args()


def main():
    options = parse()
    cases = all_cases(options.cases)
    if options.list:
        show_list(chosen(cases, options.names))
        return
    if options.page:
        print(page(cases), end="")
        return
    good = [judge(case, options) for case in chosen(cases, options.names)]
    if options.store:
        (options.cases / "README.md").write_text(page(cases), encoding="utf-8")
        print(f"stored in {options.cases}")
    print(f"{sum(good)} of {len(good)} cases hold, with a twin that is noticed")
    sys.exit(0 if all(good) else 1)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit(INTERRUPTED)
    except BrokenPipeError:  # the reader of our output has seen enough
        sys.stdout = None
        sys.exit(0)
    except OSError as failure:
        print(f"validate: {failure}; choose another folder with --output", file=sys.stderr)
        sys.exit(MISSING)
