"""Holds three checkers of certificates against each other: oracle/proof/check, data/check.py, and `lorentz golden
verify`. Half of the records are tampered with in their values (each has the id of its question, so all of
them get as far as its proof), half in their form: keys, numbers, texts, the ends of windows, what is around
them.

python3 oracle/proof/differential.py PROGRAM COUNT [SEED [SET..]]    (sets: all that are committed)
exit status: 0 they agree, 1 they don't (the records are printed)"""
import collections, contextlib, fractions, hashlib, importlib.util, io, json, math, pathlib, random, re
import subprocess, sys, tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SPEC = importlib.util.spec_from_file_location("check", ROOT / "data" / "check.py")
check = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(check)
BATCH = 1000  # records
# What takes more steps is refused by two of them, and not given to the third: hostile proofs are for other
# tests.
check.STEPS = 2000

def compact(value):
    return json.dumps(value, separators=(",", ":"), allow_nan=False)  # ValueError: no way to tamper

def records_of(paths):
    """(scene line, record) of these golden sets, but for errors. Without exit_time: no theorem is about it, and
    oracle/proof/check passes over it."""
    for path in paths or sorted((ROOT / "data" / "golden").glob("*.ndjson")):
        for line in pathlib.Path(path).read_text().splitlines()[1:]:
            if line.startswith('{"scene"'):
                scene = line
            elif '"outcome":"error"' not in line:
                yield scene, re.sub(r',"exit_time":[^,}]+', "", line)

# ---- Ways to tamper. Each changes the record in place, or raises where it can't.
def nudge(x, rng):
    if rng.random() < .3: return math.nextafter(x, rng.choice((math.inf, -math.inf)))
    return x * (1 + rng.choice((-1, 1)) * 2.0**-rng.randrange(1, 50))
def nudge_end(end, rng):
    if type(end) is not str: return nudge(float(end), rng)
    mantissa, power = end.split("p")
    return hex(int(mantissa, 16) + rng.choice((-1, 1)) * 2**rng.randrange(40)) + "p" + power
def pieces(record): return next(iter(record["certificate"].values()))
def shift(values, rng, steps=(-1, 1)):
    i = rng.randrange(len(values))
    values[i] = int(values[i]) + rng.choice(steps)
def claimed_cell(record, rng): shift(record["expect"]["cell"], rng)
def atom_beside(box, rng, scene):  # one that exists: of others `golden verify` reads no further
    lattices = json.loads(scene)["scene"]["lattices"]
    l = box["lattice"]
    a = (box["atom"] + 1) % len(lattices[l]["atoms"])
    if a == box["atom"]: l = (l + 1) % len(lattices)
    if (l, a) == (box["lattice"], box["atom"]) or a >= len(lattices[l]["atoms"]): raise KeyError
    box.update(lattice=l, atom=a)
def claimed_atom(record, rng, scene): atom_beside(record["expect"], rng, scene)
def start(record, rng):
    record["x"][rng.randrange(len(record["x"]))] += rng.choice((-1, 1)) * 2.0**rng.randrange(-50, 1)
def start_ulp(record, rng):
    i = rng.randrange(len(record["x"]))
    record["x"][i] = math.nextafter(record["x"][i], rng.choice((9e99, -9e99)))
def velocity(record, rng): i = rng.randrange(len(record["v"])); record["v"][i] = nudge(record["v"][i], rng)
def other_way(record, rng): record["v"] = [-c for c in record["v"]]
def scaled(record, rng): f = 2.0**rng.randrange(-40, 40); record["v"] = [c * f for c in record["v"]]
def basis_number(record, rng): shift(rng.choice(rng.choice(pieces(record))["basis"]), rng)
def basis_rows(record, rng): rng.shuffle(rng.choice(pieces(record))["basis"])
def basis_sheared(record, rng):
    rows = rng.choice(pieces(record))["basis"]
    (i, j), k = rng.sample(range(len(rows)), 2), rng.choice((-3, -1, 1, 2))
    rows[i] = [int(a) + k * int(b) for a, b in zip(rows[i], rows[j])]
