"""Holds src/store/campaign_header.txt to what h5dump, a reader that we did not write, prints for a campaign.h5.

usage: check_header.py CAMPAIGN.h5 HEADER.txt [--write]; --write writes the text again
"""

import pathlib
import subprocess
import sys


def main(campaign, header, *options):
    path = pathlib.Path(campaign)
    done = subprocess.run(["h5dump", "-H", "-A", "0", path.name], cwd=path.parent, capture_output=True, text=True, check=True)
    if options == ("--write",):
        pathlib.Path(header).write_text(done.stdout, encoding="utf-8")
    elif done.stdout != pathlib.Path(header).read_text(encoding="utf-8"):
        sys.exit(f"{header} differs from h5dump -H -A 0 {campaign}; write it again with --write")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
