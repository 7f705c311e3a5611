"""One grammar of golden sets: data/check.py and `lorentz golden verify` accept and refuse the same forms of
one set.

python3 tests/golden/golden_forms_test.py PROGRAM"""
import contextlib, hashlib, importlib.util, io, json, pathlib, re, subprocess, sys, tempfile, unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SPEC = importlib.util.spec_from_file_location("check", ROOT / "data" / "check.py")
check = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(check)
PROGRAM = ""

def sample(name, *parts):
    """The first record of a committed set with these parts, and its scene."""
    for line in (ROOT / "data" / "golden" / f"{name}.ndjson").read_text().splitlines():
        if line.startswith('{"scene"'):
            scene = line
        elif all(part in line for part in parts):
            return scene, line

HIT = sample("generic-2d", '"outcome":"hit"', '"x":[0.', '"v":[0.')
NEVER = sample("never", '"outcome":"never"', '"rows"')
INSIDE = sample("large-radius", '"outcome":"inside"')
ERROR = sample("bad-queries", '"v":[0,0]')
FROM = sample("boundary-starts", '"outcome":"hit"', '"from":{"lattice":0')
CASES = {"hit": HIT, "never": NEVER, "inside": INSIDE, "error": ERROR, "from": FROM}

def with_id(scene, line):
    """The record with the id that belongs to its question."""
    scene, line = scene.rstrip(b"\r"), bytes(line)
    begin, end = line.index(b'],"') + 2, line.index(b',"expect"')
    identity = hashlib.sha256(scene + b"\n" + line[begin:end]).hexdigest()[:16].encode()
    return re.sub(rb'^(\s*\{\s*"id"\s*:\s*")[0-9a-f]{16}', rb"\g<1>" + identity, line)

def golden(kind, old="", new="", where="record", repair=True):
    """A set of one case, with one change in its header, scene line or record."""
    tags = sorted({tag for tag in json.loads(CASES[kind][1])["tags"]})
    header = json.dumps({"golden": {"format": 1, "name": "n", "description": "d", "generator": "g",
                                    "version": "v", "count": 1,
                                    "tags": {tag: "what it means" for tag in tags}}},
                        separators=(",", ":"))
    lines = {"header": header, "scene": CASES[kind][0], "record": CASES[kind][1]}
    lines = {key: line.encode() for key, line in lines.items()}
    old, new = (text.encode() if type(text) is str else text for text in (old, new))
    if old:
        assert old in lines[where], (old, lines[where])
        lines[where] = lines[where].replace(old, new, 1)
    if repair:
        with contextlib.suppress(ValueError):
            lines["record"] = with_id(lines["scene"], lines["record"])
    return b"\n".join(lines.values()) + b"\n"

def verdicts(folder, forms):
    """What each of the two says: for each text, the exit statuses."""
    result = []
    for i, text in enumerate(forms):
        path = folder / f"{i}.ndjson"
        path.write_bytes(text)
        with contextlib.redirect_stdout(io.StringIO()) as said:
            try:
                python = check.check(str(path))
            except Exception as e:
                python, _ = 3, said.write(repr(e))
        program = subprocess.run([PROGRAM, "golden", "verify", path], capture_output=True, text=True)
        result.append(((python, program.returncode), said.getvalue()[-300:] + program.stderr[-300:]))
    return result

def in_record(kind, *changes, **more):
    return [golden(kind, old, new, **more) for old, new in changes]

BASIS, X, CELL = '"basis":[[1,-1],[1,0]]', "0.665659173810049", '"cell":[1,0]'
LATTICE, TIME = '[{"lattice":0,', '"time":0.1469403008318714'
FROM, TO = '"from":-0.23876953125', '"to":0.3857421875'
DEEP = 62  # further brackets in a record