def window_end(record, rng):
    window, key = rng.choice(pieces(record)), rng.choice(("from", "to"))
    window[key] = nudge_end(window[key], rng)
def window_without_end(record, rng):
    window = rng.choice(record["certificate"]["windows"])
    window["to"] = rng.choice((1e300, 0.0)) if window["to"] == "inf" else "inf"
def window_gone(record, rng): l = pieces(record); l.pop(rng.randrange(len(l)))
def window_twice(record, rng): l = pieces(record); l.insert(rng.randrange(len(l) + 1), dict(rng.choice(l)))
def window_order(record, rng): rng.shuffle(pieces(record))
def window_atom(record, rng, scene): atom_beside(rng.choice(pieces(record)), rng, scene)
def toggled_from(record, rng):
    if record.pop("from", None) is None: raise KeyError
def from_claimed(record, rng):
    record["from"] = {key: record["expect"][key] for key in ("lattice", "atom", "cell")}
def from_beside(record, rng):
    from_claimed(record, rng)
    record["from"]["cell"] = list(record["from"]["cell"])
    shift(record["from"]["cell"], rng)
def time_ulp(record, rng):
    t = record["expect"]["time"]
    t = 1.7976931348623157e308 if t == "inf" else math.nextafter(t, rng.choice((math.inf, -math.inf)))
    record["expect"]["time"] = "inf" if t == math.inf else abs(t)
def digit(record, rng):
    text = record["time_decimal"]
    i = rng.choice([i for i, c in enumerate(text) if c.isdigit()])
    record["time_decimal"] = text[:i] + str((int(text[i]) + rng.choice((1, 9))) % 10) + text[i + 1:]
def to_inside(record, rng):
    record["expect"].pop("time"), record.pop("time_decimal")
    record["expect"].update(outcome="inside")
def to_hit(record, rng):
    if record["expect"]["outcome"] != "inside": raise KeyError
    record["expect"].update(outcome="hit", time=0.0); record["time_decimal"] = "0"
WAYS = [claimed_cell, claimed_atom, start, start_ulp, velocity, other_way, scaled, basis_number, basis_rows,
        basis_sheared, window_end, window_without_end, window_gone, window_twice, window_order, window_atom, toggled_from,
        from_claimed, from_beside, time_ulp, digit, to_inside, to_hit]

def line_of(scene, record):
    question = compact({key: record[key] for key in ("x", "v", "from") if key in record})[1:-1]
    identity = hashlib.sha256(f"{scene}\n{question}".encode()).hexdigest()[:16]
    rest = compact({key: record[key] for key in record if key not in ("id", "tags", "x", "v", "from")})[1:]
    return f'{{"id":"{identity}","tags":["t"],{question},{rest}'

def tampered(cases, rng):
    while True:
        (scene, line), way = rng.choice(cases), rng.choice(WAYS)
        record = json.loads(line)
        with contextlib.suppress(KeyError, IndexError, ValueError, TypeError, AttributeError):
            way(record, rng, *[scene] * (way in (claimed_atom, window_atom)))
            return HEADER, scene.encode(), way.__name__, line_of(scene, record).encode()

# ---- Forms. A line is cut into tokens; each way changes a text, or raises where it can't.
TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|[-+.0-9eE]+|[a-z]+|[][{},:]')
SURE = ["null", "true", "[]", "{}", "0", "-0", "1e400", "-1e99999", '"\\u0000"', '"\\ud83d\\ude00"', '"\x7f"',
        '"\u00e9"', '"]"', '{"":{"":[{"a":1},{"a":2}]}}', "9" * 3000, "0." + "0" * 3000 + "1",
        '"' + "x" * 5000 + '"', '"],\\"x\\""']
