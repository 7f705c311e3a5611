"""data/check.py accepts golden records that are right, and no others: python3 -m unittest tests/golden/check_py_test.py"""
import contextlib, copy, decimal, hashlib, importlib.util, io, itertools, json, math, pathlib, random, subprocess, sys, tempfile, unittest
from fractions import Fraction

CHECK = pathlib.Path(__file__).resolve().parents[2] / "data" / "check.py"
COMMAND = [sys.executable, CHECK]
SPEC = importlib.util.spec_from_file_location("check", CHECK)
check = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(check)

CASES = {}
for line in r"""
{"name":"plane","scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.1}]}]},"query":{"x":[0,0.445],"v":[1,0.0175]},"expect":{"outcome":"hit","lattice":0,"atom":0,"cell":[26,1],"time":25.999999999999996},"time_decimal":"25.99999999999999682793421535957075817597","certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.0999846910161925,"to":3.4203543907686442,"basis":[[1,0],[5,1]]},{"lattice":0,"atom":0,"from":3.420354390768644,"to":26.099984691016193,"basis":[[1,0],[46,1]]}]}}
{"name":"space","scene":{"dimension":3,"lattices":[{"vectors":[[1,0,0],[0,1,0],[0,0,1]],"atoms":[{"position":[0,0,0],"radius":0.125}]}]},"query":{"x":[0.5,0.25,0.375],"v":[0.75,0.0625,0.34]},"expect":{"outcome":"hit","lattice":0,"atom":0,"cell":[22,2,10],"time":28.549120949274403},"time_decimal":"28.54912094927440243637094145171315360155","certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.15136164385082043,"to":3.725294598299205,"basis":[[2,0,1],[1,0,0],[7,1,3]]},{"lattice":0,"atom":0,"from":3.7252945982992047,"to":24.29866453542075,"basis":[[2,0,1],[11,1,5],[-3,0,-1]]},{"lattice":0,"atom":0,"from":24.298664535420748,"to":28.700482593125226,"basis":[[2,0,1],[1,0,0],[7,1,3]]}]}}
{"name":"ellipse","scene":{"dimension":2,"lattices":[{"vectors":[[1,0.5],[-0.25,"0x1.8p-1"]],"atoms":[{"position":[0.1,0.2],"semiaxes":[[0.2,0.1],[-0.02,0.06]]}]}]},"query":{"x":[0.5,0.6],"v":[0.3,-0.41]},"expect":{"outcome":"hit","lattice":0,"atom":0,"cell":[1,-2],"time":3.3654502279441734},"time_decimal":"3.365450227944173308300031593375820982714","certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.12452421468701413,"to":3.489974442631188,"basis":[[0,1],[1,-3]]}]}}
{"name":"ellipsoid","scene":{"dimension":3,"lattices":[{"vectors":[[1,0.5,0],[0,1,0.125],[0.25,0,1]],"atoms":[{"position":[0.1,0.2,0.3],"semiaxes":[[0.2,0.1,0],[-0.02,0.06,0.01],[0,0,0.07]]}]}]},"query":{"x":[0.5,0.6,0],"v":[0.3,-0.41,0.17]},"expect":{"outcome":"hit","lattice":0,"atom":0,"cell":[3,-5,2],"time":9.711732260223108},"time_decimal":"9.711732260223108948954942542773851066409","certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.11377963189691757,"to":9.825511892120028,"basis":[[1,-2,1],[-3,7,-3],[0,2,-1]]}]}}
{"name":"superposition","scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.05}]},{"vectors":[[0.8,0.6],[-0.6,0.8]],"atoms":[{"position":[0.5,0],"radius":0.04},{"position":[0,0.3],"radius":0.06}]}]},"query":{"x":[0.45,0.7],"v":[0.31,0.9]},"expect":{"outcome":"hit","lattice":1,"atom":0,"cell":[1,1],"time":0.7397353520510233},"time_decimal":"0.7397353520510232070321189024489251546197","certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.05252692037926174,"to":0.792262272430285,"basis":[[0,1],[1,3]]},{"lattice":1,"atom":0,"from":-0.042021536303409386,"to":0.7817568883544327,"basis":[[1,1],[-3,-2]]},{"lattice":1,"atom":1,"from":-0.06303230445511408,"to":0.8027676565061374,"basis":[[1,1],[-2,-1]]}]}}
{"name":"tie","scene":{"dimension":2,"lattices":[{"vectors":[[4,0],[0,1]],"atoms":[{"position":[0,0.5],"radius":0.3},{"position":[0,0],"radius":0.3}]}]},"query":{"x":[-1,0.25],"v":[1,0]},"expect":{"outcome":"hit","lattice":0,"atom":0,"cell":[0,0],"time":0.83416876048223},"time_decimal":"0.8341687604822300276289435793218177924543","certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.30000000000000004,"to":1.1341687604822301,"basis":[[0,1],[1,0]]},{"lattice":0,"atom":1,"from":-0.30000000000000004,"to":1.1341687604822301,"basis":[[0,1],[1,0]]}]}}
{"name":"never2","scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.25}]}]},"query":{"x":[0,0.5],"v":[1,0]},"expect":{"outcome":"never"},"certificate":{"rows":[{"lattice":0,"atom":0,"basis":[[1,0],[0,1]]}]}}
{"name":"never3","scene":{"dimension":3,"lattices":[{"vectors":[[1,0,0],[0,1,0],[0,0,1]],"atoms":[{"position":[0,0,0],"radius":0.25}]}]},"query":{"x":[0.5,0,0.5],"v":[1,1,0]},"expect":{"outcome":"never"},"certificate":{"rows":[{"lattice":0,"atom":0,"basis":[[1,1,0],[0,1,0],[0,0,1]]}]}}
{"name":"inside","scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":1.25}]}]},"query":{"x":[0.5,0.25],"v":[1,0.3]},"expect":{"outcome":"inside","lattice":0,"atom":0,"cell":[0,0]},"certificate":{"windows":[{"lattice":0,"atom":0,"from":-1.1972828565264393,"to":-0.8755388445146162,"basis":[[0,1],[1,-3]]},{"lattice":0,"atom":0,"from":-0.8755388445146163,"to":1.1972828565264393,"basis":[[0,1],[1,0]]}]}}
{"name":"inside3","scene":{"dimension":3,"lattices":[{"vectors":[[1,0,0],[0,1,0],[0,0,1]],"atoms":[{"position":[0,0,0],"radius":0.25},{"position":[0.5,0.5,0.5],"radius":0.75},{"position":[0.5,0.5,0.5],"radius":0.75}]}]},"query":{"x":[0.5,0.25,0.5],"v":[0,0,1],"from":{"lattice":0,"atom":1,"cell":[-1,0,0]}},"expect":{"outcome":"inside","lattice":0,"atom":1,"cell":[0,0,0]},"certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.25000000000000006,"to":0.25000000000000006,"basis":[[0,0,1],[1,0,0],[0,1,0]]},{"lattice":0,"atom":1,"from":-0.7500000000000001,"to":0.7500000000000001,"basis":[[0,0,1],[1,0,0],[0,1,0]]}]}}
{"name":"from","scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.25}]}]},"query":{"x":[0.2,0.1],"v":[1,0.5],"from":{"lattice":0,"atom":0,"cell":[0.0,"0"]}},"expect":{"outcome":"hit","lattice":0,"atom":0,"cell":[2,1],"time":1.576393202250021},"time_decimal":"1.576393202250021019256852386875306972220","certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.223606797749979,"to":1.8,"basis":[[1,0],[2,1]]}]}}
{"name":"far","scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.1}]}]},"query":{"x":[0,0.5],"v":[1,4e-21]},"expect":{"outcome":"hit","lattice":0,"atom":0,"cell":["100000000000000007859",1],"time":1e+20},"time_decimal":"100000000000000007858.9999999999795255560","certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.10000000000000002,"to":"0x56bc75e2d63101eb4p0","basis":[[1,0],["200000000000000012942",1]]}]}}
{"name":"at once","scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.5}]}]},"query":{"x":[-0.5,0],"v":[1,0.25]},"expect":{"outcome":"hit","lattice":0,"atom":0,"cell":[0,0],"time":0},"time_decimal":"0","certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.485071250072666,"to":0.485071250072666,"basis":[[1,0],[0,1]]}]}}
{"name":"exact","scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.25}]}]},"query":{"x":[-0.75,0],"v":[1,0]},"expect":{"outcome":"hit","lattice":0,"atom":0,"cell":[0,0],"time":0.5},"time_decimal":"0.5000000000000000000000000000000000000000","certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.25,"to":0.75,"basis":[[1,0],[0,1]]}]}}
{"name":"inf","scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.25}]}]},"query":{"x":[0.5,0.125],"v":[1e-320,0]},"expect":{"outcome":"hit","lattice":0,"atom":0,"cell":[1,0],"time":"inf"},"time_decimal":"2.834968051720322701504158358630275386392e+319","certificate":{"windows":[{"lattice":0,"atom":0,"from":"-0x26dadaf2fc0a443cf863867419d951e00a246afa25108413fe1ccd272a1f7db1dae88731cade824c127f4211950828873457b8daeb148e6f7fc084d75e634c107da134627db21518cedfed9f24ef884a5d5dac1a5a3bf56761fe9561b380000000000000000000000000000000000000000000000000000000000000000000000000000000p0","to":"0x40c21794f96671baf3508ac1806a332010e75cf63dc63176a78555ebf0df26d317838bfda772d92974296e1d4db8438c01e7896cdd2242b9d4eb88119d502970d16201f97c28cdd4037536b3e839e3269b9c1ed69663ee56f8a84e4d80800000000000000000000000000000000000000000000000000000000000000000000000000000000p0","basis":[[1,0],[0,1]]}]}}
{"name":"grazing","scene":{"dimension":3,"lattices":[{"vectors":[[1,0,0],[0,1,0],[0,0,1]],"atoms":[{"position":[0,0,0],"radius":0.0625}]}]},"query":{"x":[-0.125,0.5,-0.5788799140207264],"v":[-0.7370550907175644,2.3659868388811133e-14,1.0]},"expect":{"outcome":"hit","lattice":0,"atom":0,"cell":[-13629053087962,1,18491227127531],"time":18491227127531.58},"time_decimal":"18491227127531.57887511304201284117765100","certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.05031087208648526,"to":18491227127531.633,"basis":[[3760203,0,-5101658],[536027,0,-727255],[-28801017958691,1,39075800874873]]}]}}
{"name":"ball","scene":{"dimension":3,"lattices":[{"vectors":[],"atoms":[{"position":[1,0,0],"radius":0.25}]}]},"query":{"x":[0,0,0],"v":[1,0.2,0.1]},"expect":{"outcome":"hit","lattice":0,"atom":0,"cell":[],"time":0.8333333333333334},"time_decimal":"0.8333333333333333487530975642382872809222","certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.244140625,"to":1.078125,"basis":[]}]}}
{"name":"ball missed","scene":{"dimension":3,"lattices":[{"vectors":[],"atoms":[{"position":[1,0,0],"radius":0.25}]}]},"query":{"x":[0,0,0],"v":[1,0.5,0.1]},"expect":{"outcome":"never"},"certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.2236328125,"to":"inf","basis":[]}]}}
{"name":"row","scene":{"dimension":2,"lattices":[{"vectors":[[2,0]],"atoms":[{"position":[0,0],"radius":0.25}]}]},"query":{"x":[0.5,1],"v":[3,-0.5]},"expect":{"outcome":"hit","lattice":0,"atom":0,"cell":[3],"time":1.7602086128846213},"time_decimal":"1.760208612884621234326343088267311765970","certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.0947265625,"to":1.864990234375,"basis":[[1]]}]}}
{"name":"row missed","scene":{"dimension":2,"lattices":[{"vectors":[[2,0]],"atoms":[{"position":[0,0],"radius":0.25}]}]},"query":{"x":[1,1],"v":[1,2]},"expect":{"outcome":"never"},"certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.150390625,"to":"inf","basis":[[1]]}]}}
{"name":"row followed","scene":{"dimension":2,"lattices":[{"vectors":[[2,0]],"atoms":[{"position":[0,0],"radius":0.25}]}]},"query":{"x":[1,0.5],"v":[1,0]},"expect":{"outcome":"never"},"certificate":{"rows":[{"lattice":0,"atom":0,"basis":[[1]]}]}}
{"name":"layer","scene":{"dimension":3,"lattices":[{"vectors":[[1,0,0],[0,1,0]],"atoms":[{"position":[0,0,0],"radius":0.125}]}]},"query":{"x":[0.5,0.5,9.5],"v":[5,7,-1]},"expect":{"outcome":"hit","lattice":0,"atom":0,"cell":[48,67],"time":9.48556624327026},"time_decimal":"9.485566243270259355887271280487451063609","certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.0150146484375,"to":9.501708984375,"basis":[[1,1],[1,2]]}]}}
{"name":"layer missed","scene":{"dimension":3,"lattices":[{"vectors":[[1,0,0],[0,1,0]],"atoms":[{"position":[0,0,0],"radius":0.125}]}]},"query":{"x":[0.5,0.5,1],"v":[3,1,-1]},"expect":{"outcome":"never"},"certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.045654296875,"to":"inf","basis":[[1,0],[1,1]]}]}}
{"name":"impurity","scene":{"dimension":3,"lattices":[{"vectors":[[1,0,0],[0,1,0],[0,0,1]],"atoms":[{"position":[0,0,0],"radius":0.25}]},{"vectors":[],"atoms":[{"position":[5,0.5,0.5],"radius":0.125}]}]},"query":{"x":[0.5,0.5,0.5],"v":[1,0,0]},"expect":{"outcome":"hit","lattice":1,"atom":0,"cell":[],"time":4.375},"time_decimal":"4.375000000000000000000000000000000000000","certificate":{"windows":[{"lattice":0,"atom":0,"from":-0.25,"to":4.625,"basis":[[1,0,0],[0,1,0],[0,0,1]]},{"lattice":1,"atom":0,"from":-0.125,"to":4.5,"basis":[]}]}}
{"name":"impurity missed","scene":{"dimension":3,"lattices":[{"vectors":[[1,0,0],[0,1,0],[0,0,1]],"atoms":[{"position":[0,0,0],"radius":0.25}]},{"vectors":[],"atoms":[{"position":[5,0.5,0.5],"radius":0.125}]}]},"query":{"x":[0.5,0.5,0.5],"v":[-1,0,0]},"expect":{"outcome":"never"},"certificate":{"rows":[{"lattice":0,"atom":0,"basis":[[-1,0,0],[0,-1,0],[0,0,1]]}],"windows":[{"lattice":1,"atom":0,"from":-0.125,"to":"inf","basis":[]}]}}
{"name":"impurity left","scene":{"dimension":3,"lattices":[{"vectors":[[1,0,0],[0,1,0],[0,0,1]],"atoms":[{"position":[0,0,0],"radius":0.25}]},{"vectors":[],"atoms":[{"position":[5,0.5,0.5],"radius":0.125}]}]},"query":{"x":[5,0.5,0.5],"v":[-1,0,0],"from":{"lattice":1,"atom":0,"cell":[]}},"expect":{"outcome":"never"},"certificate":{"rows":[{"lattice":0,"atom":0,"basis":[[-1,0,0],[0,-1,0],[0,0,1]]}],"windows":[{"lattice":1,"atom":0,"from":-0.125,"to":"inf","basis":[]}]}}
{"name":"error","scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.25}]}]},"query":{"x":[0.5,0.5],"v":[0,0]},"expect":{"outcome":"error"}}
""".strip().splitlines():
    case = json.loads(line)
    CASES[case.pop("name")] = case

