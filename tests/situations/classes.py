#!/usr/bin/python3
"""Prints the classes of what went wrong on other people's machines and with other people's files, with the numbers of
tests that were tried and that held with a program.

usage: classes.py PROGRAM [SITUATIONS]

SITUATIONS is the program of situations.cpp, built with the same sources; its table comes last. Takes about ten minutes. A test holds
when all of its parts do. VIBROTROUGH_PATIENCE sets the seconds after which a test of a program that hangs gives up (600).
"""

import os
import re
import subprocess
import sys
from pathlib import Path

TESTS = Path(__file__).resolve().parent.parent / "end_to_end"
# The classes of tests by file. Some tests stand in two classes.
CLASSES = {
    "must start: locales, signals, streams, homes, limits": {"surroundings": [
        "every_command_in_twelve_locales", "no_decimal_comma_reaches_engine_or_python", "signals_of_the_parent", "closed_streams", "homes_and_umasks", "open_files",
        "sizes_of_files", "an_engine_whose_path_is_not_utf8", "few_processes"]},
    "executes": {"foreign_files": ["no_command_of_a_campaign_file_reaches_the_engine_unasked", "no_command_of_an_added_case_reaches_the_engine_unasked",
                                   "no_task_runs_commands_of_a_campaign_unasked", "no_library_of_the_current_folder_is_loaded"]},
    "destroys": {"foreign_files": ["devices_and_pipes_are_written_into", "a_private_file_stays_private"]},
    "believes": {"foreign_files": ["numbers_of_other_files_are_not_believed", "no_number_of_a_damaged_result_is_shown", "what_is_drawn_is_what_was_checked"]},
    "omits": {"foreign_files": ["what_is_left_aside_is_said", "a_folder_that_may_not_be_read_is_said"]},
    "loses": {"persons_files": ["what_a_person_put_into_a_folder_stays", "the_deck_that_ran_is_stored", "a_damaged_result_that_is_replaced_is_said"]},
    "hangs": {"persons_files": ["no_pipe_is_waited_for"]},
    "shows its inside": {"persons_files": ["what_cannot_be_drawn_is_left_out"]},
    "leaves": {"persons_files": ["nothing_of_the_engine_stays", "nothing_half_written_stays"]},
    "dresses up": {"persons_files": ["names_dress_up_nothing"]},
    "names": {"persons_files": ["a_renamed_folder_is_not_the_engines_fault"]},
    "stale": {"persons_files": ["no_command_names_a_file_outside_of_the_deck"]},
}  # fmt: skip


def fallen(program: str, name: str) -> set[str]:
    """The tests of a file that do not hold with a program."""
    done = subprocess.run([sys.executable, "-B", TESTS / f"{name}_test.py"], cwd=TESTS, capture_output=True, text=True, check=False, env=dict(os.environ, VIBROTROUGH_PROGRAM=program))
    if not re.search(r"^Ran \d+ tests? in ", done.stderr, re.MULTILINE):
        raise SystemExit(done.stderr)
    return set(re.findall(r"^(?:FAIL|ERROR): test_(\w+) ", done.stderr, re.MULTILINE))


def main() -> None:
    program = str(Path(sys.argv[1]).resolve())
    found = {name: fallen(program, name) for name in sorted({name for tests in CLASSES.values() for name in tests})}
    for name, tests in CLASSES.items():
        every = [(file, test) for file, names in tests.items() for test in names]
        print(f"{name:<54} {len(every):>6} {sum(test not in found[file] for file, test in every):>6}", flush=True)
    if len(sys.argv) > 2:
        subprocess.run([sys.argv[2]], check=False)


if __name__ == "__main__":
    main()