# A character and its escape; a character and that of the one behind.
SAME = [(chr(code), f"\\u{code:04{case}}") for code in (0x30, 0x39, 0x4a, 0x4f, 0x6a, 0x7e, 0xaf, 0xfa) for case in "xX"]
SAME += [("\U0001f600", "\\ud83d\\ude00"), ("\U0010ffff", "\\uDBFF\\uDFFF"), ("\U00010000", "\\ud800\\udc00"), ("/", "\\/")]
UTF_8 = 0x80, 0x7ff, 0x800, 0xfff, 0x1000, 0xcfff, 0xd7ff, 0xe000, 0xffff, 0x10000, 0x3ffff, 0x40000, 0xfffff, 0x100000, 0x10ffff
NEAR = [(chr(ord(a) + 1), b) for a, b in SAME if a != "\U0010ffff"]

ACCEPTED = {
    "as it is": [golden(kind) for kind in CASES],
    "line ends": [golden(kind).replace(b"\n", b"\r\n") for kind in CASES] +
                 [golden("hit")[:-1], golden("hit") + b"\n \t\r\n\r\n"],
    "a byte order mark": [b"\xef\xbb\xbf" + golden("hit")],
    "spaces": in_record("hit", ('"margin":', ' "margin" :\t'), ('"expect":{', '"expect" : { '),
                        (LATTICE, '[ {"lattice" :0 ,'), ('{"id":"', '{ "id" : "'), ('"x":[', '"x": [')) +
              [golden("hit", '"scene":{', '"scene" : { ', "scene"),
               golden("hit", '"count":1', '"count" : 1 ', "header"), golden("hit", "}}", "}} ", "scene")],
    "integers": in_record("hit", (BASIS, '"basis":[[1.0,-1e0],["1","-0"]]'),
                          (BASIS, '"basis":[[10e-1,-1],["001",-0]]'), (BASIS, '"basis":[[1,-1],[1,-0.0]]'),
                          (CELL, '"cell":["1",0.0]'), (LATTICE, '[{"lattice":"0",'),
                          (LATTICE, '[{"lattice":0e9,'), (CELL, '"cell":[1.000000000000000000000001,0]')) +
                [golden("hit", '"count":1', '"count":1.0', "header"),
                 golden("hit", '"format":1', '"format":"1"', "header")] +
                in_record("from", ('"cell":[5,3]', '"cell":[5.0,"3"]')),
    "decimal numbers": in_record("hit", (X, X + "00000000000000000000"), (X, "66565917381004.90E-14"),
                                 (X, "0.66565917381004900000000000000000000001"),
                                 (TIME, '"time":0.14694030083187141118'),
                                 (FROM, '"from":-0.238769531250000000000000001'),
                                 (TO, '"to":38.57421875e-2')),
    "hexadecimal numbers": in_record("hit", (FROM, '"from":"-0x1p0"'), (FROM, '"from":"-0X.8"'),
                                     (FROM, '"from":"-0x1.P-1"'), (TO, '"to":"+0x1p+0"'), (TO, '"to":"0xFf"'),
                                     (TO, '"to":"0x0.800000000000000000000001"'),
                                     (X, '"%s"' % float(X).hex()), (X, '"+%s"' % float(X).hex().upper())) +
                           [golden("hit", '"dimension":2', '"dimension":"0x1p1"', "scene"),
                            golden("hit", '"dimension":2', '"dimension":2.0', "scene"),
                            golden("hit", "[1,0]", '["+0x1","0X0P5"]', "scene")] +
                           in_record("error", ("[0,0]", '["0x0","-0x0p9"]')),
    "keys": in_record("hit", ('"margin"', '"more":{"x":[1],"y":null},"margin"'),
                      ('"margin"', '"m\\u0061rgin"'), ('"expect":{', '"expect":{"other":[],'),
                      ('"v":', '"note":"\\ud83d\\ude00","v":'), ('"windows":', '"rows":[],"windows":')) +
            [golden("hit", '"scene":{', '"scene":{"more":1,', "scene"),
             golden("hit", '{"golden"', '{"more":1,"golden"', "header"),
             golden("hit", '"count":1', '"count":1,"precision":"binary64"', "header")],
    "escapes": [golden("hit", '"margin"', '"more":{"%s":1,"%s":2},"margin"' % pair) for pair in NEAR] +
               [golden("hit", '"margin"', '"more":"%s","margin"' % "".join(map(chr, UTF_8)))],
    "nested": in_record("hit", ('"margin"', '"deep":' + "[" * DEEP + "]" * DEEP + ',"margin"')),
    "errors": in_record("error", ("[0,0]", "[0,1e400]"), ("[0,0]", "[null,true]"), ("[0,0]", '"0"'),
                        ("[0,0]", '["0x",1]'), ("[0,0]", '["1.5",1]'), ("[0,0]", '["0x1p9999",1]'),
                        ('"v":', '"from":{"lattice":0.5,"atom":0,"cell":[0,0]},"v":'),
                        ("[0,0]", '["0x1_0",1]'), ("[0,0]", '[" 0x1",1]'), ("[0,0]", '["0x1p\u0663",1]'))}