def compact(value):
    return json.dumps(value, separators=(",", ":"))

def record(case, identity=None):
    """A line of a golden set; its id is that of its question, unless another is given."""
    question = compact(case["query"])[1:-1]
    own = hashlib.sha256(f"{compact({'scene': case['scene']})}\n{question}".encode()).hexdigest()[:16]
    rest = {key: case[key] for key in ("expect", "time_decimal", "certificate") if key in case}
    return f'{{"id":"{identity or own}","tags":["t"],{question},{compact(rest)[1:]}'

def golden(*cases, count=None):
    lines = [compact({"golden": {"format": 1, "name": "n", "count": len(cases) if count is None else count, "tags": {"t": ""}}})]
    for case in cases:
        lines += [compact({"scene": case["scene"]}), record(case)]
    return lines

def run(lines):
    """Exit status and output for a file of these lines."""
    with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()) as output:
        path = pathlib.Path(folder) / "set.ndjson"
        path.write_text("".join(line + "\n" for line in lines))
        return check.check(str(path)), output.getvalue()

class Accepts(unittest.TestCase):
    def test_each_alone(self):
        for name, case in CASES.items():
            with self.subTest(name):
                status, said = run(golden(case))
                self.assertEqual(status, 0, said)

    def test_all_together(self):
        self.assertRegex(run(golden(*CASES.values()))[1], f"ndjson: {len(CASES)} records, all verified\n")

    def test_the_program(self):
        def status(*arguments, text=""):
            return subprocess.run([*COMMAND, *arguments], input=text, text=True, capture_output=True).returncode
        lines = golden(CASES["exact"], CASES["never2"])
        self.assertEqual(status("-", text="\n".join(lines)), 0)
        self.assertEqual(status("-", text="\n".join(lines[:-1])), 1)
        self.assertEqual(status("-", text="\n".join(lines + ["{"])), 2)
        self.assertEqual(status("-"), 2)
        self.assertEqual(status(), 2)

    def test_the_worst_file_decides(self):
        """Wherever it stands among others, each of which is looked at; a folder and a missing file are bad."""
        good, refuted = golden(CASES["exact"]), golden(CASES["exact"], count=2)
        worst = {"good": 0, "refuted": 1, "bad": 2, "none": 2, ".": 2}
        several = [("good",), ("none",), (".",), *itertools.permutations(("good", "refuted", "bad"), 2), ("good", "good"),
                   *itertools.permutations(("good", "refuted", "bad")), ("good", "refuted", "good"), ("refuted", "good", "good"),
                   ("good", "bad", "good"), ("none", "good"), ("good", "none"), (".", "good"), ("good", ".", "good"), ("refuted", "none")]
        with tempfile.TemporaryDirectory() as folder:
            for name, lines in (("good", good), ("refuted", refuted), ("bad", [*good, "{"])):
                (pathlib.Path(folder) / name).write_text("\n".join(lines))
            for files in several:
                done = subprocess.run([*COMMAND, *files], capture_output=True, text=True, cwd=folder)
                self.assertEqual(done.returncode, max(map(worst.get, files)), files)
                for name in {*worst} - {"none", "."} if not {"none", "."} & {*files} else ():
                    self.assertEqual(f"{name}:" in done.stdout, name in files, done)

    def test_proofs_may_say_more(self):
        """More than is needed does no harm: other forms of a number, more windows, larger ones."""
        for name, change in {
            "plane": lambda c: c["certificate"]["windows"].insert(1, {**c["certificate"]["windows"][0], "to": 5}),
            "space": lambda c: [w.update({"from": v["to"]}) for v, w in zip(c["certificate"]["windows"], c["certificate"]["windows"][1:])],
            "exact": lambda c: c["certificate"]["windows"][0].update({"from": "-0x1p0", "to": "0x3p0"}),
            "inside3": lambda c: c["certificate"]["windows"].pop(0) and c["certificate"]["windows"].insert(
                0, {"lattice": 0, "atom": 0, "from": -3, "to": 3, "basis": [[0, 1, 0], ["1", 0, "-0"], [0, 0, 1]]}),
            "superposition": lambda c: c["certificate"]["windows"].append({**c["certificate"]["windows"][0], "to": 0}),
            "never2": lambda c: c["certificate"]["rows"][0]["basis"][0].__setitem__(0, -1),
            "far": lambda c: c.update(time_decimal="1.000000000000000078589999999999795255560e+20"),
        }.items():
            with self.subTest(name):
                case = copy.deepcopy(CASES[name])
                change(case)
                status, said = run(golden(case))
                self.assertEqual(status, 0, said)

