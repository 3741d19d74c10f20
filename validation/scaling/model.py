"""A model of a campaign on many cores: what the engines need, and what everything around them needs."""

from dataclasses import dataclass

import numpy as np

STEPS = 1300  # of a cycle
SETTLING = 6.5  # cycles that the settling costs: 6.1, 6.4 and 6.7 in sizes.csv
SPEED_UP_OF_1000 = 1.4  # of two ranks with 1000 grains, measured 1.3 to 1.5


def relative_step_cost(grains: float) -> float:
    """What a step of a grain costs more than in a small layer: prepare::relative_step_cost."""
    return 1 + 2 / (1 + (30000 / grains) ** 1.5)


@dataclass
class Engine:
    """`grain_step` s on one core in a small layer; `latency` s that two ranks wait for each other in each step."""

    grain_step: float
    latency: float
    grows: bool = True

    @classmethod
    def fitted(cls, sizes: list[dict[str, str]], control: bool) -> "Engine":
        fits = [row for row in sizes if row["role"] == "fit"]
        cost = [float(row["cycle"]) / (float(row["grains"]) * STEPS) / (1 if control else relative_step_cost(float(row["grains"]))) for row in fits]
        grain_step = float(np.exp(np.mean(np.log(cost[:1] if control else cost))))
        step = 1000 * grain_step * relative_step_cost(1000)
        return cls(grain_step, 0.0 if control else step / SPEED_UP_OF_1000 - step / 2, not control)

    def cycle(self, grains: float, ranks: int = 1) -> float:
        """s of the clock. Each doubling of the ranks adds one exchange to a step."""
        step = grains * self.grain_step * (relative_step_cost(grains) if self.grows else 1)
        return STEPS * (step / ranks + self.latency * np.log2(ranks))

    def packing(self, grains: float, cycles: float, ranks: int = 1) -> float:
        return (cycles + SETTLING) * self.cycle(grains, ranks)


@dataclass
class Campaign:
    cases: int
    packings: int  # of a case
    grains: int
    cycles: int  # of a packing


@dataclass
class Site:
    """What surrounds the engines. `operation` s: of the shared file system; `operations` per second: that its server answers."""

    cores: int
    minutes_per_task: float  # 0: one packing for each task
    operation: float
    operations: float


FLUSHED_LINES = 100  # of a cycle, by the engine
THREADS = 64  # that wait for the file system at once, core/parallel


def hours(campaign: Campaign, site: Site, engine: Engine, measured: dict[str, float]) -> dict[str, float]:
    """h that each part needs alone; the longest decides, because they go on at the same time but for the driver's."""
    packings = campaign.cases * campaign.packings
    one = engine.packing(campaign.grains, campaign.cycles) + 2 * measured["start_of_engine"] + measured["start_of_task"]
    in_task = max(1.0, np.floor(60 * site.minutes_per_task / one))
    tasks = np.ceil(packings / in_task)
    driver_operations = measured["operations_of_prepare"] + measured["operations_of_run"]
    driver = campaign.cases * (measured["driver"] + driver_operations * site.operation / THREADS)
    operations = packings * (measured["operations_of_work"] + FLUSHED_LINES * campaign.cycles) + campaign.cases * driver_operations
    return {
        "engines": packings * one / site.cores / 3600,
        "scheduler": tasks / measured["tasks_per_second"] / 3600,
        "driver": driver / 3600,
        "file server": operations / site.operations / 3600,
    }
