"""Verifies golden sets by their certificates (docs/certificates.md) in plain integers; shares nothing with the program.
Usage: check.py FILE... ("-": stdin). Exit: 0 verified, 1 refuted, 2 bad input. Not looked at: `margin`, `condition`,
`time_change`, `acceptable`, `comment`, `source_id`."""
import fractions, functools, hashlib, json, math, operator, re, sys
LINE, DEEPEST, LONGEST, EXPONENT, STEPS = 2**25, 64, 2500, 2**14, 10**6  # the limits
def require(condition, flaw):  # where something is missing or of a wrong type, Python's own errors say so
    if not condition: raise ValueError(flaw)
# ---- READ. Numbers are integers in units of 2^-1074, as every binary64 is. What is planar gets a third coordinate.
HEXADECIMAL = "([+-]?0[xX][0-9a-fA-F]*)[.]?([0-9a-fA-F]*)(?:[pP]([+-]?[0-9]+))?"  # with a digit at least
def number(value):
    if type(value) is str and re.fullmatch(HEXADECIMAL, value): value = float.fromhex(value)
    require(type(value) in (int, float), f"no number: {value!r:.40}")
    return int(fractions.Fraction(float(value)) * 2**1074)  # an error, if it is not finite
def integer(value):  # 27, 27.0, 2.7e1, "27"
    if type(value) is float: whole = value % 1 == 0 and abs(value) <= 2**53
    else: whole = len(str(value)) <= LONGEST and re.fullmatch("-?[0-9]+", str(value))
    return require(whole, f"no integer: {value!r:.40}") or int(value)
def bound(end, last=False):  # a window's: in hexadecimal, exact; the last may be "inf"
    if last and end == "inf": return math.inf
    if type(end) is not str: return fractions.Fraction(number(end), 2**1074)
    require(len(end) <= LONGEST, "the end of a window is too long")
    whole, part, power = re.fullmatch(HEXADECIMAL, end).groups()
    require(abs(p := int(power or 0) - 4 * len(part)) <= EXPONENT, f"an exponent beyond {EXPONENT}")
    return int(whole + part, 16) * fractions.Fraction(2)**p
def vector(value, size, read, rest=0):
    require(type(value) is list and len(value) == size, f"no array of {size} items: {value!r:.40}")
    return tuple(read(item) for item in value) + (rest,) * (3 - size)
def matrix(value, size, read): return list(vector(value, size, lambda row: vector(row, size, read))[:size])
def obstacle(box, ranks):
    return (l := integer(box["lattice"])), (a := integer(box["atom"])), vector(box["cell"], ranks[l, a], integer)
def read_scene(scene):
    size, atoms = {2 << 1074: 2, 3 << 1074: 3}[number(scene["dimension"])], {}
    require(scene["lattices"] and all(u["atoms"] for u in scene["lattices"]), "an empty scene")
    for l, lattice in enumerate(scene["lattices"]):
        for a, atom in enumerate(lattice["atoms"]):
            r, b = number(atom.get("radius", 1)), [vector(row, size, number) for row in lattice["vectors"]]
            A = matrix(atom["semiaxes"], size, number) if "semiaxes" in atom else [(r, 0, 0)]
            volume = independent(A) if "semiaxes" in atom else r > 0
            require(volume and independent(b) and ("radius" in atom) != ("semiaxes" in atom), "no volume or shape")
            atoms[l, a] = A, *b, vector(atom["position"], size, number)
    return size, atoms, unit(c for A, *vectors in atoms.values() for y in (*A, *vectors) for c in y)
