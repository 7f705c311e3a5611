"""What wrong_specs.py, wrong_models.py and bounds/wrong.py share: each plants mistakes, and Coq must refuse a proof of each.
Exit status: 0 all refused, 1 one was not, 2 bad usage, 3 one could not be tried."""
import argparse, concurrent.futures, os, random, sys

class NotTried(Exception):
    """No verdict."""

def plant(path, old, new):
    """Writes `new` in place of `old`, which the file has once."""
    text = path.read_text()
    if text.count(old) != 1: raise NotTried(f"{text.count(old)} places to plant it")
    path.write_text(text.replace(old, new))

def main(description, wrong, refused_by, unchanged):
    """`wrong`: name: mistake. `refused_by(mistake)`: who refuses it, None if it is accepted; throws NotTried.
    `unchanged`: a change that is not a mistake, which must be accepted."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--count", type=int, help=f"how many of the {len(wrong)}, by chance (default: all)")
    parser.add_argument("--seed", type=int, default=1, help="of that chance (default: 1)")
    options = parser.parse_args()
    if unknown := [name for name in options.names if name not in wrong]: parser.error(f"nothing is called {unknown[0]!r}")
    names = options.names or [*wrong]
    if options.count is not None: names = random.Random(options.seed).sample(names, min(options.count, len(names)))

    def attempt(mistake):
        try: return refused_by(mistake), None
        except NotTried as why: return None, str(why)

    by, why = attempt(unchanged)
    if by or why:
        print(f"without a mistake it is not accepted: {by or why}", file=sys.stderr)
        return 3
    accepted = failed = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, (by, why) in zip(names, pool.map(lambda name: attempt(wrong[name]), names)):
            accepted += by is None and why is None
            failed += why is not None
            print(f"{name:32} {f'refused by {by}' if by else f'NOT TRIED: {why}' if why else 'ACCEPTED'}", flush=True)
    print(f"{len(names)} mistakes: {len(names) - accepted - failed} refused, {accepted} accepted, {failed} not tried")
    return 1 if accepted else 3 if failed else 0
