"""data/check_itineraries.py accepts itineraries that are true, and refuses false ones for what is wrong with them:
python3 tests/golden/check_itineraries_test.py"""
import contextlib, copy, hashlib, importlib.util, io, itertools, json, math, pathlib, random, subprocess, sys, tempfile, unittest
from fractions import Fraction

CHECKER = pathlib.Path(__file__).resolve().parents[2] / "data" / "check_itineraries.py"
SPEC = importlib.util.spec_from_file_location("check_itineraries", CHECKER)
check = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(check)

# True ones, from `lorentz trajectory`: a name, a scene, a record.
CASES = {}
LINES = r"""
disc
{"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":"1/3"}]}]}}
{"id":"40d09b6a114b7cdd","x":["1/2","1/10"],"v":[1,0],"itinerary":[[0,0,1,0],[0,0,-1,1],[0,0,0,2],[0,0,0,1],[0,0,-1,2]],"times":{"1":"0.182020266194351450282459471326","2":"1.83021536982769660651427201283","5":"3.85206235892633997884317449974"},"end":{"x":["-0.797941821158685800853910816000","1.73488945046557917484505673447"],"v":["0.317000391016544344419385989822","-0.948425406711227866029093464491"],"bits":16}}
from
{"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":"1/10"}]}]}}
{"id":"ba2f2ccf92c2aacf","x":["6/100","-392/100"],"v":["30","64"],"from":{"lattice":0,"atom":0,"cell":[0,-4]},"itinerary":[[0,0,1,-2],[0,0,-4,-4],[0,0,-5,-6]],"times":{"1":"0.0289214665011435908313826900423","2":"0.103304822000714017077961555528","3":"0.133203349306260312801797082328"},"end":{"x":["-4.91724005638614234001696374485","-5.94386808632309868662088478670"],"v":["70.2871185995937400093622001477","7.46464727677361378809939165390"],"bits":22}}
degrees
{"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0.5,0.8660254037844386]],"atoms":[{"position":[0,0],"radius":0.45}]}]}}
{"id":"bca6f35662f562c2","x":["-16/64","31/64"],"direction":{"degrees":"547/2"},"itinerary":[[0,0,0,0],[0,0,-1,1],[0,0,-1,0],[0,0,0,-1]],"times":{"1":"0.106157391249692789207984897898","2":"0.235515156908531191550636883487","4":"1.35878468371461840359160392390"},"end":{"x":["-0.192800570971553390061317551043","-0.537196404448010842511605754844"],"v":["0.879205204389006661038448277368","-0.476443289988729951782101144279"],"bits":15}}
slope
{"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],["1/4","5/4"]],"atoms":[{"position":[0,0],"radius":"1/5"},{"position":["1/2","3/5"],"radius":"1/7"},{"position":["0.3","0.7"],"radius":"0.03"}]}]}}
{"id":"eca7dd8c89d93403","x":["-36/64","-3/64"],"direction":{"slope":"-sqrt(5)"},"itinerary":[[0,0,1,-2],[0,1,0,-1],[0,2,1,-2],[0,1,0,-1],[0,0,0,-2]],"times":{"1":"1.01068228258518050773446201034","2":"1.63445408008928328993967859547","5":"3.23079040321239531273741531321"},"end":{"x":["-0.344694390820093618829040813693","-2.37398346236601253617924094103"],"v":["2.41925632802574478197443124632","0.383664983165508554585365783622"],"bits":29}}
lattices
{"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":"1/10"}]},{"vectors":[["4/5","3/5"],["-3/5","4/5"]],"atoms":[{"position":["1/2",0],"radius":"1/20"},{"position":["1/2","1/2"],"radius":"1/30"}]}]}}
{"id":"cebacaa5463521a0","x":["-48/28","5/30"],"v":["golden","-sqrt(3)"],"itinerary":[[1,0,-1,-5],[0,0,3,-4],[0,0,0,-5],[1,0,-1,-8],[1,1,-3,-9],[1,0,-3,-13],[0,0,6,-12],[1,0,-4,-13]],"times":{"1":"2.72350135648903850006865225406","2":"2.95022455939336452645048691408","5":"6.96551536513378290128813663894","8":"9.28062546367160868069717793040"},"end":{"x":["5.14046904652114521699846784229","-12.7706357994546184825027634144"],"v":["2.03317102595549579535440283952","1.21829781579258012352900281949"],"bits":52}}
needle
{"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[7,1]],"atoms":[{"position":["1/3","-1/7"],"semiaxes":[["9/20","3/20"],["-1/300","3/300"]]}]}]}}
{"id":"7417c280a6008e0a","x":[0.5,-0.75],"v":["-0.31",0.9],"itinerary":[[0,0,0,0],[0,0,7,-1],[0,0,0,0],[0,0,7,-1],[0,0,0,0],[0,0,7,-1]],"times":{"1":"0.649462089671220750957911389047","2":"1.62593917994279118159896592762","5":"4.55720018020142071057081815553","6":"5.53721740922315036646500541059"},"end":{"x":["0.690073732361070047817724064594","-1.01723614154821382247457268922"],"v":["-0.202920677758319185256085213419","0.930012472248681418448027002450"],"bits":24}}
needle and disc
{"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],["1/4","5/4"]],"atoms":[{"position":[0,0],"radius":"1/8"},{"position":["1/3","-1/7"],"semiaxes":[["9/20","3/20"],["-1/300","3/300"]]}]}]}}
{"id":"4f5e0ec59b76b807","x":["4647960/7","594305/7"],"v":["-1/4","-9/13"],"itinerary":[[0,0,647014,67920],[0,0,647015,67921],[0,1,647014,67921],[0,0,647014,67920],[0,0,647014,67921],[0,1,647012,67922]],"times":{"1":"0.878492245561055679250454507799","2":"2.96288141951798500275302296403","5":"6.64263458380500006153098046980","6":"8.82352042878406059922486551970"},"end":{"x":["663993.090602410697688220754786","84902.4337361107356474869163101"],"v":["-0.0229795156410771712244080028182","-0.735705024238181926872078184664"],"bits":30}}
ball
{"scene":{"dimension":3,"lattices":[{"vectors":[[1,0,0],[0,1,0],[0,0,1]],"atoms":[{"position":[0,0,0],"radius":"2/5"}]}]}}
{"id":"b7125c8fc262234e","x":["50/12","-29/11","-12/15"],"v":["sqrt(1/7)","sqrt(1/7)","-sqrt(0.3)"],"itinerary":[[0,0,5,-2,-2],[0,0,4,-2,-1],[0,0,4,-1,0],[0,0,5,-1,-2]],"times":{"1":"1.59638332778815720852449720336","2":"2.70724622299164468661584412391","4":"5.82973084596642116769392657633"},"end":{"x":["4.79555143687791949582310953616","-1.02378243573431726131482322191","-1.65702014521569968296302554693"],"v":["-0.436316487068516587827119116183","-0.0360036933864074947853753785211","0.627730788546341949057790058035"],"bits":18}}
needle in space
{"scene":{"dimension":3,"lattices":[{"vectors":[[1,"1/2",0],[0,1,"1/3"],["1/4",0,"5/4"]],"atoms":[{"position":["1/5",0,"-1/3"],"semiaxes":[["2/5","3/10","1/4"],["-1/30","1/20",0],["1/20",0,"-1/15"]]},{"position":["1/2","1/2","1/2"],"radius":"1/5"}]}]}}
{"id":"140b2ac2df9b65d6","x":[0.75,0.5,-0.25],"v":["0.3","-0.8","1.1e0"],"itinerary":[[0,0,1,-4,6],[0,1,0,-3,4],[0,1,19,-5,14],[0,1,24,-3,10],[0,1,25,-7,23],[0,1,25,-7,22],[0,1,24,-7,22]],"times":{"1":"5.31173129364994446088892313598","2":"6.52641613144496788999736531925","5":"41.0199905452392245560793172091","7":"42.3006032288221700939507205935"},"end":{"x":["30.1792603827916126653665409099","5.51781729683167605526867457279","25.7535473842915599603431877917"],"v":["0.932256614453852430560264888656","-0.473704468738028278116508650598","0.920055259810335268973692211161"],"bits":48}}
pocket
{"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":"3/5"}]}]}}
{"id":"30a6840eac444b16","x":["20/43","-17/33"],"v":["sqrt(1/7)","golden"],"itinerary":[[0,0,1,0],[0,0,0,0],[0,0,1,-1],[0,0,0,0],[0,0,1,-1],[0,0,0,0],[0,0,1,-1],[0,0,0,0]],"times":{"1":"0.107982086899446082078031222776","2":"0.114571471963049644614760264443","5":"0.516833937418519126547966215126","8":"0.914955685670162646170973867899"},"end":{"x":["0.352696071958415761381599137990","-0.485392089784232074308582506203"],"v":["0.375647481184881214742611997560","-1.61857347732084502333833710293"],"bits":15}}
grazing
{"scene":{"dimension":2,"lattices":[{"vectors":[[4,0],[0,1]],"atoms":[{"position":[0,"-1/10"],"radius":"1/10"},{"position":[2,0],"radius":"1/5"}]}]}}
{"id":"dea54a739ae230fd","x":[-1,"1e-100"],"v":[1,0],"itinerary":[[0,1,0,0],[0,1,-1,0]],"times":{"1":"2.80000000000000000000000000000","2":"6.40000000000000000000000000000"},"end":{"x":["-1.80000000000000000000000000000","3.70000000000000000000000000000e-99"],"v":["1.00000000000000000000000000000","3.80000000000000000000000000000e-98"],"bits":10}}
""".strip().splitlines()
for name, scene_line, line in zip(*[iter(LINES)] * 3):
    CASES[name] = json.loads(scene_line)["scene"], json.loads(line)

