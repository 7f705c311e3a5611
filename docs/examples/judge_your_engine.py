"""Judges an engine of your own: here one that goes along the line in small steps, in the square lattice."""
import lorentz
import numpy as np
from numpy.typing import NDArray


def engine(scene: lorentz.Scene, x: NDArray[np.float64], v: NDArray[np.float64],
           start_from: lorentz.Obstacle | None) -> lorentz.Answer:
    if scene != lorentz.unit_scene(2, 0.1) or not 1e-9 < abs(v).max() < 1e9:
        return lorentz.unsupported("discs of radius 0.1 on the square lattice only")
    for step in range(20_000):
        t = step / 1000 / abs(v).max()
        cell = (x + t * v).round()
        if ((x + t * v - cell) ** 2).sum() < 0.01 and start_from != (0, 0, tuple(cell)):
            return lorentz.hit(t, cell)
    return lorentz.undecided()


if __name__ == "__main__":
    report = lorentz.judge(engine, time=10)
    print(report["text"])