BAD = ["nul", "NaN", "-Infinity", "-", "+1", "01", "1.", ".5", "1e", "0x1", "[1,]", "[,]", '{"a"}',
       '{"a":1,}', '"\\x"', '"\\u00g0"', '"\\ud800"', '"\\udc00"', '"\\ude00\\ud83d"', '"\t"',
       '{"a":1,"a":2}', '[[{"a":1,"b":0,"\\u0061":2}]]', '{"\\ud83d\\ude00":1,"\U0001f600":2}', "'x'",
       '"\udcff"', '"\udced\udca0\udc80"', '"\udcc0\udcaf"', '"', "[", "]", "}", "1 2", "\x00", "\x0c",
       "\u00a0", "//"]
def tokens(text, kind):
    found = [m for m in TOKEN.finditer(text) if re.match(kind, m[0])]
    if not found: raise KeyError
    return found
def put(text, match, new): return text[:match.start()] + new + text[match.end():]
def levels(rng): n = rng.randrange(58, 68); return "[" * n + "]" * n
def odd_value(rng): return rng.choice((rng.choice(SURE), rng.choice(SURE), rng.choice(BAD), levels(rng)))
def new_member(text, rng):
    m = rng.choice(tokens(text, "{"))
    comma = "" if text[m.end():].lstrip()[:1] == "}" else ","
    key = rng.choice(("more", "", "\\u0078y", "golden2", "expect2"))
    return put(text, m, '{"' + key + '":' + odd_value(rng) + comma)
def keys(text): return [m for m in tokens(text, '"') if text[m.end():m.end() + 1] == ":"]
def key_twice(text, rng):
    m = rng.choice(keys(text))
    name = m[0] if rng.random() < .5 or len(m[0]) < 3 else f'"\\u{ord(m[0][1]):04x}{m[0][2:]}'
    return put(text, m, name + ":" + rng.choice(("0", '"junk"', "[]", odd_value(rng))) + "," + m[0])
def key_of_another(text, rng):
    m, other = rng.choice(keys(text)), rng.choice(keys(text))
    return put(text, m, other[0] + ":" + odd_value(rng) + "," + m[0])
def key_escaped(text, rng):
    m = rng.choice(keys(text))
    i = rng.randrange(1, len(m[0]) - 1)
    return put(text, m, f"{m[0][:i]}\\u{ord(m[0][i]):04x}{m[0][i + 1:]}")
def key_renamed(text, rng): m = rng.choice(keys(text)); return put(text, m, m[0].upper())
def spelled(token, rng):
    """A number or integer, as one may write it; nearly all mean the same or nothing."""
    text, zeros = token.strip('"'), "0" * rng.choice((1, 3, 30, 2480, 2490, 2500, 2600))
    with contextlib.suppress(ValueError, OverflowError):
        if rng.random() < .3:
            return '"' + float(text).hex().replace("p+", rng.choice(("p", "p+", "P+00"))) + '"'
    sign, digits = ("-", text[1:]) if text[:1] == "-" else ("", text)
    return rng.choice((text, f'"{text}"', f"{text}.0", f"{text}e0", f"{text}E+00", f"{text}.{zeros}",
                       f"{text}{zeros}", f'"{sign}{zeros}{digits}"', f"{sign}0{digits}", f'"+{digits}"',
                       f"{text}e{zeros}", "-" + text, f'"{text} "', f'"{text}\u0661"', f"[{text}]", "-0",
                       "-0.0", "1e400", "1e-400", "null", "true", '"inf"', '""', f"9{zeros}", f'"-1{zeros}"',
                       f"{text}.5", "NaN", f"{text}_0"))
def number_spelled(text, rng): m = rng.choice(tokens(text, "[-0-9]")); return put(text, m, spelled(m[0], rng))
def string_as_number(text, rng):
    m = rng.choice(tokens(text, '"-?[0-9]+"'))
    return put(text, m, spelled(m[0], rng))
def value_replaced(text, rng): m = rng.choice(tokens(text, '[-0-9"]')); return put(text, m, odd_value(rng))
def token_gone(text, rng): return put(text, rng.choice(tokens(text, "")), "")
def token_twice(text, rng): m = rng.choice(tokens(text, "")); return put(text, m, m[0] * 2)
def tokens_swapped(text, rng):
    i = rng.randrange(len(t := tokens(text, "")) - 1)
    return put(put(text, t[i + 1], t[i][0]), t[i], t[i + 1][0])