def compact(value):
    return json.dumps(value, separators=(",", ":"))

def lines_of(*cases, count=None):
    """A set of these: pairs of a scene and a record, whose id is made the one that belongs to it."""
    header = {**dict.fromkeys(check.HEADER, ""), "format": 1, "digits": 30, "count": len(cases) if count is None else count}
    lines = [compact({"golden": header})]
    for scene, record in cases:
        scene_line, line = compact({"scene": scene}), compact(record)
        question = line.partition(',"itinerary"')[0].partition(",")[2]
        identity = hashlib.sha256(f"{scene_line}\n{question}".encode()).hexdigest()[:16]
        lines += [scene_line, compact({**record, "id": identity})]
    return lines

def verdict(lines, quick=False):
    with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()) as said:
        path = pathlib.Path(folder) / "set.ndjson"
        path.write_text("".join(line + "\n" for line in lines))
        return check.File(str(path), quick).check(), said.getvalue()

def status_of(*arguments):
    run = subprocess.run([sys.executable, CHECKER, *arguments], capture_output=True, text=True)
    return run.returncode, run.stdout + run.stderr

def tampered(name, change):
    """The case after a change of its record, which may have another scene under that name."""
    scene, record = copy.deepcopy(CASES[name])
    record["scene"] = scene
    change(record)
    return record.pop("scene"), record