REFUSED = {
    "no JSON numbers": in_record("hit",
                                 *[("1048576", number)
                                   for number in ("1048576.", "01048576", "+1048576", ".5", "1e", "-", "0x1",
                                                  "Infinity", "-Infinity", "NaN", "1_0", "--1")]) +
                       in_record("error",
                                 *[("[0,0]", f"[0,{number}]")
                                   for number in ("1.", ".5", "01", "+0", "0x0", "NaN", "Infinity", "-",
                                                  "1e+")]),
    "no numbers": in_record("hit",
                            *[(old, old.split(":")[0] + ":" + value) for old in (TIME, FROM, TO)
                              for value in (
                                  "null", "true", '"0.5"', '"nan"', '""', '"0x"', '"0x."', '"0x1p"',
                                  '"1f4p-3"', '"0x1_0p0"', '" 0x1p0"', '"0x1p0 "', '"--0x1"', '"0x1p1.5"',
                                  '"0x1.8.0"', '"0x1p\u0663"', "[0]", "{}", "1e400", '"0x1p-99999999"')]) +
                  in_record("hit", (TIME, '"time":-0.1469403008318714'), (TO, '"to":"0x0p65537"'),
                            (TO, '"to":"0x0p99999999999999999999"'), (TO, '"to":"inf"'),
                            (FROM, '"from":"inf"'), (TO, '"to":"1' + "0" * 2400 + '"')),
    "no integers": in_record("hit",
                             *[(BASIS, f'"basis":[[{n},-1],[1,0]]')
                               for n in ("true", "null", '"1.0"', '"+1"', '""', '"0x1"', "1.5", "[1]",
                                         '"\u0661"')],
                             (LATTICE, '[{"lattice":false,'), (LATTICE, '[{"lattice":-1,'),
                             (LATTICE, '[{"lattice":1e30,'), (CELL, '"cell":[1,"0 "]'), (CELL, '"cell":[1]'),
                             (CELL, '"cell":[1,0,0]')) +
                   [golden("hit", '"count":1', '"count":true', "header"),
                    golden("hit", '"format":1', '"format":true', "header"),
                    *[golden("hit", '"format":1', f'"format":{other}', "header") for other in ("1.5", "0", "3", "-1")]],
    "false numbers": in_record("hit", (TIME, '"time":0.14694030083187142118'),
                               (TIME, '"time":0.14694030083187137999'), (TIME, '"time":"0x1.2ceefp-3"'),
                               (TIME, '"time":-0.0'), (TIME, '"time":"inf"')),
    "proofs": in_record("hit", ('"certificate"', '"other"'), ('"windows"', '"rows"'),
                        (LATTICE, "[{"),
                        ('"atom":0,"from"', '"from"'), ("," + BASIS, ""), (BASIS, '"basis":[[1],[1,0]]'),
                        (BASIS, '"basis":[[1,-1,0],[1,0,0]]'), (BASIS, '"basis":[[1,-1]]'),
                        (BASIS, '"basis":{}'), (FROM + ",", ""), ("," + TO, "")) +
              in_record("never", ('"rows"', '"windows"')),
    "answers": in_record("never", ('"outcome":"never"', '"outcome":"never","time":1'),
                         ('"outcome":"never"', '"outcome":"never","cell":[1]'),
                         *[('"certificate"', f'"time_decimal":"{n}","certificate"') for n in ("1", "0", "")]) +
               in_record("inside", ('"outcome":', '"time":1,"outcome":'), ('"certificate"', '"time_decimal":"","certificate"')) +
               in_record("hit", ('"outcome":', '"id":1,"outcome":'), (TIME + "}", '"other":1}'),
                         ('"time_decimal":"', '"time_decimal":" ')) +
               in_record("error", ('"outcome":"error"', '"outcome":"error","time":1'),
                         ('"message":"no query"}', '"message":"no query"},"time_decimal":""'),
                         ('"outcome":"error"', '"outcome":"error","lattice":"x"'),
                         ('{"outcome"', '{"outcome":"error"},"certificate":{"windows":[]},"e":{"outcome"')),
    "keys": in_record("hit", ('"x":', '"\\u0065xpect":{},"x":'), ('"expect"', '"\\u0065xpect"'),
                      ('"tags"', '"Tags"'), ('"id"', '"first":1,"id"'), ('"tags"', '"between":1,"tags"'),
                      ('"margin"', '"x":[0.5,0.5],"margin"'),
                      ('"margin"', '"from":{"lattice":0,"atom":0,"cell":[9,9]},"margin"'),
                      ('"margin"', '"golden":1,"margin"'), ('"v":', '"y":{"a":[1],"expect":1},"v":'),
                      ('"x":', '"tags":[],"x":')) +
            [golden("hit", '"scene":', f'"{key}":[],"scene":', "scene")
             for key in ("id", "x", "v", "from", "golden")],
    "places": in_record("hit", ('"],"x"', '"] ,"x"'), ('"],"x"', '"], "x"'), (',"expect"', ', "expect"'),
                        (',"expect"', ',\t"expect"'), ('"x":', ' "x":')),
    "tags": in_record("hit", ('["radius-1e-1","crystal"]', "[]"), ('["radius-1e-1","crystal"]', '"crystal"'),
                      ('["radius-1e-1","crystal"]', '{"crystal":1}'),
                      ('["radius-1e-1","crystal"]', '["new"]'), ('["radius-1e-1","crystal"]', "[1]")) +
            [golden("hit", '"tags":{"crystal":"what it means"', '"tags":{"crystal":3', "header"),
             golden("hit", '"name":"n"', '"name":3', "header"), golden("hit", ',"count":1', "", "header"),
             golden("hit", '"format":1,', "", "header")] +
            [golden("hit", '"count":1', f'"count":1,"precision":{other}', "header")
             for other in ('"binary16"', '"float"', '""', "32", "null", '["binary32"]')],
    "texts": in_record("hit", ('"margin"', '"bad":"\\ud83d","margin"'),
                       ('"margin"', '"bad":"\\ude00","margin"'),
                       ('"margin"', '"bad":"\\ude00\\ud83d","margin"'), ('"margin"', '"\\udc00":1,"margin"'),
                       *[('"margin"', f'"bad":"\\u00{digit}0","margin"') for digit in "Gg:/@`"],
                       ('"margin"', '"bad":"\\x","margin"'), ('"margin"', '"bad":"\t","margin"'),
                       ('"margin"', b'"bad":"\xff","margin"'), ('"margin"', b'"bad":"\xed\xa0\x80","margin"'),
                       ('"margin"', "'bad':1,\"margin\""), ('"margin"', '"bad":tru,"margin"'),
                       ('"margin"', b'"bad":"\x00","margin"')),
    "lines": [golden("hit").replace(b"\n", b"\n\xef\xbb\xbf", 1), golden("hit") + b"{}\n",
              golden("hit") + b"x\n", golden("hit") + b"[]\n", b"\n" + golden("hit"),
              golden("hit").split(b"\n", 1)[1], b"", golden("hit")[:-3], golden("hit").replace(b"\n", b"}\n"),
              golden("hit").replace(b"\n", b"\x0b\n"), golden("hit") + golden("hit").split(b"\n")[0],
              golden("hit", "}}", "}} ", "scene", repair=False)],
    "nested": in_record("hit", ('"margin"', '"deep":' + "[" * (DEEP + 2) + "]" * (DEEP + 2) + ',"margin"'),
                        ('"margin"', '"deep":' + "[" * 5000 + "]" * 5000 + ',"margin"'),
                        ('"margin"', '"deep":' + "[" * 100 + ',"margin"'))}