# ---- SCALE. The largest power of two common to all numbers goes. M = adj(A) = det(A) A^-1 takes an ellipsoid p + A y,
# |y| < 1, to a ball of radius r = |det A|, and integers to integers; of a ball, M = 1. A planar gas becomes the plane
# z = 0 of a spatial one, discs the equators of balls. A lattice of k vectors is one of three, of which n uses k.
def unit(numbers): bits = functools.reduce(operator.or_, numbers); return bits & -bits
def dot(a, b): return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
def cross(a, b): return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
def det(a, b, c): return dot(a, cross(b, c))
def independent(b): return any((1,) if not b else b[0] if len(b) == 1 else cross(*b) if len(b) == 2 else (det(*b),))
def add(w, k, b): return w[0] + k * b[0], w[1] + k * b[1], w[2] + k * b[2]
def combine(n, b): return add(add(add((0, 0, 0), n[0], b[0]), n[1], b[1]), n[2], b[2])
def read_query(query, size, atoms, factor):  # `from`; k; by atom, in its coordinates: v, v^2, r^2 v^2, w_0, lattice, k
    x, v, balls = vector(query["x"], size, number), vector(query["v"], size, number), {}
    ranks = {key: len(vectors) - 1 for key, (A, *vectors) in atoms.items()}
    leaving = obstacle(query["from"], ranks) if "from" in query else None
    require(any(v), "v is zero")
    factor = unit((factor, *x, *v))
    for key, (A, *vectors) in atoms.items():
        A, vectors = [[[c // factor for c in y] for y in some] for some in (A, (*vectors, x, v))]
        a1, a2, a3 = [*A, (0, 0, 1)][:3] if len(A) > 1 else ((1, 0, 0), (0, 1, 0), (0, 0, 1))
        M, r = (cross(a2, a3), cross(a3, a1), cross(a1, a2)), abs(det(a1, a2, a3)) if len(A) > 1 else A[0][0]
        *b, p, x1, v1 = [[dot(row, y) for row in M] for y in vectors]
        balls[key] = v1, dot(v1, v1), r**2 * dot(v1, v1), add(p, -1, x1), (b + [(0, 0, 0)] * 3)[:3], len(b)
    return leaving, ranks, balls
# ---- SEARCH. Of an obstacle at w from x let s = v.w, h = v x w, D = r^2 v^2 - h^2. The line meets it iff D > 0, at the
# times (s -+ sqrt D) / v^2; it contains x iff s^2 < D, for s^2 + h^2 = v^2 w^2.
def spend(left, steps):
    left[0] -= steps
    require(left[0] >= 0, f"too many pieces, planes, rows and obstacles: more than {STEPS} steps")
def common(bounds, left):  # the k with low <= start + k step <= high, of all bounds that have a step; None: no bound
    turned = [b if b[3] > 0 else (None if b[1] is None else -b[1], -b[0], -b[2], -b[3]) for b in bounds if b[3]]
    first = max(-((start - low) // step) for low, _, start, step in turned if low is not None)
    stop = min((high - start) // step + 1 for _, high, start, step in turned if high is not None)
    spend(left, max(stop - first, 0))
    return range(first, stop)
def one(left): return spend(left, 1) or range(1)
def met(ball, basis, low, high, left):
    """All (s, D, n) with D > 0, low <= s <= high (and some beyond); no `high`: no end. In integers h^2 < r^2 v^2 is
    h^2 <= H. For any a, v^2 a.w - s a.v = a.(v^2 w - s v) is at most |v x a| |h|: what is in brackets is across v, and
    |v| |h| long."""
    def bounds(a, w, b, room, first=low, last=high):  # of v^2 a.(w + k b), where (|v x a| |h|)^2 <= room
        if last is None: return None, None, 0, 0
        ends, r = (first * dot(a, v), last * dot(a, v)), math.isqrt(max(room, 0))
        return min(ends) - r, max(ends) + r, Q * dot(a, w), Q * dot(a, b)
    def ranging(i, *bounds): return common(bounds, left) if i <= rank else one(left)
    (v, Q, R, w, u, rank), H = ball, ball[2] - 1
    b1, b2, b3 = [combine(n, u) for n in basis]
    N, s1, h1 = cross(b1, b2), dot(v, b1), cross(v, b1)  # N.w depends on k3 only
    a, hh = cross(b1, cross(v, e := cross(v, N))), dot(h1, h1)  # k3 given, a.w and h1.w depend on k2 only
    for k3 in ranging(3, bounds(N, w, b3, H * dot(e, e))):
        near, far, Nw, _ = bounds(N, w3 := add(w, k3, b3), b3, 0, low, high or 0)
        off = max(near - Nw, Nw - far, 0)  # v^2 (e.w)^2 + (s N.v - v^2 N.w)^2 = |e|^2 h^2, and a = (e.b1) v - s1 e
        room = s1**2 * Q * (H * dot(e, e) - off**2)
        for k2 in ranging(2, bounds(h1, w3, b2, H * Q * hh, 0, 0), bounds(a, w3, b2, room)):  # h1.v = 0
            s, f = dot(v, w2 := add(w3, k2, b2)), dot(h1, h := cross(v, w2))
            g = dot(h, h) - H  # h^2 - H = hh k1^2 + 2 f k1 + g <= 0
            root = math.isqrt(max(f * f - hh * g, 0))
            for k1 in ranging(1, (-root, root, f, hh), (low, high, s, s1)):
                if (D := 1 - g - k1 * (2 * f + k1 * hh)) > 0: yield s + k1 * s1, D, combine((k1, k2, k3), basis)
# ---- JUDGE. A time is a triple (s, D, Q): (s - sqrt D) / Q.
def sign(a, b, c):  # of a + sqrt b - sqrt c; if a >= 0, of 2 a sqrt b - z
    z = c - a * a - b
    return -sign(-a, c, b) if a < 0 else 1 if z < 0 else (4 * a * a * b > z * z) - (4 * a * a * b < z * z)
def order(t, u): return sign(t[0] * u[2] - u[0] * t[2], u[1] * t[2]**2, t[1] * u[2]**2)  # the sign of t - u
def entry(t): return lambda p, q: order(t, (p, 0, q))  # the sign of t - p / q
def exit_at(s, D, Q): return lambda p, q: order((-p, 0, q), (-s, D, Q))  # of (s + sqrt D) / Q - p / q
def rounds(order_to, n, base, k, digits):
    """Does a time round to n base^k? So it is between the midpoints to its neighbours, or at one if n is even. The lower
    one of a power of the base is closer (of 2^-1022, it is not); "inf" stands for 2^1024, and has none above."""
    side = 1 if n == base**(digits - 1) and (base, k) != (2, -1074) else base
    up, down = base**max(k, 0), 2 * base**(1 + max(-k, 0))
    return order_to((2 * base * n - side) * up, down) >= n % 2 and (
        (base, k) == (2, 972) or order_to((2 * base * n + base) * up, down) <= -(n % 2))
def check_double(order_to, time, name):
    k = max((n := 2**2098 if time == "inf" else number(time)).bit_length() - 53, 0)
    require(str(time)[0] != "-" and rounds(order_to, n >> k, 2, k - 1074, 53), f"{name} is not correctly rounded")
def check_decimal(t, text):
    require(len(text) <= LONGEST, "time_decimal is too long")
    whole, part, power = re.fullmatch("([0-9]+)(?:[.]([0-9]+))?(?:e([+-][0-9]{1,4}))?", text).groups("")
    n, k = (whole + part).lstrip("0"), int(power or 0) - len(part)
    require(len(n) == 40 and rounds(entry(t), int(n), 10, k, 40) if t[0]**2 > t[1] else text == "0", "time_decimal is wrong")
def verify(record, scene):
    outcome, size = record["expect"]["outcome"], scene[0]
    own = {"hit": "lattice atom cell time time_decimal", "inside": "lattice atom cell"}.get(str(outcome), "").split()
    has = {*record["expect"]} & {"id", "lattice", "atom", "cell", "time"} | {*record} & {"time_decimal"}
    require(has == {*own} and (outcome != "error" or "certificate" not in record), f"keys: {outcome!r:.20} has {own}")
    require({type(record["expect"].get(key, "")) for key in ("message", "reason")} == {str}, "a message is no string")
    require(own or "exit_time" not in record["expect"], f"keys: {outcome!r:.20} has no exit_time")
    try: leaving, ranks, balls = read_query(record, *scene)
    except Exception as flaw: return require(outcome == "error", flaw)
    require(outcome in ("hit", "inside", "never"), f"the outcome is not {outcome!r:.20}")
    kinds = sorted({"rows", "windows"} & {*record["certificate"]}, reverse=True)
    pieces = [(kind == "rows", piece) for kind in kinds for piece in record["certificate"][kind]]
    require(kinds and (outcome == "never" or not any(row for row, _ in pieces)), "rows prove `never` only")
    spend(left := [STEPS], 10 * len(pieces))
    X, time, ends = outcome != "never" and obstacle(record["expect"], ranks), (0, 0, 1), {}
    if X:
        v, Q, R, w, u, _ = balls[X[:2]]
        s, h = dot(v, w := add(w, 1, combine(X[2], u))), cross(v, w)
        D = R - dot(h, h)
        claim = s * s < D if outcome == "inside" else s > 0 and s * s >= D > 0
        require(claim and X != leaving, f"{X} is no {outcome}")
        if "exit_time" in record["expect"]: check_double(exit_at(s, D, Q), record["expect"]["exit_time"], "exit_time")
    if outcome == "hit": time = s, D, Q
    for row, piece in pieces:
        v, Q, R, _, u, k = balls[key := (integer(piece["lattice"]), integer(piece["atom"]))]
        basis = matrix(piece["basis"], k, integer) + [(1, 0, 0), (0, 1, 0), (0, 0, 1)][k:]
        require(abs(det(*basis)) == 1, "a determinant is not +-1: obstacles are missing")
        if row:  # of a row along v that is met, obstacles b_1 apart are: one in every period of s
            require(k and not any(cross(v, along := combine(basis[0], u))), "b_1 is not along v")
            require(key not in ends, f"rows of {key}, and more rows or windows")
            low, high, end = 0, abs(dot(v, along)), math.inf
        else:
            begin, end = bound(piece["from"]), bound(piece["to"], True)
            starts = begin < 0 and (begin * Q)**2 >= R or begin <= ends.get(key, begin - 1)  # at or below -r / |v|
            require(starts and begin <= end, f"{key}: a gap before {piece['from']!r:.40}")
            low, high = math.ceil(begin * Q), None if end == math.inf else math.floor(end * Q)
        ends[key] = max(ends.get(key, end), end)
        for s, D, n in met(balls[key], basis, low, high, left):
            Y = *key, n
            when = -1 if s * s < D else 1 if s <= 0 or outcome == "inside" else order((s, D, Q), time) if X else 0
            first = row or Y != leaving and (when, Y) < (-(outcome == "inside"), X or (math.inf,))
            if first: raise ValueError(f"{Y} comes first, or is met")  # not `require`: this is long
    for key, (_, Q, R, *_) in balls.items():  # end - r / |v| against 0, or the time of X
        if outcome == "inside" and key > X[:2] or ends.get(key) == math.inf: continue
        p, q = ends.get(key, -1).as_integer_ratio()
        require(X or key in ends, f"no rows of {key}, and no windows")
        require(X and order((p * Q, R * q * q, q * Q), time) >= 0, f"{key}: a gap")
    if outcome != "hit": return
    check_double(entry(time), record["expect"]["time"], "time"), check_decimal(time, record["time_decimal"])
def depth(x): return type(x) in (dict, list) and 1 + max(map(depth, x.values() if type(x) is dict else x), default=0)
def read(text):  # ---- FILES. A line's object, and its keys in order: the outermost object ends last.
    def members(pairs):
        keys[:] = [key for key, _ in pairs]
        if len(box := dict(pairs)) < len(keys): raise ValueError(f"a key comes twice among {keys!r:.99}")
        return box
    def whole(n): return -0.0 if n == "-0" else int(n) if len(n) <= LONGEST else math.inf
    keys = []
    box = json.loads(text.decode(), object_pairs_hook=members, parse_int=whole, parse_constant=integer)
    json.dumps(box, ensure_ascii=False).encode()  # an error where half a surrogate stands alone
    return require(type(box) is dict and depth(box) <= DEEPEST, "no object, or nested too deep") or (box, keys)
def lines(name):  # bytes without their ends; None: too long
    with open(0 if name == "-" else name, "rb") as file:
        while line := file.readline(LINE + 1):
            long = rest = len(line) > LINE and line[-1:] != b"\n"
            while rest: rest = (part := file.readline(LINE)) and part[-1:] != b"\n"
            yield None if long else line.rstrip(b"\r\n")
def check(name):
    flaws, records, ids, scene, text, version, count, tags = [], 0, set(), None, b"", None, None, ()
    for i, line in enumerate(lines(name), 1):
        identity = None
        try:
            require(line is not None, "a line is too long")
            if i == 1: line = line.removeprefix(b"\xef\xbb\xbf")
            if i > 1 and not line.strip(b" \t\r"): continue
            box, keys = read(line)
            require((i == 1) == ("golden" in box), "a golden set begins with its header, and has one")
            if i == 1:
                version, count, tags = integer((head := box["golden"])["format"]), integer(head["count"]), head["tags"]
                named = [head[key] for key in ("name", "description", "generator", "version") if key in head]
                require({*map(type, named + [*tags.values()])} <= {str}, "names and tags are explained in strings")
                require(head.get("precision", "binary64") in ("binary64", "binary32"), "unknown precision")
            elif "scene" in box:
                require(not {"id", "x", "v", "from"} & {*box}, "a scene's line with a key of a record")
                scene, text = read_scene(box["scene"]), line
            else:
                records, identity = records + 1, box["id"]
                question = line[line.index(b'],"') + 2:line.index(b',"expect"')]
                asked, n = ["id", "tags", *read(b"{%b}" % question)[1]], keys.index("expect")
                require(n > 2 and keys[:n] == asked and not {"x", "v", "from"} & {*keys[n:]}, "the order of the keys")
                require(hashlib.sha256(text + b"\n" + question).hexdigest()[:16] == identity, "the id does not belong")
                require(identity not in ids and not ids.add(identity), "the id is there twice")
                require(type(box["tags"]) is list and box["tags"] and {*box["tags"]} <= {*tags}, "unknown tags")
                verify(box, scene)
        except Exception as e: flaws.append((2 - bool(identity), f"{name}:{i}: {identity}: {type(e).__name__}: {e}"))
    if version not in (1, 2) or count != records:
        flaws.append((1 + (version not in (1, 2)), f"{name}:1: format {version} with {count} records, not {records} of 1 or 2"))
    print(*[flaw for _, flaw in flaws] or [f"{name}: {records} records, all verified"], sep="\n")
    return max(flaws, default=(0,))[0]
if __name__ == "__main__":
    try: sys.exit(max(map(check, sys.argv[1:])))
    except (OSError, ValueError) as flaw: sys.exit(print(flaw, __doc__, sep="\n", file=sys.stderr) or 2)