def digit(text, by=1):
    """The last digit of the mantissa is another one."""
    mantissa, *power = text.split("e")
    return "e".join([mantissa[:-1] + str((int(mantissa[-1]) + by) % 10), *power])

def turned(text):
    return text[1:] if text[0] == "-" else "-" + text

def at(place, new):
    """Sets what stands at this place, or changes it by a function."""
    def change(record):
        box = record
        for key in place[:-1]:
            box = box[key]
        box[place[-1]] = new(box[place[-1]]) if callable(new) else new
    return change

def hit(number, *obstacle):
    return at(("itinerary", number - 1), [*obstacle])

def without(*place):
    def change(record):
        for key in place[:-1]:
            record = record[key]
        del record[place[-1]]
    return change

def also(*changes):
    return lambda record: [change(record) for change in changes]

def ends_at(number, time):
    """The itinerary is no longer than that."""
    return lambda record: record.update(itinerary=record["itinerary"][:number], times={str(number): time})

def put_in(*obstacles):
    """After the first collision; the last time is then that of a later one."""
    def change(record):
        record["itinerary"][1:1] = obstacles
        record["times"] = {str(len(record["itinerary"])): [*record["times"].values()][-1]}
    return change

def last(key):
    return lambda record: record.update({key: record.pop(key)})

def start(**more):
    """More is said of the start."""
    return lambda record: record.update(more, **{key: record.pop(key) for key in ("itinerary", "times", "end")})

LEAVES = {"lattice": 0, "atom": 0, "cell": [1, 0]}
UNIT = [[1, 0], [0, 1]]
FLAT, THIN = ("scene", "lattices", 0, "atoms", 0), ("scene", "lattices", 0, "atoms", 1)
END = r": the end's "