# ---- More of both: keys that come twice, what stands under other keys, lengths at their limits, text
# behind a line.
# What may stand under a key that is not known.
ANY = '[1e400,-1e999999,"\\u0000",{"":{}},null,' + "9" * 5000 + "]"
PLACES = [
    ("hit", "record", key)
    for key in ('"margin":', '"time_decimal":', '"outcome":', '"lattice":0,"atom":0,"cell"', '"windows":',
                '"basis":', '"x":', '"v":')] + [
    ("hit", "scene", key)
    for key in ('"dimension":', '"lattices":', '"vectors":', '"atoms":', '"position":', '"radius":')] + [
    ("hit", "header", key) for key in ('"golden":', '"format":', '"name":', '"tags":')] + [
    ("never", "record", '"rows":'), ("never", "record", '"basis":'), ("from", "record", '"from":'),
    ("from", "record", '"cell":'), ("error", "record", '"message":')]
LONG = 2500  # characters of an integer, of an exact end, of a time_decimal, at most
DIGITS = "1469403008318714111826651962574809782782"
DECIMAL, OUTCOME = f'"0.{DIGITS}"', '"outcome":"hit"'

def before(places, new):
    """Forms with something before a member, which may come first or later in its object."""
    return [golden(kind, key, new(key) + key, where) for kind, where, key in places]

