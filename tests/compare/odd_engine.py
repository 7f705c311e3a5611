"""An engine with one fault. It answers a query that starts at (k, ...) with a hit in cell (k, 0) at time k; its fault
(the first argument) shows at k = 5, or at the k that is its second argument."""
import json
import os
import signal
import sys
import time

FAULT = sys.argv[1]
AT = int(sys.argv[2]) if len(sys.argv) > 2 else 5
FLUSHES = not FAULT.endswith("buffered")


def write(text, end="\n"):
    sys.stdout.write(text + end)
    if FLUSHES:
        sys.stdout.flush()


def answer(query, **other):
    k = int(query["x"][0])
    hit = {"id": query["id"], "outcome": "hit", "lattice": 0, "atom": 0, "cell": [k, 0], "time": k}
    return json.dumps(hit | other)


def fail(query):
    """What it does instead of answering."""
    if FAULT.startswith("dies"):
        os._exit(3)  # what is buffered is lost
    elif FAULT == "ends":
        sys.exit(0)
    elif FAULT == "crashes":
        os.kill(os.getpid(), signal.SIGSEGV)
    elif FAULT == "closes-output":
        os.close(1)
        time.sleep(1000)
    elif FAULT == "garbage":
        write("rubbish")
    elif FAULT == "long-line":
        write("x" * 3_000_000)
    elif FAULT == "half":
        write('{"id":%d,"outcome":"hit"}' % query["id"])
    elif FAULT == "leaves":
        write(answer(query))
        sys.exit(0)
    elif FAULT == "swaps":
        write(answer(json.loads(sys.stdin.readline())))
        write(answer(query))
    elif FAULT == "twice":
        write(answer(query))
        write(answer(query))
    elif FAULT == "unknown-id":
        write(answer(query, id=123456))
    elif FAULT == "dimension":
        write(answer(query, cell=[5, 0, 0]))
    elif FAULT == "no-such-atom":
        write(answer(query, atom=7))
    elif FAULT == "no-such-lattice":
        write(answer(query, lattice=1))
    elif FAULT == "nameless":
        write('{"id":null,"outcome":"error","message":"not mine"}')
    elif FAULT == "own-keys":
        write(answer(query, **{f"own{n}": n for n in range(30)}))
        write(answer(json.loads(sys.stdin.readline()), own1=1))
    elif FAULT.startswith("skips"):
        pass
    elif FAULT == "garbage-skips":  # this one and the next
        write("rubbish")
        sys.stdin.readline()
    else:
        write(answer(query))


answered, at_end, scene = 0, [], None
if FAULT == "talks":
    write("loading, please wait")
for line in sys.stdin:
    query = json.loads(line)
    if "scene" in query:
        scene = query["scene"]
        if FAULT == "refuses-scene":
            write('{"id":null,"outcome":"error","message":"too wild a scene"}')
        continue
    if not scene:
        sys.exit("no scene")
    if FAULT == "complains":
        sys.stderr.write("!" * 100_000 + "\n")
    if FAULT == "ends-after" and answered == AT:
        sys.exit(4)
    answered += 1
    if FAULT == "skips-later" and answered == 3:
        write("rubbish")
    if FAULT == "at-end":
        at_end.append(answer(query))
    elif int(query["x"][0]) == AT:
        fail(query)
    else:
        write(answer(query))
write("\n".join(at_end), end="")
if FAULT == "bad-exit":
    sys.exit(9)
if FAULT == "stays":
    time.sleep(1000)