# Each is a true record with one change, which makes it false: the case, what is changed, and why it is refused.
FALSE = [
    # Times.
    ("disc", "a time, by one in its last place", at(("times", "1"), digit), "collision 1, .*: the time is not 0.18"),
    ("disc", "a later time", at(("times", "2"), lambda t: digit(t, -1)), "collision 2, .*: the time is not"),
    ("disc", "the last time", at(("times", "5"), digit), "collision 5, .*: the time is not"),
    ("disc", "a time's sign", at(("times", "2"), turned), "collision 2, .*: the time is not -"),
    ("disc", "a time's power of ten", at(("times", "2"), lambda t: t + "e+1"), "the time is not .*e.1"),
    ("disc", "a digit less", at(("times", "2"), lambda t: t[:-1]), "the time has not 30 digits"),
    ("disc", "a digit more", at(("times", "1"), lambda t: t + "0"), "the time has not 30 digits"),
    ("disc", "no point", at(("times", "2"), "1"), "the time has not 30 digits: '1'"),
    ("disc", "text behind", at(("times", "2"), lambda t: t + " "), "the time has not 30 digits"),
    ("disc", "a huge power of ten", at(("times", "2"), lambda t: t + "e+999999999"), "the time has not 30 digits"),
    ("disc", "times in the wrong order", lambda r: r.update(times=dict(zip(r["times"], [*r["times"].values()][::-1]))),
     "collision 1, .*: the time is not 3.85"),
    # The end: of each coordinate the last digit, and its sign.
    *[(name, f"the end's {xv}[{i}]", at(("end", xv, i), change), rf"{END}{xv}\[{i}\] is not")
      for name, size in (("ball", 3), ("needle", 2), ("needle in space", 3)) for xv in "xv" for i in range(size)
      for change in (digit, turned)],
    ("needle in space", "two coordinates of the end exchanged", at(("end", "x"), lambda x: [x[1], x[0], x[2]]), rf"{END}x\[0\]"),
    ("ball", "place for velocity", lambda r: r["end"].update(x=r["end"]["v"], v=r["end"]["x"]), rf"{END}x\[0\]"),
    ("ball", "a digit less at the end", at(("end", "v", 2), lambda t: t[:-1]), rf"{END}v\[2\] has not 30 digits"),
    # Obstacles: another one of the line, of the cell, of the lattice.
    ("disc", "another first", hit(1, 0, 0, 2, 0), r"collision 1, with \(0, 0, \(2, 0\)\): \(0, 0, \(1, 0\)\) is entered before"),
    ("disc", "another later", hit(3, 0, 0, 1, 3), r"collision 3, .*: \(0, 0, \(0, 2\)\) is entered before"),
    ("disc", "one behind", hit(1, 0, 0, -1, 0), "collision 1, .*: it lies behind"),
    ("disc", "one that is left aside", hit(1, 0, 0, 1, 1), "collision 1, .*: the line misses it"),
    ("ball", "a ball passed over", hit(4, 0, 0, 6, -1, -4), r"\(0, 0, \(5, -1, -2\)\) is entered before"),
    ("needle", "a slender ellipse passed over", hit(1, 0, 0, -7, 1), r"\(0, 0, \(0, 0\)\) is entered before"),
    ("needle", "a later one", hit(5, 0, 0, -7, 1), r"collision 5, .*: \(0, 0, \(0, 0\)\) is entered before"),
    ("needle and disc", "a slender ellipse before a disc", hit(3, 0, 0, 647014, 67921), r"\(0, 1, \(647014, 67921\)\) is entered before"),
    ("needle and disc", "a slender ellipse before another", hit(6, 0, 1, 647011, 67923), r"\(0, 1, \(647012, 67922\)\) is entered before"),
    ("needle and disc", "a disc before a slender ellipse", hit(1, 0, 1, 647014, 67920), r"\(0, 0, \(647014, 67920\)\) is entered before"),
    ("needle and disc", "a slender ellipse behind", hit(1, 0, 1, 647014, 67921), "it lies behind"),
    ("needle in space", "a slender ellipsoid passed over", hit(1, 0, 0, 1, -7, 10), r"\(0, 0, \(1, -4, 6\)\) is entered before"),
    ("needle in space", "a ball before a slender ellipsoid", hit(2, 0, 0, 0, -2, 4), r"\(0, 1, \(0, -3, 4\)\) is entered before"),
    ("pocket", "the other side of a pocket", hit(1, 0, 0, 0, 0), r"collision 1, .*: \(0, 0, \(1, 0\)\) is entered before"),
    ("lattices", "a disc of the other lattice passed over", hit(1, 0, 0, 3, -5), r"\(1, 0, \(-1, -5\)\) is entered before"),
    ("lattices", "a second atom passed over", hit(5, 0, 0, 2, -11), r"\(1, 1, \(-3, -9\)\) is entered before"),
    ("lattices", "a third obstacle of the line", hit(1, 1, 1, -1, -8), "is entered before"),
    ("slope", "a third atom passed over", hit(3, 0, 1, 1, -2), r"\(0, 2, \(1, -2\)\) is entered before"),
    ("slope", "another atom of the cell", at(("itinerary", 0, 1), 1), r"collision 1, with \(0, 1, \(1, -2\)\): the line misses it"),
    ("slope", "another atom of a later cell", at(("itinerary", 3, 1), 0), "collision 4, .*: the line misses it"),
    ("lattices", "another lattice", at(("itinerary", 1, 0), 1), "collision 2, .*: the line misses it"),
    *[("ball", f"the cell's index {i}", at(("itinerary", 1, 2 + i), lambda n: n + 1), "collision 2, .*: (the line misses it|it lies behind)")
      for i in range(3)],
    # Collisions too many, too few, and in another order.
    ("disc", "one twice", put_in([0, 0, 1, 0]), "collision 2, .*: the particle leaves it"),
    ("disc", "one added", put_in([0, 0, 0, 3]), "collision 2, .*: the line misses it"),
    ("disc", "one left out", also(without("itinerary", 2), at(("times",), {"4": "3.85206235892633997884317449974"})),
     r"collision 3, with \(0, 0, \(0, 1\)\): the line misses it"),
    ("lattices", "the first left out", also(without("itinerary", 0), without("times", "8"), at(("times", "7"), "1.0")),
     r"collision 1, with \(0, 0, \(3, -4\)\): "),
    ("disc", "the last left out", ends_at(4, "3.85206235892633997884317449974"), "collision 4, .*: the time is not"),
    ("grazing", "the last left out, with its time", ends_at(1, "2.80000000000000000000000000000"), rf"{END}x\[0\]"),
    ("disc", "two exchanged", lambda r: r["itinerary"].__setitem__(slice(1, 3), r["itinerary"][2:0:-1]), "collision 2, with .*: the line misses"),
    # Starts.
    ("disc", "a start in an obstacle", at(("x", 0), "1/5"), r"the flight begins in \(0, 0, \(0, 0\)\)"),
    ("disc", "a start in the first one", at(("x", 0), "4/5"), "the particle is in it already"),
    ("needle and disc", "a start in a slender ellipse", at(("x",), ["1/3", "-1/7"]), "collision 1"),
    ("disc", "the start", at(("x", 0), "0.500000000000000000000000000001"), "collision 1, .*: the time is not"),
    ("disc", "the velocity", at(("v", 0), "1.000000000000000000000000000001"), "collision 1, .*: the time is not"),
    ("ball", "the velocity's sign", at(("v", 2), turned), "collision 1, .*: the line misses it"),
    ("degrees", "the angle", at(("direction", "degrees"), "549/2"), "collision 1, .*: the time is not"),
    ("degrees", "the angle's sign", at(("direction", "degrees"), "-547/2"), "collision 1, "),
    ("slope", "the slope", at(("direction", "slope"), "sqrt(5)"), "collision 1, .*: the line misses it"),
    ("from", "no obstacle that it leaves", without("from"), "not certain with 32768 bits"),
    ("from", "another obstacle that it leaves", at(("from", "cell"), [0, -3]), "not certain with 32768 bits"),
    ("disc", "it leaves the first", start(**{"from": LEAVES}), "collision 1, .*: the particle leaves it"),
    # Scenes, by less than a digit of the record.
    ("disc", "the radius", at((*FLAT, "radius"), "0.33333333333333333333333333"), "collision 1, .*: the time is not"),
    ("slope", "another atom's radius", at((*THIN, "radius"), "0.142857142857142857142857142857142"), "collision 5, .*the time|the end's"),
    ("lattices", "another atom's position", at(("scene", "lattices", 1, "atoms", 0, "position", 1), "1e-27"), "collision 1, .*: the time is not"),
    ("lattices", "a vector", at(("scene", "lattices", 1, "vectors", 0, 1), "0.6000000000000000000000000001"), "collision 1, .*: the time is not"),
    ("needle", "the ellipse transposed", at((*FLAT, "semiaxes"), lambda a: [*map(list, zip(*a))]), "collision 1, .*: the (line misses|time is not)"),
    ("needle", "a semiaxis", at((*FLAT, "semiaxes", 1, 0), "-0.00333333333333333333333333"), "collision 1, .*: the time is not"),
    ("needle in space", "the ellipsoid transposed", at((*FLAT, "semiaxes"), lambda a: [*map(list, zip(*a))]), "collision 1, .*: the (line misses|time is not)"),
    # What even many bits do not see, and what they do.
    ("grazing", "a disc grazed from within", at(("x", 1), "-1e-100"), r"\(0, 0, \(0, 0\)\) is entered before"),
    ("grazing", "a disc touched", at(("x", 1), "0"), "not certain with 32768 bits"),
    ("grazing", "a disc grazed too closely", at(("x", 1), "1e-9999"), "not certain with 32768 bits"),
    ("disc", "as many bits as nobody has", at(("end", "bits"), 10**6), "not certain with 32768 bits"),
    ("disc", "no velocity", at(("v", 0), 0), "not certain with 32768 bits"),
    ("disc", "a flight too long", also(at(("v", 1), "1e-8"), at(("x", 1), "1/2"), hit(1, 0, 0, 16700000, 1)), "too long"),
    ("ball", "the root of a negative number", at(("v", 0), "sqrt(-1/7)"), "the square root of a negative number"),
]