def name_of(key): return key.split('"')[1]
def escaped(key): return f"\\u{ord(name_of(key)[0]):04x}{name_of(key)[1:]}"
def times(*decimals): return in_record("hit", *[(DECIMAL, f'"{decimal}"') for decimal in decimals])
def begins(*ends): return in_record("hit", *[(FROM, f'"from":{end}') for end in ends])
def ended(line, more, kind="hit"):
    """A set with something behind its header, scene or record."""
    lines = golden(kind).split(b"\n")
    return b"\n".join(lines[:line] + [lines[line] + more] + lines[line + 1:])

ACCEPTED |= {
    "anything under other keys": before(PLACES, lambda key: f'"more":{ANY},'),
    "the same key in other objects": before(
        PLACES, lambda key: f'"more":[{{"{name_of(key)}":1}},{{"{name_of(key)}":[]}}],'),
    "many keys": before(PLACES[:3], lambda key: "".join(f'"k{i}":{i},' for i in range(2000))),
    "long": in_record("hit", (BASIS, f'"basis":[["{"1":0>{LONG}}",-1],[1,0]]'),
                      (BASIS, f'"basis":[["1","-{"1":0>{LONG - 1}}"],[1,0]]'),
                      (LATTICE, f'[{{"lattice":"{"0" * LONG}",'), (CELL, f'"cell":["{"1":0>{LONG}}",0]'),
                      (CELL, f'"cell":[1.{"0" * LONG},0]'), *[(CELL, f'"cell":[1{"0" * LONG}{e}-{LONG},0]') for e in "eE"]) +
            in_record("never", *[("[0,-1]", f"[{n},-1]") for n in ("9" * LONG, "-" + "1" * (LONG - 1), f'"{"9" * LONG}"')]) +
            begins(f'"-0x{"1":0>{LONG - 3}}"', f'"-0x1p{"0" * (LONG - 5)}"', '"-0x1.%sp0"' % ("0" * 2000),
                   '"-0x%sp-9900"' % ("f" * 2480)) +
            times(f'0.{"0" * (LONG - 48)}{DIGITS}e+{LONG - 48}') +
            [golden("hit", '"count":1', f'"count":"{"1":0>{LONG}}"', "header")] +
            in_record("from", ('"from":{"lattice":0', f'"from":{{"lattice":"{"0" * LONG}"')),
    "exact ends": begins('"-0x1p-1"', '"-0x8P-4"', '"-0x.4p0"', '"-0x0.%s1p160"' % ("0" * 39),
                         '"-0x%s1"' % ("0" * 100), '"-0x1p13"', '"-0X1.0p+00001"', -1, "-1e0", -0.5) +
                  in_record("hit", (TO, '"to":"0x3p-1"'), (TO, '"to":"+0x.8p1"'),
                            (TO, '"to":"0x1.8000000000000000001p0"'), (TO, '"to":9e-1')),
    "decimals": times(f"0.{DIGITS}e+0", f"0.{DIGITS}e-0000", f"000.{DIGITS}", f"1.{DIGITS[1:]}e-1",
                      f"{DIGITS}e-40", f"{DIGITS}e-0040", f"0.{'0' * 9}{DIGITS}e+9", f"0{DIGITS}e-40"),
    "messages": in_record("error", ('"message":"', '"reason":"","message":"')) +
                in_record("hit", (OUTCOME, '"message":"x","reason":"y",' + OUTCOME)),
    "no questions": in_record("error", ('"x":', '"y":'), ('"v":', '"w":'), ("[0,0]", "{}"),
                              ('"v":',
                               f'"from":{{"lattice":0,"atom":0,"cell":[0,"{"1":0>{LONG + 1}}"]}},"v":')),
    "levels": in_record("hit", ('"windows"', '"deep":' + "[" * 62 + "]" * 62 + ',"windows"')) +
              [golden("hit", '"dimension"', '"deep":' + "[" * 62 + "]" * 62 + ',"dimension"', "scene")],
    "long lines": [golden("hit") + b" " * 2**25 + b"\n", golden("hit") + b" " * (2**25 - 1) + b"\r\n\n"]}

