// Judges answers with a golden set alone (docs/golden.md).
//   runner SET ANSWERS [ULPS]: a line for each record, its id and a verdict; the counts on stderr.
//   ULPS is above 0 and at most 16. Status 1: an answer is wrong, missing, or an error; 2: a file is unfit.
//   cargo init runner && cd runner && cargo add serde_json --features float_roundtrip && cp ../runner.rs src/main.rs && cargo build
use serde_json::Value;
use std::collections::{BTreeMap, HashMap};

// The integers of a cell as text; beyond 2^53 they are decimal strings.
fn cell(answer: &Value) -> Vec<String> {
    let whole = |n: &Value| n.as_f64().filter(|x| x.fract() == 0.0).map_or("none".to_string(), |x| format!("{:.0}", x + 0.0));
    let text = |n: &Value| n.as_str().map_or(whole(n), str::to_string);
    answer["cell"].as_array().map_or(vec![], |cell| cell.iter().map(text).collect())
}

fn same(a: &Value, b: &Value) -> bool {
    ["outcome", "lattice", "atom"].iter().all(|key| a.get(key) == b.get(key)) && cell(a) == cell(b)
}

fn ulp(t: f64, binary32: bool) -> f64 {
    if binary32 {
        let exponent = ((t.to_bits() >> 52) as i32 - 1023).max(-126); // also far below binary64's range
        return 2f64.powi(exponent - 23);
    }
    f64::from_bits(t.to_bits() + 1) - t
}

fn is_wrong_time(record: &Value, answer: &Value, ulps: f64, binary32: bool) -> bool {
    let (Some(time), Some(given)) = (record["expect"].get("time"), answer.get("time")) else { return false };
    let largest = 3.4028235677973366e38; // from here on a binary32 is infinite
    let t = time.as_f64().unwrap_or(f64::INFINITY);
    if t.is_infinite() || (given == "inf" && binary32 && t > largest) {
        return given != "inf";
    }
    let allowed = ulps * record["time_change"].as_f64().unwrap_or(0.0).max(ulp(t, binary32));
    !((given.as_f64().unwrap_or(f64::INFINITY) - t).abs() <= allowed)
}

fn verdict(record: &Value, answer: Option<&Value>, ulps: f64, binary32: bool) -> &'static str {
    let Some(answer) = answer else { return "missing" };
    let (outcome, expect) = (answer["outcome"].as_str().unwrap_or(""), &record["expect"]);
    if outcome == "undecided" || outcome == "later" {
        return "undecided";
    }
    if outcome == "error" && expect["outcome"] != "error" {
        return if answer["reason"] == "unsupported" { "unsupported" } else { "error" };
    }
    if same(answer, expect) {
        return if is_wrong_time(record, answer, ulps, binary32) { "wrong-time" } else { "agree" };
    }
    let none = vec![];
    let others = record["acceptable"].as_array().unwrap_or(&none);
    if others.iter().any(|other| same(answer, other) && other["ulps"].as_f64().unwrap_or(f64::INFINITY) <= ulps) {
        return "ill-posed";
    }
    let needs_judge = record["tags"].as_array().is_some_and(|tags| tags.iter().any(|tag| tag == "needs-judge"));
    if needs_judge { "needs-judge" } else { "wrong" }
}

fn refuse(why: String) -> ! {
    eprintln!("{why}");
    std::process::exit(2);
}

fn lines(path: &str) -> Vec<Value> {
    let text = std::fs::read_to_string(path).unwrap_or_else(|why| refuse(format!("{path}: {why}")));
    let numbered = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    numbered
        .map(|(i, line)| serde_json::from_str(line).unwrap_or_else(|why| refuse(format!("{path}:{}: {why}", i + 1))))
        .collect()
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let ulps = arguments.get(3).map_or(4.0, |text| text.parse().unwrap_or(0.0));
    if arguments.len() < 3 || !(ulps > 0.0 && ulps <= 16.0) {
        refuse("usage: runner SET ANSWERS [ULPS]; ULPS is above 0 and at most 16".to_string());
    }
    let mut answers = HashMap::new();
    for answer in lines(&arguments[2]) {
        let Some(id) = answer["id"].as_str().map(str::to_string) else { continue };
        if let Some(earlier) = answers.insert(id, answer) {
            refuse(format!("{}: the id {} comes twice", arguments[2], earlier["id"]));
        }
    }
    let set = lines(&arguments[1]);
    let header = set.first().map_or(&Value::Null, |line| &line["golden"]);
    let records: Vec<&Value> = set.iter().filter(|line| line.get("expect").is_some()).collect();
    if header["count"] != records.len() {
        refuse(format!("{}: needs a first line with `golden`, and as many records as its `count`", arguments[1]));
    }
    let mut counts = BTreeMap::new();
    for record in records {
        let id = record["id"].as_str().expect("an id");
        let found = verdict(record, answers.get(id), ulps, header["precision"] == "binary32");
        *counts.entry(found).or_insert(0) += 1;
        println!("{id} {found}");
    }
    eprintln!("{counts:?}");
    let failed = ["wrong", "missing", "error"].iter().any(|word| counts.contains_key(word));
    std::process::exit(failed as i32);
}
