"""What is scheduled, by day of the year, kind of day and hour."""
from dataclasses import dataclass

import numpy as np


@dataclass
class Profile:
    """(365, 8, 24) values; `share`: of a load's power that heats the zone."""
    values: np.ndarray
    share: float = 1
    carrier: str = ""