def space(text, rng):
    m = rng.choice(tokens(text, ""))
    return put(text, m,
               rng.choice((" ", "\t", "\r", "  ")) + m[0] if rng.random() < .8
               else rng.choice(("\x0c", "\x0b", "\u00a0", "\ufeff", "\x00")) + m[0])
def behind(text, rng):
    return text + rng.choice((" ", "\t", "\r", "\r\r", " \r", "}", "{}", "1", "null", ",", "\x00", "\x0b",
                              "\x1a", "#", "\ufeff", '"x"', "[]"))
def in_front(text, rng): return rng.choice((" ", "\t", "\r", "\ufeff", "\x00", "[", "1", "{}")) + text
def cut(text, rng): return text[:rng.randrange(len(text))]
def byte(text, rng):
    i = rng.randrange(len(text))
    return text[:i] + chr(rng.randrange(128)) + text[i + rng.randrange(2):]

# For records alone.
def exact(end): return check.bound(end)
def hexadecimal(q, rng):
    """A number whose denominator is a power of two, in one of its exact texts."""
    m, e = q.numerator, 1 - q.denominator.bit_length()
    shift = rng.choice((0, 0, 1, 4, 400))
    digits, e = f"{abs(m) << shift:x}", e - shift
    sign, lead = "-" * (m < 0) or rng.choice(("", "+")), "0" * rng.choice((0, 0, 1, 100))
    if (i := rng.randrange(len(digits) + 1)) < len(digits):
        digits, e = digits[:i] + "." + digits[i:], e + 4 * (len(digits) - i)
    return (f"{sign}0{rng.choice('xX')}{lead}{digits}"
            f"{rng.choice('pP')}{rng.choice(('', '+')) if e >= 0 else ''}{e}")
def ends_of(record, rng):
    window = rng.choice(record["certificate"]["windows"])
    return window, rng.choice(("from", "to"))
def end_rewritten(record, rng):
    window, key = ends_of(record, rng)
    window[key] = hexadecimal(exact(window[key]), rng)
def end_finer(record, rng):
    window, key = ends_of(record, rng)
    window[key] = hexadecimal(
        exact(window[key]) + rng.choice((-1, 1)) *
        fractions.Fraction(2)**-rng.choice((60, 1074, 1075, 1200, 4000, 16000, 16384, 16390)), rng)
def window_split(record, rng):
    """Two windows that meet, nearly, or not quite, at a fine place."""
    windows = record["certificate"]["windows"]
    i = rng.randrange(len(windows))
    begin, end = exact(windows[i]["from"]), exact(windows[i]["to"])
    at = (begin + (end - begin) * fractions.Fraction(rng.randrange(-1, 2**40 + 2), 2**40) *
          fractions.Fraction(1, 2**rng.choice((0, 0, 1000, 3000))))
    gap = rng.choice((-1, 0, 1)) * fractions.Fraction(2)**-rng.choice((50, 1074, 1080, 5000))
    windows[i:i + 1] = [{**windows[i], "to": hexadecimal(at, rng)},
                        {**windows[i], "from": hexadecimal(at + gap, rng)}]
def window_inverted(record, rng):
    window, _ = ends_of(record, rng)
    window.update({"from": window["to"], "to": rng.choice((window["from"], window["to"]))})
def begins_at_radius(record, rng):
    """As late as a first window may begin, or a little later."""
    window = record["certificate"]["windows"][0]
    begin = exact(window["from"])
    window["from"] = hexadecimal(begin * fractions.Fraction(rng.randrange(2**60), 2**60), rng)
def end_at_limit(record, rng):
    window, key = ends_of(record, rng)
    window[key] = (rng.choice(("", "-")) +
                   f"0x{rng.randrange(16):x}p{rng.choice(('', '-'))}{rng.randrange(16380, 16390)}")
