"""The periodic Lorentz gas, exactly: which obstacle is hit first?

`first_hit` answers for arrays, `oracle` exactly, one question at a time; `trajectories` and `itinerary` follow
particles, `flights` counts free paths, `horizon` finds the ways that are free for ever; `judge` says what an
engine gets wrong, and `golden` has what breaks them. docs/python.md shows all of it.
"""

from __future__ import annotations

import os as _os

from . import _lorentz
from ._answer import Answer, ExactTime, hit, inside, never, undecided, unsupported
from ._first_hit import Engine, Outcome, engines, first_hit
from ._flights import FreePaths, flights, horizon, laws, mean_free_path
from ._golden import GoldenRecord, GoldenSet, golden, golden_sets
from ._judge import judge
from ._lorentz import Answers, Certificate, Error, FileError, Paths
from ._numbers import Number, Obstacle, Vector
from ._paths import STOPS, CertifiedCollision, Itinerary, Starts, draw_starts, itinerary, trajectories
from ._scene import Scene, SceneLike, catalogue, unit_scene
from . import oracle
from .oracle import judge_answer

__version__: str = _lorentz.VERSION

__all__ = [
    "Answer", "Answers", "Certificate", "CertifiedCollision", "Engine", "Error", "ExactTime", "FileError",
    "FreePaths", "GoldenRecord", "GoldenSet", "Itinerary", "Number", "Obstacle", "Outcome", "Paths", "STOPS",
    "Scene", "SceneLike", "Starts", "Vector", "catalogue", "draw_starts", "engines", "first_hit", "flights",
    "golden", "golden_sets", "hit", "horizon", "inside", "itinerary", "judge", "judge_answer", "laws",
    "mean_free_path", "never", "oracle", "plot", "trajectories", "undecided", "unit_scene", "unsupported",
]

# Scenes and golden sets: those in the package itself (pip's), or beside it, as Debian has them.
_here = _os.path.dirname(_os.path.abspath(__file__))
for _folder in (_os.path.join(_here, "data"), _os.path.join(_here, "..", "..", "..", "..", "share", "lorentz")):
    if _os.path.isdir(_folder):
        _lorentz.add_data_folder(_folder)


def __getattr__(name: str) -> object:
    """`lorentz.plot` when it is first named: it needs Matplotlib, nothing else does."""
    if name == "plot":
        import importlib

        return importlib.import_module(".plot", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
