"""Scenes."""

from __future__ import annotations

import os
from typing import Any, Mapping, Union

import numpy as np

from . import _lorentz
from ._lorentz import Error
from ._numbers import Number, plain, text, whole

SceneLike = Union["Scene", Mapping[str, Any], str, "os.PathLike[str]"]


class Scene:
    """Obstacles on lattices in 2 or 3 dimensions: balls or ellipsoids, in motifs that repeat.

    Args:
        source: a dict in the form of docs/formats.md (``{"dimension": 2, "lattices": [{"vectors": [[1, 0],
            [0, 1]], "atoms": [{"position": [0, 0], "radius": 0.1}]}]}``); a TOML or JSON file; the name of a
            scene of the catalogue (`catalogue`); or another Scene.
        radius: every ball gets this radius, in the scene's unit of length.

    A number is a float, an int, a ``fractions.Fraction``, or a text: ``"1/3"``, ``"0.1"`` (exactly one tenth,
    not the nearest float). Floats stand for their exact rational values.

    Raises:
        Error: the scene is invalid; the message names the place, such as ``lattices[0].atoms[1].radius``.
        Error: no scene of the catalogue has this name. FileError: there is no such file.
    """

    __slots__ = ("_scene", "_oracle", "_name")
    _scene: _lorentz.Scene
    _oracle: _lorentz.Oracle | None  # created at its first use
    _name: str | None  # of the catalogue, or of a file

    def __init__(self, source: SceneLike, radius: Number | None = None) -> None:
        self._oracle = None
        self._name = str(source) if isinstance(source, (str, os.PathLike)) else getattr(source, "_name", None)
        self._scene = _read(source)
        if radius is not None:
            if isinstance(radius, (list, tuple, np.ndarray)):
                raise Error(f"radius: {radius!r} is not one number; `scan` takes several radii")
            self._scene = _read(_with_radius(self.to_dict(), plain(radius, "radius")))

    @property
    def dimension(self) -> int:
        """2 or 3."""
        return self._scene.dimension

    @property
    def is_binary64(self) -> bool:
        """True if every number is a float. Otherwise only certified itineraries and the oracle's first hits
        support it."""
        return self._scene.is_binary64

    def nearest(self) -> Scene:
        """The scene with every number rounded to the nearest float."""
        return wrapped(self._scene.nearest())

    def to_dict(self) -> dict[str, Any]:
        """The scene as a dict for the constructor. Numbers are floats, or Fractions if no float is equal."""
        return self._scene.to_dict()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and self.to_dict() == other.to_dict()

    def __hash__(self) -> int:
        return hash(_frozen(self.to_dict()))

    def __repr__(self) -> str:
        return f"Scene({self.to_dict()!r})"

    def __reduce__(self) -> Any:
        return Scene, (self.to_dict(),), (None, {"_name": self._name})


def unit_scene(dimension: int, radius: Number) -> Scene:
    """The unit square (2) or cubic (3) lattice with a ball of this radius at each of its points."""
    dimension = whole(dimension, "dimension", 2, 3)
    vectors = [[int(i == k) for k in range(dimension)] for i in range(dimension)]
    atom = {"position": [0] * dimension, "radius": radius}
    return Scene({"dimension": dimension, "lattices": [{"vectors": vectors, "atoms": [atom]}]})


def catalogue() -> list[str]:
    """The names of the scenes that come with the package (data/scenes)."""
    return _lorentz.catalogue()


def scene_of(scene: SceneLike) -> Scene:
    """The Scene for a scene in any form."""
    return scene if isinstance(scene, Scene) else Scene(scene)


def native(scene: SceneLike) -> _lorentz.Scene:
    """The extension module's object for a scene in any form."""
    return scene_of(scene)._scene


def wrapped(native_scene: _lorentz.Scene) -> Scene:
    """The Scene for an object of the extension module."""
    scene = Scene.__new__(Scene)
    scene._scene, scene._oracle, scene._name = native_scene, None, None
    return scene


def common_radius(scene: Scene) -> Number | None:
    """The radius of all obstacles; None if they have several, or are ellipsoids."""
    radii = {atom.get("radius") for lattice in scene.to_dict()["lattices"] for atom in lattice["atoms"]}
    return radii.pop() if len(radii) == 1 else None


def _read(source: SceneLike) -> _lorentz.Scene:
    if isinstance(source, Scene):
        return source._scene
    if isinstance(source, Mapping):
        return _lorentz.Scene.from_json(text({"scene": dict(source)}))
    if not isinstance(source, (str, os.PathLike)):
        raise Error(f"scene: {source!r} is not a Scene, a dict, a file or a name of the catalogue")
    scene = _lorentz.Scene.load(os.fspath(source))
    # A text such as "0.25" in a file is a float, too.
    return scene if scene.is_binary64 else _lorentz.Scene.from_json(text({"scene": scene.to_dict()}))


def _frozen(value: Any) -> Any:
    """Lists and dicts as tuples, whose hashes are equal for equal numbers of any type."""
    if isinstance(value, dict):
        return tuple((key, _frozen(value[key])) for key in sorted(value))
    return tuple(map(_frozen, value)) if isinstance(value, (list, tuple)) else value


def _with_radius(scene: dict[str, Any], radius: Number) -> dict[str, Any]:
    for lattice in scene["lattices"]:
        for atom in lattice["atoms"]:
            if "semiaxes" in atom:
                raise Error("radius: the scene has ellipsoids, which have no radius to override")
            atom["radius"] = radius
    return scene
