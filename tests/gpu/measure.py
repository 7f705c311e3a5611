"""Flights on this machine's graphics card: the same results as on its processor, and how long they take.

measure.py PROGRAM [--share S] [--long] [--page FILE]: writes the tables into FILE, between its lines "<!-- table -->". S: the
share of the flights that are flown (1). --long flies 10^12 flights, too (two minutes). Times of a flight are differences of
two runs, so what a run takes to begin is not in them. Status 1 if a result differs.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path

CASES = [("square", 0.1, 5e8), ("square", 1e-3, 5e8), ("square", 1e-6, 5e8), ("triangular", 0.1, 5e8),
         ("triangular", 1e-3, 5e8), ("cubic", 0.1, 5e7), ("cubic", 1e-3, 5e7), ("cubic", 1e-6, 5e7), ("fcc", 0.1, 5e7),
         ("fcc", 1e-3, 5e7), ("superposition-pi-5", 1e-4, 5e7), ("perovskite", 0.02, 5e6)]


def flights(program, scene, radius, count, engine, jobs):
    done = subprocess.run([program, "flights", "--scene", scene, "--radius", str(radius), "--count", str(int(count)),
                           "--engine", engine, "--jobs", str(jobs), "--json"], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(done.stderr)
    found = json.loads(done.stdout)
    return found.pop("seconds"), found


def time_of_flight(program, scene, radius, count, engine, jobs):
    """Nanoseconds: the median of three, and their spread."""
    times = []
    for _ in range(3):
        few, _ = flights(program, scene, radius, count / 10, engine, jobs)
        many, _ = flights(program, scene, radius, count, engine, jobs)
        times.append((many - few) / (0.9 * count) * 1e9)
    return statistics.median(times), max(times) - min(times)


def columns(program, scene, radius, count):
    """Nanoseconds a query by `gpu` and by one thread, from the processor's memory and back."""
    done = subprocess.run([program, "compare", "--scene", scene, "--radius", str(radius), "--count", str(count), "--engine",
                           "gpu,certified-batch", "--no-oracle", "--json"], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(done.stderr)
    return [engine["ns_per_query"] for engine in json.loads(done.stdout)["engines"]]


def main():
    options = argparse.ArgumentParser()
    options.add_argument("program")
    options.add_argument("--share", type=float, default=1)
    options.add_argument("--long", action="store_true")
    options.add_argument("--page", type=Path)
    options = options.parse_args()
    jobs = len(os.sched_getaffinity(0))
    try:
        card = subprocess.run(["nvidia-smi", "--query-gpu=name", "--format=csv,noheader"], capture_output=True, text=True,
                              check=True).stdout.splitlines()[0]
    except (OSError, subprocess.CalledProcessError, IndexError):
        card = "without a name"
    lines = [f"Card: {card}; processor: {jobs} threads.", "",
             f"| scene, radius | flights compared | card, ns a flight (spread of three) | {jobs} threads, ns | ratio |",
             "|---|---|---|---|---|"]
    differ = False
    for scene, radius, count in CASES:
        count = max(int(count * options.share), 100_000)
        here, there = (flights(options.program, scene, radius, count, engine, jobs)[1] for engine in ("certified-batch", "gpu"))
        differ |= here != there
        gpu, spread = time_of_flight(options.program, scene, radius, 4 * count, "gpu", jobs)
        processor, _ = time_of_flight(options.program, scene, radius, count, "certified-batch", jobs)
        lines.append(f"| {scene} {radius:g} | {count:.1e}: {'the same' if here == there else 'DIFFERENT'} | "
                     f"{gpu:.3f} ({spread:.3f}) | {processor:.2f} | {processor / gpu:.0f} |")
        print(lines[-1], flush=True)
    lines += ["", "Queries in columns, from the processor's memory and back:", "",
              "| scene, radius | card, ns a query | one thread, ns |", "|---|---|---|"]
    for scene, radius in (("square", 1e-3), ("cubic", 0.1), ("cubic", 1e-6), ("fcc", 1e-3)):
        gpu, processor = columns(options.program, scene, radius, max(int(3e6 * options.share), 100_000))
        lines.append(f"| {scene} {radius:g} | {gpu:.1f} | {processor:.1f} |")
        print(lines[-1], flush=True)
    if options.long:
        count = max(1e12 * options.share, 100_000)
        seconds, found = flights(options.program, "square", 1e-4, count, "gpu", jobs)
        lines += ["", f"{count:.0e} flights at square 1e-4: {seconds:.0f} s, mean of ln t {found['mean_log']:.6f}, p-value of the "
                  f"limit law {found['theory'][0]['p_value']:.2g}."]
        print(lines[-1], flush=True)
    if options.page:
        before, _, after = options.page.read_text().split("<!-- table -->\n")
        options.page.write_text("<!-- table -->\n".join([before, "\n".join(lines) + "\n", after]))
    return 1 if differ else 0


sys.exit(main())