def decimal_rewritten(record, rng):
    text, zeros = record["time_decimal"], "0" * rng.choice((1, 5, 2440, 2460))
    mantissa, _, power = text.partition("e")
    point = mantissa.find(".") if "." in mantissa else len(mantissa)
    digits, power = mantissa.replace(".", ""), int(power or 0) + point
    i = rng.randrange(len(digits) + 2)
    e = power - i
    record["time_decimal"] = rng.choice((
        f"{digits[:i]}.{digits[i:]}e{e:+}", f"{digits[:i]}.{digits[i:]}e{e}",
        f"{digits}e{power - len(digits):+}", f"0.{zeros}{digits}e{power + len(zeros):+}", zeros + text,
        text + zeros, text + "e+0", text + "e-00000", text.replace(".", ".."), text.replace(".", ","),
        "." + text, text + ".", text + "e", "-" + text, " " + text, text[:-1], "0", "0.0", ""))
def to_error(record, rng):
    record["expect"] = {"outcome": "error"} | rng.choice(({}, {"message": "x"}, {"message": 1},
                                                          {"reason": None}, {"time": 1}))
    record.pop("time_decimal", 0), record.pop("certificate", 0) if rng.random() < .9 else 0
    change = rng.choice(("x", "v", "from", "both", "none"))
    if change in "xv":
        record[change] = rng.choice((None, "junk", [], [0, 0, 0, 0], [1e300] * len(record["x"]),
                                     ["0x1p9999"] * len(record["x"]), [0] * len(record["x"]),
                                     record.pop(change)))
    if change == "from":
        record["from"] = rng.choice((None, {}, {"lattice": 0},
                                     {"lattice": 9, "atom": 0, "cell": [0] * len(record["x"])},
                                     {"lattice": 0, "atom": 0, "cell": [0] * len(record["x"])},
                                     {"lattice": 0, "atom": 0,
                                      "cell": ["9" * rng.randrange(2490, 2510)] * len(record["x"])}))
    if change == "both": record.pop("x"), record.pop("v")
def basis_across(record, rng):
    """A basis with its first two vectors at right angles to v, or one in the direction of v."""
    piece = rng.choice(pieces(record))
    size = len(piece["basis"])
    piece["basis"] = [[int(i == (j + rng.randrange(size)) % size) for j in range(size)] for i in range(size)]
def huge_basis(record, rng):
    rows = rng.choice(pieces(record))["basis"]
    i, j = rng.sample(range(len(rows)), 2)
    k = rng.choice((-1, 1)) * 10**rng.choice((2, 30, 1240, 2480, 2499, 2500))
    rows[i] = [str(int(a) + k * int(b)) for a, b in zip(rows[i], rows[j])]
def outcome_other(record, rng):
    record["expect"]["outcome"] = rng.choice(("later", "undecided", "error", "Hit", None, 1, ["hit"], "never",
                                              "inside", "hit"))
def pieces_of_both(record, rng):
    record["certificate"].update(rng.choice(({"rows": []}, {"windows": []},
                                             {"rows": pieces(record), "windows": pieces(record)})))
TEXTS = [new_member, new_member, key_twice, key_twice, key_of_another, key_escaped, key_renamed,
         number_spelled, number_spelled, number_spelled, string_as_number, value_replaced, token_gone,
         token_twice, tokens_swapped, space, behind, in_front, cut, byte]
RECORDS = [end_rewritten, end_finer, window_split, window_inverted, begins_at_radius, end_at_limit,
           decimal_rewritten, to_error, basis_across, huge_basis, outcome_other, pieces_of_both]

def with_id(scene, line):
    """The record's line with the id of its question, if it has one."""
    begin, end = line.find(b'],"') + 2, line.find(b',"expect"')
    if begin < 2 or end < begin: return line
    identity = hashlib.sha256(scene.rstrip(b"\r") + b"\n" + line[begin:end]).hexdigest()[:16].encode()
    return re.sub(rb'^(\s*\{\s*"id"\s*:\s*")[0-9a-f]{16}', rb"\g<1>" + identity, line, count=1)

