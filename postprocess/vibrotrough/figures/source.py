"""What the figures of a campaign are drawn from."""

import json
import pathlib
from collections.abc import Collection
from typing import Any

from ..campaign import open_campaign
from .drawn import read_note
from .inputs import swept_inputs
from .style import Problem, one_line


class Source:
    """What the figures are drawn from."""

    def __init__(self, directory: pathlib.Path, output: pathlib.Path) -> None:
        self.directory, self.output, self.data = directory, output, output / "data"
        try:
            self.overview: dict[str, Any] = json.loads(read_note(self.data / "campaign.json"))
            self.campaign = open_campaign(directory)
            self.attributes = self.campaign.attributes
            units = {name: self.campaign[name].units for name in self.campaign}
            self.inputs = swept_inputs(self.campaign, units, self.attributes)
        except Exception as error:  # whatever a file holds that this program did not write
            raise Problem(f"cannot read the campaign ({one_line(error)}); give a campaign's folder, by 'vibrotrough plot DIR'") from error
        if self.campaign.cases == 0:
            raise Problem(f"{directory / 'campaign.h5'} holds no finished case; run the campaign first")

    def row_of(self, case: str) -> dict[str, Any]:
        """The case's row of `vibrotrough compare`."""
        return next(row for row in self.overview["cases"] if row["case"] == case)

    def known_column(self, names: Collection[str]) -> str | None:
        """The first of these columns of `compare` that is known of any case."""
        return next((name for name in names if any(row.get(name) is not None for row in self.overview["cases"])), None)

    def column_of(self, key: str) -> str:
        """The column of `compare` that holds a swept key."""
        return next((str(one["column"]) for one in self.overview["swept"] if one["key"] == key), key.removeprefix("trough."))