# Bad input: what no record and no scene is.
BAD = [
    ("disc", "no last time", without("times", "5"), "times: of"),
    ("disc", "no times", at(("times",), {}), "times: of"),
    ("disc", "a time of no collision", at(("times", "6"), "1"), "times: of"),
    ("disc", "a time before the first", at(("times", "0"), "1"), "times: of"),
    ("disc", "a time of a collision in other words", at(("times", "02"), "1"), "times: of"),
    ("disc", "no collisions", at(("itinerary",), []), "times: of"),
    ("disc", "a time that is no text", at(("times", "2"), 1.5), "TypeError"),
    *[("disc", "bits", at(("end", "bits"), bits), "bits: an integer") for bits in (-1, -10**9, 9.5, "9", None, True)],
    ("disc", "no bits", without("end", "bits"), "the end has x, v, bits"),
    ("disc", "more at the end", at(("end", "w"), 1), "the end has x, v, bits"),
    *[("disc", "a coordinate " + what, at(("end", xv), change), "the end has x, v, bits")
      for xv in "xv" for what, change in (("less", lambda x: x[:1]), ("more", lambda x: [*x, "0"]))],
    *[("disc", "no " + key, without(key), "Error: (keys|'itinerary')|substring") for key in ("x", "v", "itinerary", "times", "end")],
    ("disc", "other keys", at(("more",), 1), "keys: "),
    ("disc", "two ways to say v", start(direction={"slope": 0}), "keys: "),
    ("from", "what the id does not cover", last("from"), "keys: "),
    ("disc", "an order of keys", last("times"), "keys: "),
    ("degrees", "two directions", at(("direction", "slope"), 1), "ValueError"),
    ("degrees", "another direction", at(("direction",), {"radians": 1}), "no direction in the plane"),
    ("ball", "a direction in space", also(without("v"), start(direction={"slope": 1})), "no direction in the plane"),
    ("disc", "x in space", at(("x",), ["1/2", "1/10", 0]), "no array of 2 items"),
    ("disc", "v in space", at(("v",), [1, 0, 0]), "no array of 2 items"),
    *[("disc", f"no number: {value!r}", at(("x", 0), value), "no (rational )?number")
      for value in ("golden", "sqrt(2)", "0x1p-1", "+1", ".5", "1.", "1e", "1e99999", " 1", "nan", None, True, [1])],
    *[("disc", f"no number: {value!r}", at(("v", 0), value), "no (rational )?number") for value in ("sqrt(golden)", "--1", "pi", None)],
    ("disc", "a division by zero", at(("v", 0), "1/0"), "ZeroDivisionError"),
    *[("disc", f"no obstacle: {value}", at(("itinerary", 1), value), "no obstacle|TypeError")
      for value in ([0, 0, -1], [0, 0, -1, 1, 0], [0, 0, -1.0, 1], [0, 0, "-1", 1], None, {}, [0, 0, True, 1])],
    *[("disc", f"no atom: {value}", at(("itinerary", 1), value), "there is no atom") for value in ([0, 1, -1, 1], [1, 0, -1, 1], [0, -1, -1, 1])],
    *[("from", f"leaves nothing: {value}", at(("from",), value), "there is no atom|no obstacle|KeyError")
      for value in ({"lattice": 1, "atom": 0, "cell": [0, -4]}, {"lattice": 0, "atom": 1, "cell": [0, -4]},
                    {"lattice": 0, "atom": 0, "cell": [0]}, {"lattice": 0, "cell": [0, -4]})],
    *[("disc", f"dimension {d}", at(("scene", "dimension"), d), "dimension is 2 or 3|no array of 3 items") for d in (1, 3, 4, "2", None)],
    *[("disc", f"a radius {r}", at((*FLAT, "radius"), r), "not above zero|no number") for r in (0, "-1/3", None)],
    ("disc", "two shapes", at((*FLAT, "semiaxes"), UNIT), "an atom has radius or semiaxes"),
    ("disc", "no shape", without(*FLAT, "radius"), "an atom has radius or semiaxes"),
    ("disc", "a position in space", at((*FLAT, "position"), [0, 0, 0]), "no array of 2 items"),
    *[(name, "dependent vectors", at(place, [[1, 2], [2, 4]]), "vectors are dependent")
      for name, place in (("disc", ("scene", "lattices", 0, "vectors")), ("needle", (*FLAT, "semiaxes")))],
    *[(name, f"{len(rows)} vectors", at(place, rows), "no array of 2 items")
      for name, place in (("disc", ("scene", "lattices", 0, "vectors")), ("needle", (*FLAT, "semiaxes")))
      for rows in ([[1, 0]], [[1, 0], [0, 1], [1, 1]], [[1, 0, 0], [0, 1, 0]])],
]

