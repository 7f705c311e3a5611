"""Arrays in a graphics card's memory, without a card: a driver of the tests flies on the processor (tests/gpu)."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import lorentz

ROOT = Path(__file__).parents[2]

#: What runs with that driver, whose memory is this machine's.
SCRIPT = '''
import numpy as np
import lorentz

class Array:
    """NumPy's memory, as if it were a card's."""
    def __init__(self, numbers):
        its = dict(numbers.__array_interface__, version=3)
        self.numbers, self.__cuda_array_interface__ = numbers, {name: its[name] for name in ("shape", "strides", "typestr",
                                                                                             "data", "version")}

def same(there, here):
    assert len(there) == len(here)
    hit = here.outcome == lorentz.Outcome.HIT
    assert hit.sum() > len(here) / 2
    for name in ("outcome", "atom"):
        assert (np.asarray(getattr(there, name)) == getattr(here, name)).all(), name
    assert (np.asarray(there.lattice)[hit] == here.lattice[hit]).all()
    assert (np.asarray(there.lattice)[here.outcome == lorentz.Outcome.LATER] == -1).all()
    assert np.asarray(there.cell).shape == here.cell.shape and (np.asarray(there.cell) == here.cell).all()
    assert (np.asarray(there.time) == np.where(hit, here.time, 0)).all()
    view = there.cell.__cuda_array_interface__
    assert view["shape"] == here.cell.shape and view["strides"] == (8, 8 * len(here))

for name, radius in (("square", 1e-5), ("fcc", 0.1), ("perovskite", 0.02), ("superposition-pi-7", 0.02)):
    scene = lorentz.Scene(name, radius)
    x, v, _ = lorentz.draw_starts(scene, 20000, seed=3)
    x[:3] = 0  # inside of an obstacle
    v[:2000] = np.round(8 * v[:2000]) / 8 + (np.abs(v[:2000]) < 0.06)  # hard
    engine = lorentz.Engine(scene, "gpu")
    here = lorentz.first_hit(scene, x, v)
    columns = np.asfortranarray(x)
    there = engine.first_hit(Array(columns), Array(v))
    same(there, here)
    same(lorentz.first_hit(scene, Array(x), Array(v), engine="gpu"), here)
    # From each hit on, with a limit.
    hit = here.outcome == lorentz.Outcome.HIT
    x2 = np.where(hit[:, None], x + here.time[:, None] * v, x)
    limits = np.where(np.arange(len(x)) % 2, 2 * np.nan_to_num(here.time, nan=1.0), np.inf)
    v2 = np.ascontiguousarray(v[:, ::-1])
    same(engine.first_hit(Array(x2), Array(v2), max_time=Array(limits), start_from=there),
         lorentz.first_hit(scene, x2, v2, max_time=limits, start_from=here))

def refused(part, *question, **options):
    try:
        lorentz.first_hit("square", *question, **dict(dict(radius=0.1, engine="gpu"), **options))
    except lorentz.Error as error:
        assert part in str(error), error
    else:
        raise AssertionError(part)

x, v = np.full((3, 2), 0.5), np.ones((3, 2))
refused("row 1: v is zero", Array(x), Array(v * [[1], [0], [1]]))
marked = lorentz.first_hit("square", Array(x), Array(v * [[1], [0], [1]]), 0.1, engine="gpu", on_error="mark")
assert marked.reasons == {1: "v is zero: the particle needs a direction"} and np.asarray(marked.outcome).tolist() == [0, 5, 0]
refused("v: is not in the card's memory", Array(x), v)
refused("needs (3, 2) of <f8", Array(x), Array(v[:2].copy()))
refused("needs (3, 2) of <f8", Array(x.astype("f4")), Array(v))
refused("which the engine gpu takes", Array(x), Array(v), engine="batch")
refused("start_from", Array(x), Array(v), start_from=(0, 0, (0, 0)))
refused("max_time: is not in the card's memory", Array(x), Array(v), max_time=3.0)
refused("row 2: max_time must be above zero", Array(x), Array(v), max_time=Array(np.array([1.0, np.inf, 0.0])))
in_space = lorentz.first_hit("cubic", Array(np.full((3, 3), 0.5)), Array(np.ones((3, 3))), 0.1, engine="gpu")
refused("in 2 dimensions", Array(x), Array(v), start_from=in_space)
masked = Array(x)
masked.__cuda_array_interface__["mask"] = Array(x)
refused("masked", masked, Array(v))
print("done")
'''


@pytest.fixture(scope="module")
def driver(tmp_path_factory):
    """The folder of the tests' libcuda.so.1."""
    folder = tmp_path_factory.mktemp("card")
    subprocess.run(["c++", "-std=c++20", "-O1", "-ffp-contract=off", "-fPIC", "-shared", "-w", f"-I{ROOT}", f"-I{ROOT}/include",
                    "-o", folder / "libcuda.so.1", ROOT / "tests/gpu/fake_driver.cpp"], check=True)
    return folder


def test_arrays_in_a_cards_memory(driver):
    done = subprocess.run([sys.executable, "-c", SCRIPT], capture_output=True, text=True,
                          env=dict(os.environ, LD_LIBRARY_PATH=str(driver)))
    if "no kernels for graphics cards" in done.stderr:
        pytest.skip("this build has no kernels")
    assert (done.returncode, done.stdout) == (0, "done\n"), done.stderr


def test_without_a_card_a_sentence_says_so():
    if [*Path("/dev").glob("nvidia[0-9]*")]:
        pytest.skip("there is a card")
    with pytest.raises(lorentz.Error, match="certified-batch|clang"):
        lorentz.Engine("square", "gpu")


def test_other_engines_take_no_arrays_in_a_cards_memory():
    with pytest.raises(lorentz.Error, match="which the engine gpu takes"):
        class There:
            __cuda_array_interface__ = {"shape": (1, 2), "typestr": "<f8", "data": (0, True), "version": 3}
        lorentz.first_hit("square", There(), There(), 0.1)