def formed(cases, rng):
    while True:
        scene, line = rng.choice(cases)
        record, way = json.loads(line), rng.choice(TEXTS + RECORDS)
        record.pop("margin", 0), record.pop("condition", 0)  # whose forms are for `golden verify` alone
        with contextlib.suppress(KeyError, IndexError, ValueError, TypeError, AttributeError):
            if way in RECORDS:
                way(record, rng)
                return HEADER, scene.encode(), way.__name__, line_of(scene, record).encode()
            lines = [HEADER.decode(), scene, line_of(scene, record)]
            which = rng.choice((0, 1, 1, 2, 2, 2, 2))
            lines[which] = way(lines[which], rng)
            if "\n" in lines[which]: continue
            header, scene, line = (text.encode(errors="surrogateescape") for text in lines)
            return header, scene, way.__name__, with_id(scene, line) if rng.random() < .9 else line

# ---- Verdicts: of each file, why it is refused.
def refusals(said):
    return {m[1]: m[2] for m in re.finditer(r"^(?:lorentz: )?(\S+?ndjson):(?:\d+:)? ?(.*)$", said, re.M)
            if not m[2].endswith(("all verified", "outside of the proof"))}
def by_python(paths):
    with contextlib.redirect_stdout(io.StringIO()) as said:
        refused = [path for path in paths if check.check(path)]
    return {path: refusals(said.getvalue()).get(path, "?") for path in refused}
def ran(*command):
    done = subprocess.run(command, capture_output=True, text=True, errors="replace")
    assert done.returncode in (0, 1, 2), (done.returncode, done.stdout[-300:], done.stderr[-300:])
    return done
def by_proof(paths):
    return refusals(ran(ROOT / "oracle" / "proof" / "check", "--budget", str(check.STEPS), *paths).stdout)
def by_program(program, paths):
    """`margin` and `condition` of a record that was changed are others now: its proof has passed by then."""
    other = re.compile("its (margin|condition) is another one")
    said = ran(program, "golden", "verify", *paths).stderr
    return {path: why for path, why in refusals(said).items() if not other.search(why)}

HEADER = compact({"golden": {"format": 1, "name": "n", "description": "d", "generator": "g", "version": "v",
                             "count": 1, "tags": {"t": ""}}}).encode()

def batch(program, records):
    """How often each way had which verdicts (True: accepted), and where they differ."""
    tally, differ = collections.Counter(), []
    with tempfile.TemporaryDirectory() as name:
        paths = [str(pathlib.Path(name) / f"{i}.ndjson") for i in range(len(records))]
        for path, (header, scene, _, line) in zip(paths, records):
            pathlib.Path(path).write_bytes(b"\n".join((header, scene, line, b"")))
        says = [by_python(paths), by_proof(paths)]
        says.append(by_program(program, [path for path in paths if "too many" not in says[1].get(path, "")]))
        for path, (header, scene, way, line) in zip(paths, records):
            long = "too many" in says[1].get(path, "")
            verdicts = tuple(path not in refused for refused in says[:2 if long else 3])
            tally[way, verdicts[:1]] += 1
            tally["(of too many steps)"] += long
            if len({*verdicts}) > 1:
                differ.append((way, verdicts, [refused.get(path, "accepted")[:200] for refused in says],
                               header, scene, line))
    return tally, differ

def main(program, count, seed=1, *paths):
    rng, cases = random.Random(int(seed)), list(records_of(paths))
    tally, differ, done = collections.Counter(), [], 0
    while done < int(count):
        records = [rng.choice((tampered, formed))(cases, rng) for _ in range(min(BATCH, int(count) - done))]
        of_batch, more = batch(program, records)
        tally.update(of_batch)
        differ += more
        for way, verdicts, why, *lines in more:
            print(f"{way}: check.py, proof, program: {verdicts} {why}", *lines, sep="\n")
        done += len(records)
        print(f"{done} records, {len(differ)} verdicts differ", flush=True)
    for name in sorted({way.__name__ for way in WAYS + TEXTS + RECORDS}):
        print(f"{name:16} {tally[name, (True,)]:8} accepted {tally[name, (False,)]:8} refused")
    print(f"{tally['(of too many steps)']} of more than {check.STEPS} steps")
    return 1 if differ else 0

if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