class Search(unittest.TestCase):
    def test_finds_what_is_met(self):
        """met() against the definition, tried on all obstacles near by, in bases of all kinds."""
        rng = random.Random(20240229)
        for trial in range(240):
            size, small = 2 + trial % 2, trial >= 120  # of small integers ends and bounds meet
            rank = rng.choice((size, size, *range(size)))
            numbers = [[rng.choice((rng.randint(-3, 3), rng.randint(-16, 16) / 8)[: 2 - small]) for _ in range(size)] for _ in range(10)]
            shape = {"radius": rng.choice((1, 2) if small else (0.5, 1.25))} if trial % 3 else {"semiaxes": numbers[:size]}
            scene = {"dimension": size, "lattices": [{"vectors": numbers[3:3 + rank], "atoms": [
                {"position": numbers[6], **shape}]}]}
            basis = [[int(i == j) for j in range(rank)] for i in range(rank)]
            for _ in range(rng.randint(0, 5) if rank > 1 else 0):
                (i, j), k = rng.sample(range(rank), 2), rng.choice((-1, 1, 3))
                basis[i] = [a + k * b for a, b in zip(basis[i], basis[j])]
            rng.shuffle(basis)
            try:
                ball = check.read_query({"x": numbers[7], "v": numbers[8]}, *check.read_scene(scene))[2][0, 0]
            except ValueError:
                continue
            v, Q, R, w, u, k = ball
            self.assertEqual(k, rank)
            near = {}
            for n in itertools.product(range(-5, 6), repeat=rank):
                n += (0,) * (3 - rank)
                c = check.add(w, 1, check.combine(n, u))
                near[n] = check.dot(v, c), R - check.dot(check.cross(v, c), check.cross(v, c))
            low, high = sorted((rng.choice([s for s, _ in near.values()]), rng.randint(-3 * Q, 9 * Q)))  # one end is at an obstacle
            rows = [*check.matrix(basis, rank, int), *((1, 0, 0), (0, 1, 0), (0, 0, 1))[rank:]]
            def all_met(high):
                found = {tuple(n): (s, D) for s, D, n in check.met(ball, rows, low, high, [10**6])}
                for n, (s, D) in near.items():
                    inside = low <= s and (high is None or s <= high)
                    self.assertTrue(n in found if D > 0 and inside else D > 0 or n not in found, (scene, basis, n))
                    self.assertEqual(found.get(n, (s, D)), (s, D))
                self.assertTrue(all(D > 0 for _, D in found.values()))
            all_met(high)
            if rank < size and check.independent([v, *u[:rank]]): all_met(None)
            elif rank == size: self.assertRaises(ValueError, all_met, None)

