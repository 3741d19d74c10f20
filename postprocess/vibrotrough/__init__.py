"""Opens what Vibrotrough wrote: arrays that know their units.

    import vibrotrough

    campaign = vibrotrough.open_campaign("runs/demo")           # a campaign's folder, or its campaign.h5
    eta, gamma = campaign["efficiency"], campaign["throw_number"]
    print(eta, eta.units, eta.description)
    case = campaign.case(campaign["case"][0])                   # the arrays of its own result.h5
    print(case["series/1/efficiency"][case["packings/cycles_discarded"][0]:])
    print(case.frames(1)[-1].positions)                         # where the campaign keeps frames; see help(vibrotrough.frames)

    theory = vibrotrough.open_theory("map.h5")                  # of 'theory map', or of 'theory batch'
    table = campaign.to_dataframe()                             # pandas; table.attrs["units"]["conveying_speed"] is "m s-1"

    vibrotrough.Campaign("pellets.toml").run()                  # plans and runs, by the program; see help(vibrotrough.Campaign)
    vibrotrough.theory.solve(rpm=960, stroke_mm=9.7, vibration_angle_deg=30, friction=0.3)      # see help(vibrotrough.theory)

Everything is read at once, so files may be renewed meanwhile. A damaged file is refused with ValueError. `vibrotrough quantities` prints
all names. Names of older versions are still understood.
Needs numpy, results h5py, and to_dataframe() pandas; the theory needs its compiled part (pip install --no-build-isolation ./postprocess).
"""

from __future__ import annotations

import importlib
import pathlib
from typing import TYPE_CHECKING, Any

from .campaign import Campaign, CampaignFile, Case, ProgramError, open_campaign, table
from .frames import GrainsChangeError, observable
from .results import Array, File, open_result, open_theory, read_regular

__all__ = ["Array", "Campaign", "CampaignFile", "Case", "File", "GrainsChangeError", "ProgramError", "observable", "open_campaign", "open_result",
           "open_theory", "read_regular", "table"]  # fmt: skip

# In a checkout the compiled part of the theory lies in the folder of the build.
__path__.append(str(pathlib.Path(__file__).resolve().parents[2] / "build" / "release" / "postprocess" / "vibrotrough"))

if TYPE_CHECKING:
    from . import field_files, fields, theory

    __all__ += ["field_files", "fields", "theory"]
else:

    def __getattr__(name: str) -> Any:
        """These are loaded where they are first asked for: results can be read without the compiled theory."""
        if name in ("field_files", "fields", "theory"):
            return importlib.import_module(f"{__name__}.{name}")
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