class Accepts(unittest.TestCase):
    def accepted(self, *cases):
        status, said = verdict(lines_of(*cases))
        self.assertEqual(status, 0, said)
        self.assertIn(f": {len(cases)} records, {len(cases)} flown again, all right", said)

    def test_each_alone(self):
        for name in CASES:
            with self.subTest(name):
                self.accepted(CASES[name])

    def test_all_together(self):
        self.accepted(*CASES.values())

    def test_other_words(self):
        for name, change in [
            *[(name, at(("end", "bits"), bits)) for name in ("disc", "needle in space", "grazing") for bits in (0, 1, 2000)],
            ("ball", at(("end", "bits"), 25933)),  # just MOST_BITS
            ("disc", at(("x",), ["5e-1", "0.10"])), ("disc", at(("x",), [0.5, "1e-1"])), ("disc", at(("v",), ["3/3", "-0"])),
            ("disc", at(("v",), ["sqrt(1.0)", "-0e+0"])), ("disc", at(("scene", "lattices", 0, "vectors"), [["1.0", 0], ["0e0", "2/2"]])),
            ("degrees", at(("direction", "degrees"), "-173/2")), ("degrees", at(("direction", "degrees"), 1353.5)),
            ("disc", at(("times",), {"5": "3.85206235892633997884317449974"})), ("disc", at(("scene", "name"), "more")),
            ("grazing", also(at(("x", 1), "1e-9000"), at(("end", "x", 1), lambda t: t.replace("e-99", "e-8999")),
                             at(("end", "v", 1), lambda t: t.replace("e-98", "e-8998")))),
        ]:
            with self.subTest(f"{name} {tampered(name, change)}"):
                self.accepted(tampered(name, change))

class Refuses(unittest.TestCase):
    def refused(self, table, expected):
        for name, what, change, why in table:
            with self.subTest(f"{name}: {what}"):
                case = tampered(name, change)
                self.assertNotEqual(compact(case), compact(CASES[name]))
                status, said = verdict(lines_of(case))
                self.assertEqual(status, expected, said)
                self.assertRegex(said, why)

    def test_what_is_false(self):
        self.refused(FALSE, 1)

    def test_what_is_no_record(self):
        self.refused(BAD, 2)

    def test_more_than_one(self):
        """A false one is found wherever it stands, and those behind it are looked at, too."""
        names = "disc", "needle", "ball"
        for kinds in itertools.product((0, 1, 2), repeat=3):
            changes = lambda r: None, at(("end", "v", 1), digit), at(("end", "bits"), None)
            status, said = verdict(lines_of(*(tampered(name, changes[kind]) for name, kind in zip(names, kinds))))
            self.assertEqual(status, max(kinds), said)
            for i, kind in enumerate(kinds):
                self.assertEqual(said.count(f"ndjson:{2 * i + 3}: "), min(kind, 1), said)
            self.assertEqual("all right" in said, status == 0)

    def test_files(self):
        header, scene, line = lines_of(CASES["disc"])
        other, needle = lines_of(CASES["needle"])[1:]
        bad = json.loads(header)["golden"]
        for status, what, lines in [
            (0, "all right", [header, scene, line]),
            (0, ": 1 records, 1 flown again, all right", [header, other, scene, line]),
            (1, "0 records, not as many", [header, scene]),
            (1, "2 records, not as many", [*lines_of(CASES["disc"], CASES["needle"], count=1)]),
            (1, "is there twice", [header.replace('"count":1', '"count":2'), scene, line, line]),
            (1, "does not belong", [header, scene, line.replace('"x":[', '"x":[0,', 1)]),
            (1, "does not belong", [header, other, line]),
            (1, "does not belong", [header, scene.replace("1/3", "2/6"), line]),
            (1, "does not belong", [header, line]),
            (1, "0000: the id does not belong", [header, scene, line.replace(json.loads(line)["id"], "0" * 16)]),
            (2, "JSON", [header, scene, line, "{"]),
            (2, "JSON", [header, scene, "", line]),
            (2, "golden", [scene, line]),
            (2, "", [scene]),
            (2, "'id'", [header, scene, line, header]),
            (2, "'id'", [header, scene, line, "{}"]),
            (2, "a key comes twice among", [header, scene, line.replace('"x":', '"x":[],"x":', 1)]),
            (2, "a key comes twice among", [header, scene, line.replace('"5":', '"5":"1","5":', 1)]),
            (2, "a key comes twice among", [header, scene.replace('"radius":', '"radius":1,"radius":'), line]),
            (2, "RecursionError", [header, "[" * 100_000]),
            (2, "is empty: no header", []),
            *[(2, "the header has", [compact({"golden": head}), scene, line])
              for head in ({**bad, "format": 2}, {**bad, "format": 0}, {**bad, "digits": 0}, {**bad, "digits": 10**6 + 1},
                           {**bad, "more": 1}, {key: bad[key] for key in bad if key != "version"}, {})],
            (2, "Error", [compact({"golden": {**bad, "digits": "30"}}), scene, line]),
            (1, "the time has not 31 digits", [compact({"golden": {**bad, "digits": 31}}), scene, line]),
            (1, "not certain", [compact({"golden": {**bad, "digits": 10**6}}), scene, line]),
            (2, "Error", [header, scene.replace("[0,1]", "[0,1e999]"), line]),
        ]:
            got, told = verdict(lines)
            self.assertEqual(got, status, told)
            self.assertIn(what, told)

    def test_quick(self):
        """The first record of each scene, unless it is long."""
        true, false = CASES["disc"], tampered("disc", also(at(("x", 0), "2/4"), at(("end", "v", 1), digit)))
        both = lines_of(true, false)
        one_scene = [*both[:3], both[4]]
        self.assertEqual(verdict(one_scene)[0], 1)
        status, said = verdict(one_scene, quick=True)
        self.assertEqual((status, said.partition("ndjson")[2]), (0, ": 2 records, 1 flown again, all right\n"))
        self.assertEqual(verdict(both, quick=True)[0], 1)
        self.assertEqual(verdict([*both[:2], both[4], both[2]], quick=True)[0], 1)
        for count, status in ((check.MOST_QUICK, 1), (check.MOST_QUICK + 1, 0)):
            long = tampered("disc", put_in(*[[0, 0, 1, 0]] * (count - 5)))
            self.assertEqual(verdict(lines_of(long), quick=True)[0], status)
            first_is_long = lines_of(long, false)
            self.assertEqual(verdict([*first_is_long[:3], first_is_long[4]], quick=True)[0], 1)
            self.assertEqual(verdict(lines_of(long))[0], 1)

    def test_statuses(self):
        """The worst of several files decides, wherever it stands."""
        texts = {"good": lines_of(CASES["disc"]), "false": lines_of(tampered("disc", at(("times", "1"), digit))), "bad": ["{}"]}
        with tempfile.TemporaryDirectory() as folder:
            def path(name): return pathlib.Path(folder) / name
            for name, lines in texts.items():
                path(name).write_text("\n".join(lines))
            path("bytes").write_bytes(b"\xff\xfe")
            def main(*names):
                with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
                    return check.main([str(path(name)) if name[:1] != "-" else name for name in names])
            for status, *names in [
                (0, "good"), (0, "--quick", "good"), (0, "good", "good", "good"), (1, "false"), (2, "bad"), (2, "bytes"), (2, "none"), (2, ""),
                (1, "false", "good"), (1, "good", "false"), (1, "good", "false", "good"), (2, "bad", "good"), (2, "bad", "false", "good"),
                (2, "good", "false", "bad"), (2, "good", "bad", "false"), (2, "none", "good"), (2, "good", "none", "false"), (2, "", "good"),
                (2, "good", "bytes"), (2,), (2, "--quick"), (2, "--other", "good"), (2, "good", "-"), (1, "good", "--quick", "false"),
            ]:
                self.assertEqual(main(*names), status, names)
            for status, *names in [(0, "good"), (1, "false", "good"), (2, "bad"), (2, "bytes"), (2, "none"), (2,)]:
                got, told = status_of(*map(path, names))
                self.assertEqual(got, status, told)
                self.assertNotIn("Traceback", told)
                self.assertIn("" if names == ["bytes"] else names[0] if names else "Usage", told)