class Refuses(unittest.TestCase):
    def test_a_format_that_is_not_known_is_bad_input(self):
        header, *lines = golden(CASES["exact"])
        for other in (0, 3, -1):
            status, output = run([header.replace('"format":1', f'"format":{other}'), *lines])
            self.assertEqual(status, 2, output)
        status, output = run([header.replace('"count":1', '"count":2'), *lines])
        self.assertEqual(status, 1, output)

    def refused(self, name, why, *changes):
        """Each change of the case is refused, for that reason."""
        for change in changes:
            case = copy.deepcopy(CASES[name])
            result = change(case)
            case = result if type(result) is dict and "scene" in result else case
            status, output = run(golden(case))
            self.assertEqual(status, 1, output)
            self.assertRegex(output, why)

    def window(self, name, why, *changes):
        self.refused(name, why, *(lambda case, c=c: c(case["certificate"]["windows"]) for c in changes))

    def claim(self, name, why, *claims):
        self.refused(name, why, *(lambda case, c=c: case["expect"].update(c) for c in claims))

    def test_wrong_obstacle(self):
        self.claim("plane", "is no hit", {"cell": [25, 1]}, {"cell": [-1, 0]}, {"cell": [0, 1]})
        self.claim("superposition", "is no hit", {"atom": 1}, {"lattice": 0})
        self.claim("far", "is no hit", {"cell": ["100000000000000007858", 1]})
        self.claim("inside", "is no inside", {"cell": [0, 2]})
        self.refused("plane", "is no inside", lambda c: [c["expect"].pop("time"), c.pop("time_decimal"), c["expect"].update(outcome="inside")])
        self.refused("inside", "is no hit", lambda c: c.update(time_decimal="1") or c["expect"].update(outcome="hit", time=1))

    def test_touched(self):
        """A line that touches a disc does not meet it."""
        def touching(case):
            case["query"]["x"] = [-0.75, 0.25]
            case["expect"].update(time=0.75)
            case.update(time_decimal="0.75" + "0" * 38)
            case["certificate"]["windows"][0]["to"] = 1
        self.refused("exact", "is no hit", touching)

    def test_later_obstacle(self):
        def later(case):
            case["expect"].update(cell=[1, 0], time=1.5)
            case.update(time_decimal="1.5" + "0" * 38)
            case["certificate"]["windows"][0]["to"] = 1.75
        self.refused("exact", r"\(0, 0, \(0, 0, 0\)\) comes first", later)
        self.claim("tie", "comes first", {"atom": 1})

    def test_earlier_than_the_proof(self):
        """Windows have to begin at -r / |v|, to the last unit: here that is between the two smallest binary64s."""
        scene = json.loads(compact(CASES["exact"]["scene"]).replace("0.25", str(1.5 * 2**-74)))
        self.refused("exact", "a gap before", lambda case: case.update(scene=scene, query={"x": [-0.75, 0], "v": [2.0**1000, 0]}) or
                     case["certificate"]["windows"][0].update({"from": -5e-324}))

    def test_from(self):
        at = {"lattice": 0, "atom": 0, "cell": [0, 0]}
        self.refused("exact", "is no hit", lambda case: case["query"].update({"from": at}))
        self.refused("from", "comes first", lambda case: case["query"].pop("from"))
        self.refused("inside", "is no inside", lambda case: case["query"].update({"from": at}))
        self.refused("never2", "met", lambda case: case["query"].update({"x": [0, 0.875], "from": {**at, "cell": [1, 1]}}))

    def test_inside(self):
        self.claim("inside", "comes first", {"cell": [1, 0]})
        self.refused("inside3", "a gap", lambda case: case["certificate"]["windows"].pop(1) and case["expect"].update(atom=2) or
                     case["certificate"]["windows"].append({**CASES["inside3"]["certificate"]["windows"][1], "atom": 2}))

    def test_basis(self):
        self.window("plane", "determinant", lambda w: w[1]["basis"][0].__setitem__(0, 2))
        self.window("space", "determinant", lambda w: w[2]["basis"].__setitem__(0, [0, 0, 0]))
        self.refused("never3", "determinant", lambda case: case["certificate"]["rows"][0]["basis"][1].__setitem__(1, 2))

    def test_windows(self):
        self.window("plane", "a gap|no hit", lambda w: w.pop(0), lambda w: w.pop(1), lambda w: w.reverse())
        self.window("plane", "a gap", lambda w: w[0].update(to=3.4), lambda w: w.append({**w[0], "from": 2, "to": 1}))
        for k in range(3):
            self.window("superposition", "a gap|no hit", lambda w: w.pop(k), lambda w: w[k].update(to=w[k]["to"] - 1e-9),
                        lambda w: w[k].update({"from": w[k]["from"] + 1e-9}))
        self.window("exact", "a gap|no hit", lambda w: w[0].update(to=0.7499999999999999), lambda w: w[0].update({"from": -0.24999999999999997}))
        self.window("inside", "a gap", lambda w: w[1].update(to=1.1))
        self.window("exact", "a gap|no hit", lambda w: w.append({**w[0], "from": 0, "to": 0.7}) or w[0].update(to=0.7))

    def test_time(self):
        why = "time is not correctly rounded"
        self.claim("plane", why, {"time": 26}, {"time": 25.999999999999993}, {"time": "inf"}, {"time": 1e308})
        self.claim("inf", why, {"time": 1.7976931348623157e308})
        self.claim("at once", why, {"time": -0.0}, {"time": 5e-324}, {"time": "-0x0p0"})
        self.claim("plane", "ValueError", {"time": None}, {"time": "26"}, {"time": True})

    def test_time_below_a_power_of_two(self):
        """There binary64s are half as far apart."""
        for off, right in ((3, 1.0), (5, 1 - 2**-53)):
            t = Fraction(1) - Fraction(off, 2**56)
            case = copy.deepcopy(CASES["exact"])
            case["scene"]["lattices"][0].update(vectors=[[4, 0], [0, 4]], atoms=[{"position": [1.25, 0], "radius": 0.25}])
            case["query"]["x"] = [off * 2.0**-56, 0]
            case["time_decimal"] = "0." + str(round(t * 10**40))
            case["certificate"]["windows"][0]["to"] = 1.25
            for time in (1.0, 1 - 2**-53, 1 - 2**-52, 1 + 2**-52):
                case["expect"]["time"] = time
                status, said = run(golden(case))
                self.assertEqual(status, int(time != right), said)
                self.assertIn("all verified" if time == right else "time is not correctly rounded", said)

    def test_digits(self):
        def digits(*texts):
            return [lambda case, t=text: case.update(time_decimal=t) for text in texts]
        plane = CASES["plane"]["time_decimal"]
        self.refused("plane", "time_decimal", *digits(plane[:-1] + "6", plane[:-1] + "8", plane[:-1], plane + "0", "0", "2" + plane[2:],
                                                      "0" + plane[:-1], plane[0] + "." + plane[1] + plane[3:] + "e+2"))
        self.refused("at once", "time_decimal", *digits("0." + "0" * 40, "1e-500"))
        self.refused("plane", "Error", *digits(26, None, plane + " ", "+" + plane, plane.replace(".", ",")))

    def test_never(self):
        self.refused("never2", "met", lambda case: case["query"].update(x=[0, 0.25 - 2**-40]), lambda case: case["query"].update(
            x=[0.75, 0.1]) or case["certificate"]["rows"][0]["basis"][0].__setitem__(0, -1))
        self.refused("never3", "met", lambda case: case["query"].update(x=[0.5, 0.5, 0.2]), lambda case: case["query"].update(x=[0.5, 0.2, 0.9]))
        self.refused("never2", "along", lambda case: case["query"].update(v=[1, 2**-60]))
        self.refused("never3", "along", lambda case: case["certificate"]["rows"][0]["basis"].reverse())
        self.refused("never2", "no rows", lambda case: case["scene"]["lattices"][0]["atoms"].append({"position": [0, 0], "radius": 0.1}),
                     lambda case: case["scene"]["lattices"].append({"vectors": [[1, 0], [0, 1]], "atoms": [{"position": [0, 0], "radius": 0.1}]}))
        self.claim("exact", "Error", {"outcome": "never"})

    def test_lattices_of_fewer_vectors(self):
        """Obstacles of cells of their own length, windows without an end, bases of the lattice's size."""
        def window(case): return case["certificate"]["windows"][0]
        for name, v in (("ball missed", [1, 0.2, 0.1]), ("row missed", [1, -1]), ("row missed", [-1, -1]), ("layer missed", [1.5, 1.5, -1]),
                        ("impurity missed", [1, 0, 0])):
            self.refused(name, "met", lambda case: case["query"].update(v=v) or window(case).update({"from": -9}))
        for name in ("ball missed", "row missed", "layer missed", "impurity missed"):
            self.refused(name, "no rows of|gap", lambda case: window(case).update(to=1e300), lambda case: case["certificate"]["windows"].clear())
            self.refused(name, "gap", lambda case: window(case).update({"from": 0}))
            self.refused(name, "Error", lambda case: window(case).update({"from": "inf"}), lambda case: window(case).update(to="-inf"))
        self.refused("impurity left", "met", lambda case: case["query"].pop("from") and None)
        self.refused("impurity missed", "no rows", lambda case: case["certificate"].pop("rows"))
        self.refused("never2", "planes, rows|Error", lambda case: case["certificate"].update(
            rows=[], windows=[{"lattice": 0, "atom": 0, "from": -9, "to": "inf", "basis": [[1, 0], [0, 1]]}]))
        self.refused("row followed", "along", lambda case: case["query"].update(v=[1, 2**-60]))
        self.refused("ball", "Error", lambda case: case["expect"].update(cell=[0]), lambda case: window(case).update(basis=[[1]]))
        self.refused("row", "Error", lambda case: case["expect"].update(cell=[]), lambda case: case["expect"].update(cell=[0, 0]),
                     lambda case: window(case).update(basis=[]), lambda case: window(case).update(basis=[[1, 0], [0, 1]]))
        self.refused("row", "determinant", lambda case: window(case).update(basis=[[2]]))
        self.refused("row", "rows prove", lambda case: case["certificate"].update(rows=[{"lattice": 0, "atom": 0, "basis": [[1]]}]))

    def test_never_of_several_atoms(self):
        """No atom's rows may be missing, with two lattices of three atoms each, wherever the atom is."""
        def several(case):
            lattice, rows = case["scene"]["lattices"][0], case["certificate"]["rows"][0]
            lattice["atoms"] = [{"position": [x, 0], "radius": 0.125} for x in (0, 0.25, 0.5)]
            case["scene"]["lattices"] = [lattice, copy.deepcopy(lattice)]
            case["certificate"]["rows"] = [{**rows, "lattice": l, "atom": a} for l in range(2) for a in range(3)]
            return case
        whole = several(copy.deepcopy(CASES["never2"]))
        self.assertEqual(run(golden(whole))[0], 0)
        for missing in range(6):
            def without(case):
                several(case)["certificate"]["rows"].pop(missing)
            def in_the_way(case):
                without(case)
                case["scene"]["lattices"][missing // 3]["atoms"][missing % 3]["position"][1] = 0.5
            self.refused("never2", "no rows", without, in_the_way)

    def test_what_cannot_be(self):
        self.claim("plane", "keys", {"outcome": "later"}, {"outcome": "undecided"}, {"outcome": "error"}, {"outcome": None}, {"outcome": []})
        self.claim("never2", "keys", {"outcome": "error"})
        self.refused("never2", "v is zero", lambda case: case["query"].update(v=[0, 0]))
        self.refused("plane", "Error", lambda case: case.pop("expect"), lambda case: case.update(expect=[]))

    def test_errors(self):
        """Invalid queries yield an error, and no others do."""
        at = {"lattice": 0, "atom": 0, "cell": [0, 0]}
        def error(**query):
            return {**CASES["error"], "query": {"x": [0, 0], "v": [1, 0], **query}}
        none = [error(x=x) for x in ([0], [0, 0, 0], "00", None, [0, None], [0, "0"], [0, True], [0, "0x1p1024"], {"0x0p0": 0, "0x1p0": 0})]
        none += [error(v=v) for v in ([0, 0], [-0.0, "0x0p0"], [1], [1, "inf"])]
        none += [error(**{"from": {**at, **change}}) for change in (
            {"lattice": 1}, {"atom": 1}, {"atom": -1}, {"cell": [0]}, {"cell": [0, 0, 0]}, {"cell": [0, 0.5]}, {"cell": [0, "+1"]}, {"cell": 0}, {"cell": [0, 1e20]},
            {"cell": [0, 2.0**53 + 2]}, {"cell": [-2.0**53 - 2, 0]})]
        none += [error(**{"from": value}) for value in (None, [], {}, {"lattice": 0})]
        for case in none:
            self.assertEqual(run(golden(case))[0], 0, case)
        lines = golden(error(x=[0, 12345]))
        question = lines[2][lines[2].index('"x"'):lines[2].index(',"expect"')].replace("12345", "1e999")
        identity = hashlib.sha256((lines[1] + "\n" + question).encode()).hexdigest()[:16]
        self.assertEqual(run(lines[:2] + ['{"id":"%s","tags":["t"],%s,"expect":{"outcome":"error"}}' % (identity, question)])[0], 0)
        for case in error(), error(x=["0x1p3", "-0X.8"]), error(v=[5e-324, 0]), error(**{"from": {**at, "cell": [27.0, "-5"]}}), error(
                **{"from": {**at, "cell": [2.0**53, -2.0**53]}}), error(**{"from": {**at, "cell": [2**53 + 1, -2**53 - 1]}}):
            self.refused("error", "outcome", lambda _: case)

    def test_malformed_proofs(self):
        def w(change):
            return lambda case: case["certificate"]["windows"][1].update(change)
        self.refused("plane", "Error", lambda case: case.pop("certificate"), lambda case: case.update(certificate=[]), lambda case: case.update(
            certificate={"rows": []}), lambda case: case["certificate"].update(windows={}), lambda case: case["certificate"].update(windows=[[]]))
        self.refused("plane", "Error", *map(w, ({"lattice": 1}, {"atom": "x"}, {"atom": 0.5}, {"atom": None}, {"from": None}, {"to": "1e3"}, {"to": True},
                                                {"basis": None}, {"basis": [[1, 0]]}, {"basis": [[1, 0], [0]]}, {"basis": [[1.5, 0], [0, 1]]},
                                                {"basis": [[1, 0], [0, "1.0"]]}, {"basis": [[True, 0], [0, 1]]}, {"basis": [1, 0]})))
        self.claim("plane", "Error", {"cell": [26.5, 1]}, {"cell": [26]}, {"cell": [26, 1, 0]}, {"cell": "26"}, {"lattice": 0.5}, {"atom": None})

    def test_too_large(self):
        self.window("plane", "too many", lambda w: w[1].update(to=10**9), lambda w: w[1].update(to="0x" + "1" * 99 + "p0"))
        self.window("space", "too many", lambda w: w[2].update(to=10**8), lambda w: w[2].update(basis=[[10**9, 0, 10**9 - 1], [1, 0, 1], [0, 1, 0]]))
        self.window("exact", "too many", lambda w: w[0].update(to=10**7))

    def test_scenes(self):
        def scene(change, why="Error"):
            case = copy.deepcopy(CASES["never2"])
            change(case["scene"])
            status, output = run(golden(case))
            self.assertEqual(status, 2, output)
            self.assertRegex(output, why)
        def atom(**atom):
            scene(lambda s: s["lattices"][0]["atoms"].__setitem__(0, {"position": [0, 0], **atom}))
        for radius in 0, -0.25, "0.25", None, [0.25]:
            atom(radius=radius)
        atom(semiaxes=[[1, 0], [0, 1]], radius=1)
        atom(semiaxes=[[1, 2], [2, 4]])
        atom()
        for d in 1, 3, 4, "2":
            scene(lambda s: s.update(dimension=d))
            scene(lambda s: s.update(dimension=d, lattices=[{"vectors": [[1] * 4] * 4, "atoms": [{"position": [0] * 4, "radius": 1}]}]))
        scene(lambda s: s["lattices"][0].update(vectors=[[1, 2], [2, 4]]))
        scene(lambda s: s["lattices"][0].update(atoms=[]), "an empty scene")
        scene(lambda s: s["lattices"].insert(0, {**s["lattices"][0], "atoms": []}), "an empty scene")
        scene(lambda s: s["lattices"].append({**s["lattices"][0], "atoms": []}), "an empty scene")
        scene(lambda s: s.update(lattices=[]), "an empty scene")

    def test_files(self):
        header, scene, line = golden(CASES["plane"])
        self.assertEqual(run([header, scene, line + " "])[0], 0)
        for lines, status, why in (
                ([header, scene, record(CASES["plane"], "0" * 16)], 1, "does not belong"),
                ([header, scene.replace("0.1", "0.10"), line], 1, "does not belong"),
                ([header, line], 1, "does not belong"),
                *[([header, scene, f'{{"id":{none}{line[line.index(",", 1):]}'], 2, "Error") for none in ("null", "false", '""', "[]", "{}")],
                ([header, scene, f'{{"id":5{line[line.index(",", 1):]}'], 1, "does not belong"),
                (golden(CASES["plane"], CASES["plane"]), 1, "twice"),
                (golden(CASES["plane"], count=2), 1, "records, not"),
                ([header.replace('"t"', '"u"'), scene, line], 1, "tags"),
                ([scene, line], 2, "golden"),
                ([header, scene, line[:-1]], 2, "Error"),
                ([header, scene, "[]"], 2, "Error"),
                ([header, scene, line.replace('"tags"', '"nan":NaN,"tags"')], 2, "Error"),
                ([header, scene, "[" * 10**5], 2, "Error"),
                ([header, scene, line[:-1] + ',"x":[0,0.5]}'], 2, "twice"),
                ([header, scene, line[:-1] + ',"from":{"lattice":0,"atom":0,"cell":[0,0]}}'], 1, "order")):
            got, output = run(lines)
            self.assertEqual(got, status, output)
            self.assertRegex(output, why)

class Exits(unittest.TestCase):
    """An exit_time is correctly rounded where it stands. The proved checker passes over it."""
    def held(self, name, exit_time, status, why, **query):
        case = copy.deepcopy(CASES[name])
        case["query"].update(query)
        case["expect"]["exit_time"] = exit_time
        got, said = run(golden(case))
        self.assertEqual(got, status, said)
        self.assertRegex(said, why)

    def test_each(self):
        """Against roots in 200 digits."""
        decimal.getcontext().prec = 200
        for name in "ball", "plane", "inside", "exact", "at once", "inf":
            case = CASES[name]
            lattice = case["scene"]["lattices"][0]
            cell, radius = case["expect"]["cell"], decimal.Decimal(lattice["atoms"][0]["radius"])
            centre = [p + sum(n * u[i] for n, u in zip(cell, lattice["vectors"])) for i, p in enumerate(lattice["atoms"][0]["position"])]
            w = [decimal.Decimal(c) - decimal.Decimal(x) for c, x in zip(centre, case["query"]["x"])]
            v = list(map(decimal.Decimal, case["query"]["v"]))
            s, vv = sum(a * b for a, b in zip(v, w)), sum(a * a for a in v)
            right = float((s + (s * s - vv * (sum(a * a for a in w) - radius**2)).sqrt()) / vv)
            if right == math.inf:
                self.held(name, "inf", 0, "verified")
                self.held(name, 1.7976931348623157e308, 1, "exit_time is not correctly rounded")
                continue
            self.held(name, right, 0, "verified")
            for wrong in math.nextafter(right, 0), math.nextafter(right, math.inf), -right, "inf", case["expect"].get("time", 0):
                self.held(name, wrong, 1, "exit_time is not correctly rounded")
            for none in None, "soon", [right]:
                self.held(name, none, 1, "ValueError|Error")

    def test_where_there_is_none(self):
        self.held("never2", 1.0, 1, "has no exit_time")
        self.held("error", 1.0, 1, "has no exit_time")

class Parts(unittest.TestCase):
    def test_ends_of_windows(self):
        for text in "0x1p16384", "-0X.1P-16380", "0x0p-16384":
            check.bound(text)
        for text in "0x1p16385", "-0x.1p-16381", "0x0p-16385":
            self.assertRaisesRegex(ValueError, "an exponent beyond", check.bound, text)

    def test_steps(self):
        left = [5]
        check.spend(left, 2), check.spend(left, 3)
        self.assertRaisesRegex(ValueError, "too many", check.spend, left, 1)
        case = CASES["exact"]
        many = {"windows": case["certificate"]["windows"] * (check.STEPS // 10 + 1)}  # each costs ten
        self.assertRaisesRegex(ValueError, "too many", check.verify, {**case, **case["query"], "certificate": many}, check.read_scene(case["scene"]))

    def test_signs(self):
        """The sign of a + sqrt b - sqrt c."""
        for a, b, c in itertools.product(range(-5, 6), range(30), range(30)):
            about = a * 10**30 + math.isqrt(b * 10**60) - math.isqrt(c * 10**60)
            self.assertEqual(check.sign(a, b, c), 0 if abs(about) < 9 else 1 if about > 0 else -1, (a, b, c))

class Rounds(unittest.TestCase):
    def test_binary(self):
        """rounds() against Python's own division, which is correctly rounded; ties, powers of two, tiny numbers."""
        rng = random.Random(1)
        for _ in range(3000):
            t = Fraction(rng.choice((2**53, 2**53 - 1, 2**52, 2**52 + 1, rng.getrandbits(53), 1, 2, 3))) + rng.choice(
                (0, Fraction(1, 2), -Fraction(1, 4), Fraction(1, 4), Fraction(1, 2) + Fraction(1, 2**70), -Fraction(1, 4) - Fraction(1, 2**70)))
            t *= Fraction(2) ** rng.choice((0, 7, -1074, -1075, -1073, -1076, -1022 - 52, 971, -30))
            for time in (float(t), check.math.nextafter(float(t), 0), check.math.nextafter(float(t), 1e999)) if t < 2**1024 - 2**970 else ("inf", 2.0**1023):
                root = rng.randint(1, 99)  # t = (s - sqrt D) / Q, or (s + sqrt D) / Q
                D, Q = (root * t.denominator)**2, t.denominator
                for order_to in (check.entry((t.numerator + root * Q, D, Q)), check.exit_at(t.numerator - root * Q, D, Q)):
                    right = time == (float(t) if t < 2**1024 - 2**970 else "inf")
                    n = 2**2098 if time == "inf" else check.number(time) if time < 1e999 else 2**2098
                    k = max(n.bit_length() - 53, 0)
                    self.assertEqual(check.rounds(order_to, n >> k, 2, k - 1074, 53), right, (t, time))

    def test_decimal(self):
        for t, n, k, right in ((Fraction(10**40 - 1), 10**39, 1, False), (Fraction(10**41 - 4), 10**39, 2, True), (Fraction(10**41 - 6), 10**39, 2, False),
                               (Fraction(10**41 - 5), 10**39, 2, True), (Fraction(10**40 + 5), 10**39, 1, True), (Fraction(10**40 + 15), 10**39 + 1, 1, False),
                               (Fraction(10**40 + 15), 10**39 + 2, 1, True), (Fraction(5, 10**80), 5 * 10**39, -119, True)):
            self.assertEqual(check.rounds(check.entry((t.numerator, 0, t.denominator)), n, 10, k, 40), right, (t, n, k))

if __name__ == "__main__":
    unittest.main()