REFUSED |= {
    "escapes": [golden("hit", '"margin"', '"more":{"%s":1,"%s":2},"margin"' % pair) for pair in SAME],
    "behind the answer": [golden("error", old, "")[:-2] + b"," + more + b"}\n" for old, more in
                          ((ERROR[1][ERROR[1].index('"x"'):ERROR[1].index('"v"')], b'"x":[0,0]'), (',"v":[0,0]', b'"v":[0,0]'))],
    "no UTF-8": in_record("hit", *[('"margin"', b'"more":"' + bytes.fromhex(text) + b'","margin"') for text in (
        "80", "bf", "c080", "c1bf", "c27f", "c2c0", "e09fbf", "e18020", "e1c080", "e180c0", "eda080", "f08fbfbf", "f1c08080", "f180c080",
        "f18080c0", "f4908080", "f5808080", "ff")]),
    "twice": before(PLACES, lambda key: f'"{name_of(key)}":0,') +
             before(PLACES, lambda key: f'"{escaped(key)}":null,') +
             before(PLACES, lambda key: '"more":{"k":1,"k":1},') +
             before(PLACES[:9], lambda key: '"more":[[{"":0,"k":1,"\\u006b":2}]],') +
             in_record("hit", ('"margin"', '"margin":3,"margin"'), ('"windows":', '"windows":[],"windows":'),
                       ('"x":', '"x":[7],"x":'), ('"x":', '"x":"junk","x":'), (TO, TO + "," + TO),
                       (TIME, TIME + "," + TIME),
                       ('"margin"', '"more":{"\\ud83d\\ude00":1,"\U0001f600":2},"margin"'),
                       ('"margin"', "".join(f'"k{i}":{i},' for i in range(2000)) + '"k7":0,"margin"')) +
             in_record("error", ('"v":', '"v":[1,1],"v":'), ('"expect":{', '"expect":{"outcome":"hit",')) +
             [golden("hit", '"tags":{', '"tags":{"crystal":"",', "header")],
    "too long": in_record("hit", (BASIS, f'"basis":[["{"1":0>{LONG + 1}}",-1],[1,0]]'),
                          (BASIS, f'"basis":[["1","-{"1":0>{LONG}}"],[1,0]]'),
                          (BASIS, f'"basis":[[1{"0" * LONG},-1],[1,0]]'),
                          (LATTICE, f'[{{"lattice":"{"0" * (LONG + 1)}",'),
                          (CELL, f'"cell":["{"1":0>{LONG + 1}}",0]')) +
                in_record("never", *[("[0,-1]", f"[{n},-1]") for n in ("9" * (LONG + 1), "-" + "1" * LONG, f'"{"9" * (LONG + 1)}"')]) +
                begins(f'"-0x{"1":0>{LONG - 2}}"', f'"-0x1p{"0" * (LONG - 4)}"') +
                times(f'0.{"0" * (LONG - 47)}{DIGITS}e+{LONG - 47}') +
                [golden("hit", '"count":1', f'"count":"{"1":0>{LONG + 1}}"', "header")] +
                in_record("from", ('"from":{"lattice":0', f'"from":{{"lattice":"{"0" * (LONG + 1)}"')),
    "no exact ends": begins(*[f'"{end}"'
                              for end in ("-0x1p16385", "-0x1p-16385", "-0x.1p-16381", "0x0p16385",
                                          "-0x0p-16385", "-0x1p+-1", "-0x1p", "0x", "-1p0", "-0x1.p0x",
                                          "-0x1p99999999999999999999", "-0x1p-1 ", "-0x1p-1\u0660", "-0x1,8",
                                          "-\uff10x1", "-inf", "nan", "-0x1p-16384")],
                            0.23876953125, 0, 1, "true", "{}") +
                     in_record("hit",
                               *[(TO, f'"to":{end}')
                                 for end in (-0.3857421875, "-0.23876953126", '"-0x1p-2"', '"0x1p-16384"', 0,
                                             "-0.0", "1e400", '"-0x0"')]) +
                     in_record("inside", ('"to":', '"to":-9,"too":')),
    "no decimals": times(f".{DIGITS}", f"0.{DIGITS}e", f"0.{DIGITS}e0", f"0.{DIGITS}e+", f"0.{DIGITS}e+00000",
                         f"0.{DIGITS}E+0", f"{DIGITS}.e-40", f"0..{DIGITS}", f"0.{DIGITS}.", f"+0.{DIGITS}",
                         f"-0.{DIGITS}", f"0.{DIGITS} ", f"0.{DIGITS[:-1]}", f"0.{DIGITS}0", f"0x0.{DIGITS}",
                         f"0.{DIGITS[:-1]}\u0662", f"0,{DIGITS}", f"0.{DIGITS[:20]}_{DIGITS[20:]}", "0",
                         "0.0", "", "inf", "nan", f"0.{DIGITS}e-1", f"0.{DIGITS[:-1]}3", f"0.{DIGITS}e+9999",
                         f"0.{DIGITS}e-9999") +
                   in_record("hit", (DECIMAL, f"0.{DIGITS}"), (DECIMAL, f'["0.{DIGITS}"]'), (DECIMAL, "null"),
                             (f'"time_decimal":{DECIMAL},', "")),
    "no messages": in_record("error", ('"message":"', '"reason":1,"message":"'),
                             ('"message":"', '"message":null,"massage":"'),
                             ('"message":"', '"message":["x"],"massage":"')) +
                   in_record("hit", (OUTCOME, '"message":0,' + OUTCOME), (OUTCOME, '"reason":{},' + OUTCOME)),
    "outcomes": in_record("hit",
                          *[(OUTCOME, f'"outcome":{new}')
                            for new in ('"later"', '"undecided"', '"Hit"', '"error"', '"never"', '"inside"',
                                        '"hit "', "null", "1", '["hit"]')],
                          (OUTCOME + ",", "")),
    "errors that are questions": in_record("error", ("[0,0]", "[0,1]"), ("[0,0]", '["0x1",1e-400]')),
    "errors without a question": [golden("error", ERROR[1][ERROR[1].index('"x"'):ERROR[1].index('"expect"')],
                                         "", repair=False)],
    "behind": [ended(line, more) for line in (0, 1, 2)
               for more in (b" {}", b"1", b",", b"]", b"}", b"null", b' "x"', b"\xef\xbb\xbf", b"#", b"//",
                            b"\x00", b"\x0c", b"\xa0", b"{")] +
              [ended(2, more, "error") for more in (b" {}", b"1", b"x", b"\x00")],
    "deeper": in_record("hit", ('"windows"', '"deep":' + "[" * 63 + "]" * 63 + ',"windows"')) +
              [golden("hit", '"dimension"', '"deep":' + "[" * 63 + "]" * 63 + ',"dimension"', "scene")],
    "longer lines": [golden("hit") + b" " * (2**25 + 1) + b"\n", golden("hit") + b" " * 2**25 + b"\r\n",
                     golden("hit").replace(b"\n", b" " * 2**25 + b"\n", 1),
                     golden("hit")[:-1] + b" " * (33 << 20)]}

