"""The periodic Lorentz gas, exactly: which obstacle is hit first?

`first_hit` answers arrays of queries; `oracle` answers exactly, one query at a time. `trajectories` and
`itinerary` follow particles. `flights` counts free paths. `lyapunov` and `diffusion` compute
statistics of trajectories. `horizon` finds the channels that are never blocked. `judge` reports the errors of
an engine, and `golden` has hard queries that break engines. docs/python.md has examples of all of them.
"""

from __future__ import annotations

import os as _os

from . import _lorentz
from ._answer import Answer, ExactTime, hit, inside, never, undecided, unsupported
from ._answers import Answers, Outcome
from ._card import CardAnswers
from ._first_hit import Engine, engines, first_hit
from ._flights import FreePaths, flights, horizon, laws, mean_free_path
from ._golden import GoldenRecord, GoldenSet, golden, golden_sets
from ._judge import judge
from ._lorentz import Certificate, Error, FileError, UnsupportedError
from ._numbers import Number, Obstacle, Vector
from ._paths import (STOPS, CertifiedCollision, Itinerary, Paths, Starts, draw_starts, itinerary,
                     memory_of_trajectories, trajectories)
from ._scene import Scene, SceneLike, catalogue, unit_scene
from ._statistics import Diffusion, Estimate, Lyapunov, diffusion, lyapunov, scan
from . import oracle, plot
from .oracle import judge_answer

__version__: str = _lorentz.VERSION

__all__ = [
    "Answer", "Answers", "CardAnswers", "Certificate", "CertifiedCollision", "Diffusion", "Engine", "Error", "Estimate",
    "ExactTime", "FileError", "FreePaths", "GoldenRecord", "GoldenSet", "Itinerary", "Lyapunov", "Number",
    "Obstacle", "Outcome", "Paths", "STOPS", "Scene", "SceneLike", "Starts", "UnsupportedError",
    "Vector", "catalogue", "diffusion", "draw_starts", "engines", "first_hit", "flights", "golden", "golden_sets",
    "hit", "horizon", "inside", "itinerary", "judge", "judge_answer", "laws", "lyapunov", "mean_free_path",
    "memory_of_trajectories", "never", "oracle", "plot", "scan", "trajectories", "undecided",
    "unit_scene", "unsupported",
]

# Folders of scenes and golden sets: in the package (pip), or beside it (Debian).
_here = _os.path.dirname(_os.path.abspath(__file__))
for _folder in (_os.path.join(_here, "data"), _os.path.join(_here, "..", "..", "..", "..", "share", "lorentz")):
    if _os.path.isdir(_folder):
        _lorentz.add_data_folder(_folder)
