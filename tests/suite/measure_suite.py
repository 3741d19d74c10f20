"""Measures what each test costs: `ctest` as always, with every command of a test run by count_cpu.py.

usage: measure_suite.py BUILD TABLE [CTEST_OPTION...]

BUILD is a folder with a build, for instance build/release. TABLE gets a row for each test: name, CPU, wall, exit code. In the end the
sums are printed, the dearest tests, and those that mostly wait. Compilers' caches are off, as on a fresh machine.
"""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile

SHOWN = 40
# A test waits if it uses less than this share of its time.
WAITS = 0.3

# CTest reads the test files of the build with add_test() replaced.
TEST_FILE = """
function(add_test name)
    cmake_parse_arguments(PARSE_ARGV 1 of "" "" "")
    _add_test("${{name}}" "{python}" -I -S "{wrapper}" "{table}" "${{name}}" ${{of_UNPARSED_ARGUMENTS}})
endfunction()
subdirs("{build}")
"""


def main() -> int:
    build, table = (pathlib.Path(text).resolve() for text in sys.argv[1:3])
    table.unlink(missing_ok=True)
    with tempfile.TemporaryDirectory(prefix="vibrotrough-suite-") as folder:
        wrapper = pathlib.Path(__file__).resolve().parent / "count_cpu.py"
        pathlib.Path(folder, "CTestTestfile.cmake").write_text(
            TEST_FILE.format(python=sys.executable, wrapper=wrapper, table=table, build=build))
        code = subprocess.run(["ctest", "--test-dir", folder, "--output-on-failure", *sys.argv[3:]],
                              env={**os.environ, "CCACHE_DISABLE": "1"}, check=False).returncode
    report(table)
    return code


def report(table: pathlib.Path) -> None:
    rows = sorted(((name, float(cpu), float(wall)) for name, cpu, wall, _ in csv.reader(table.open())), key=lambda row: -row[1])
    print(f"{len(rows)} tests, {sum(cpu for _, cpu, _ in rows) / 60:.1f} minutes of CPU")
    print(f"{'CPU s':>8}{'wall s':>8}  test")
    for name, cpu, wall in rows[:SHOWN]:
        print(f"{cpu:8.1f}{wall:8.1f}  {name}")
    print("Tests that mostly wait:")
    for name, cpu, wall in sorted(rows, key=lambda row: -row[2]):
        if wall > 5 and cpu < WAITS * wall:
            print(f"{cpu:8.1f}{wall:8.1f}  {name}")


if __name__ == "__main__":
    sys.exit(main())