EXIT, LATER = 0.5330117872090137, 0.5330117872090138
EXITS = {  # for these two alone: the proved checker passes over them
    "accepted": in_record("hit", (TIME, TIME + f',"exit_time":{EXIT}'), (TIME, f'"exit_time":{EXIT}00,' + TIME),
                          (TIME, TIME + f',"exit_time":"{EXIT.hex()}"')),
    "refused": in_record("hit", *[(TIME, f'{TIME},"exit_time":{text}') for text in (
                   LATER, f"-{EXIT}", "0", '"inf"', '"-inf"', '"nan"', "null", f'"{EXIT}"', f"[{EXIT}]", "1e400", "true")]) +
               in_record("inside", ('"outcome":', '"exit_time":1e3,"outcome":')) +
               in_record("never", ('"outcome":"never"', '"outcome":"never","exit_time":1')) +
               in_record("error", ('"message":', '"exit_time":1,"message":'))}

class Forms(unittest.TestCase):
    def hold(self, forms, *statuses):
        with tempfile.TemporaryDirectory() as folder:
            for kind, texts in forms.items():
                for text, (status, said) in zip(texts, verdicts(pathlib.Path(folder), texts)):
                    with self.subTest(kind, text=text[-700:]):
                        self.assertIn(status, statuses, said)

    def test_accepted(self):
        self.hold(ACCEPTED, (0, 0))

    def test_exits(self):
        self.hold({"accepted": EXITS["accepted"]}, (0, 0))
        self.hold({"refused": EXITS["refused"]}, (1, 1), (1, 2))

    def test_refused(self):
        """If a record has an id and another form than it should, check.py says that it is refuted."""
        self.hold(REFUSED, (1, 1), (1, 2), (2, 2))

if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