class Intervals(unittest.TestCase):
    """Whatever is in the intervals, the result is in theirs; and that is hardly wider than it must be. In so few bits each
    rounding shows."""
    ALL = [check.Interval(mid, rad, 3) for mid in range(-9, 10) for rad in (0, 1, 2, 5)]

    def ends(self, x):
        return Fraction(x.low(), 1 << x.bits), Fraction(x.high(), 1 << x.bits)

    def hold(self, got, values, slack):
        low, high = self.ends(got)
        self.assertLessEqual(low, min(values))
        self.assertGreaterEqual(high, max(values))
        self.assertLessEqual(high - low, max(values) - min(values) + Fraction(slack, 1 << got.bits))

    def test_sums_and_products(self):
        for x, y in itertools.product(self.ALL, repeat=2):
            pairs = [*itertools.product(self.ends(x), self.ends(y))]
            self.hold(x + y, [a + b for a, b in pairs], 0)
            self.hold(x - y, [a - b for a, b in pairs], 0)
            self.hold(-x, [-a for a in self.ends(x)], 0)
            self.hold(x * y, [a * b for a, b in pairs], 5 + 2 * x.rad * y.rad)
        draw = random.Random(20161117)
        for _ in range(300):
            a, b = ([draw.choice(self.ALL) for _ in range(3)] for _ in "ab")
            products = [[p * q for p, q in itertools.product(self.ends(x), self.ends(y))] for x, y in zip(a, b)]
            more = 2 * sum(x.rad * y.rad for x, y in zip(a, b))
            self.hold(check.dot(a, b), [sum(map(min, products)), sum(map(max, products))], 5 + more)

    def test_roots_and_reciprocals(self):
        for x in [check.Interval(mid, rad, bits) for mid in range(-9, 40) for rad in (0, 1, 3, 8) for bits in (1, 3, 6)]:
            low, high = self.ends(x)
            if low <= 0:
                with self.assertRaises(check.Refuted if high < 0 else check.Undecided):
                    check.square_root(x)
                if high >= 0:
                    self.assertRaises(check.Undecided, check.reciprocal, x)
                else:
                    got, other = check.reciprocal(x), check.reciprocal(-x)
                    self.assertLessEqual(abs(got.mid + other.mid), 1)
                    self.assertEqual(got.rad, other.rad)
                    self.hold(got, [1 / low, 1 / high], 9 + 2 * got.rad)
                continue
            root, one = check.square_root(x), 1 << x.bits
            self.assertLessEqual(max(root.low(), 0) ** 2, low * one**2)
            self.assertGreaterEqual(root.high() ** 2, high * one**2)
            self.assertLessEqual(root.rad, x.rad * one / math.isqrt(x.mid * one) + 2)
            got = check.reciprocal(x)
            self.assertLessEqual(got.low(), one / high)
            self.assertGreaterEqual(got.high(), one / low)
            self.assertLessEqual(got.rad, (1 / low - one / Fraction(x.mid)) * one + 2)

    def test_signs_and_bits(self):
        for x in self.ALL:
            low, high = self.ends(x)
            if low <= 0 <= high:
                self.assertRaises(check.Undecided, x.sign)
            else:
                self.assertEqual(x.sign(), 1 if low > 0 else -1)
            for bits in range(3):
                self.hold(x.with_bits(bits), self.ends(x), 5)
                self.assertEqual(x.with_bits(bits).bits, bits)
        for number in [Fraction(n, d) for n in range(-9, 10) for d in (1, 2, 3, 16)]:
            self.hold(check.interval(number, 3), [number], 2)
            self.assertEqual(check.interval(number, 4).rad == 0, number * 16 % 1 == 0)

ANGLES = (
    ("36", "0.80901699437494742410229341718281905886015458990288", "0.58778525229247312916870595463907276859765243764314"),
    ("300", "0.5", "-0.86602540378443864676372317075293618347140262690519"),
    ("990", "0", "-1"),
)

class CheckerParts(unittest.TestCase):
    def test_no_obstacle_along_a_flight_is_missing(self):
        """cells_along against all cells around: skew lattices, long ellipsoids, all directions."""
        draw = random.Random(20161116)
        def number(most): return Fraction(draw.randint(-99, 99), 100) * most
        met, looked_at = 0, 0
        for trial in range(45):
            size = draw.choice((2, 3))
            vectors = [[str(number(1) + (i == k) * 2) for k in range(size)] for i in range(size)]
            size_of_axes = Fraction(1, 2) if trial % 3 else Fraction(5, 2)  # larger than a cell
            axes = [[str(number(size_of_axes) + Fraction(i == k, 7)) for k in range(size)] for i in range(size)]
            scene = check.Scene({"dimension": size, "lattices": [
                {"vectors": vectors, "atoms": [{"position": [str(number(1)) for _ in range(size)], "semiaxes": axes}]}]})
            record = {"x": [str(number(2)) for _ in range(size)], "v": [str(number(3) + Fraction(1, 997)) for _ in range(size)]}
            particle = check.start_of(record, scene, check.COARSE)
            until = check.interval(Fraction(3), check.COARSE)
            listed = {*check.cells_along(particle, particle.shape(scene.atoms, (0, 0)), until)}
            looked_at += len(listed)
            for cell in itertools.product(range(-4, 5), repeat=size):
                approach = check.Approach(particle, scene.atoms, (0, 0, cell))
                if approach.D.mid > 0 and 0 < approach.time().mid < until.mid:
                    met += 1
                    self.assertIn(cell, listed, f"trial {trial}")
                    # Nor of one that begins just before the obstacle, or ends just behind its border.
                    moment, time = check.interval(Fraction(1, 50), check.COARSE), approach.time()
                    self.assertIn(cell, check.cells_along(particle, approach.shape, time + moment), f"trial {trial}")
                    nearer = [q + v * (time - moment) for q, v in zip(particle.offset, particle.v)]
                    nearer = check.Particle(particle.anchor, nearer, particle.v, particle.speed2)
                    self.assertIn(cell, check.cells_along(nearer, approach.shape, moment + moment), f"trial {trial}")
        self.assertGreater(met, 120)
        self.assertLess(looked_at, 1800)

    def test_columns(self):
        self.assertEqual([*check.columns(-1, 2)], [-1, 0, 1, 2])
        self.assertEqual(len(check.columns(0, check.MOST_COLUMNS)), check.MOST_COLUMNS + 1)
        self.assertRaises(check.Refuted, check.columns, 0, check.MOST_COLUMNS + 1)

    def test_inverses(self):
        for rows in [[0, 1], [1, 0]], [[0, 2], [3, 5]], [[0, 1, 0], [0, 0, 1], [1, 0, 0]], [[0, 1, 1], [1, 0, 1], [1, 1, 0]], [[1, 2, 0], [2, 4, 1], [0, 1, 5]]:
            for (i, row), (k, dual) in itertools.product(enumerate(rows), enumerate(check.inverse([[*map(Fraction, row)] for row in rows]))):
                self.assertEqual(sum(a * b for a, b in zip(row, dual)), i == k)

    def test_numbers_of_starts(self):
        for value, exact in (2**53 + 1, 2**53), (0.1, Fraction(0.1)), ("0.1", Fraction(1, 10)), (str(2**53 + 1), 2**53 + 1):
            self.assertEqual(check.rational(value), exact)  # without quotes it is a binary64
        for text, value in {"golden": "1.61803398874989484820458683436563811772030917980576",
                            "sqrt(2)": "1.41421356237309504880168872420969807856967187537694",
                            "-sqrt(1/3)": "-0.57735026918962576450914878050195745564760175127013",
                            "0.1": "0.1", "-7/4": "-1.75", "2.5e-3": "0.0025"}.items():
            off = check.surd(text, 200) - check.interval(Fraction(value), 200)
            self.assertLess(abs(off.mid), 2**200 // 10**49, text)
            self.assertLess(off.rad, 99, text)
        for degrees, cosine, sine in ANGLES:
            for got, value in zip(check.cosine_and_sine(Fraction(degrees), 200), (cosine, sine)):
                self.assertLess(abs((got - check.interval(Fraction(value), 200)).mid), 2**200 // 10**49)
                self.assertLess(got.rad, 99)
        for bad in "x", "sqrt(x)", "sqrt(-1)", "", "1/0", None, [], "inf":
            with self.assertRaises((ValueError, ZeroDivisionError, check.Refuted)):
                check.surd(bad, 100)

if __name__ == "__main__":
    unittest.main()
