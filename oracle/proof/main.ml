(* Verifies golden sets by the check that Coq has proved sound (docs/proof.md); says what data/check.py says.
   Trusted besides Coq: these files of OCaml, which read, and Zarith. Every decision is Checker's. *)
module Zarith = Z
open Checker
module Z = Zarith  (* Checker has a Z of its own *)

let usage = "usage: oracle/proof/check [--budget STEPS] FILE... (exit status: 0 verified, 1 refuted, 2 bad input)"
let budget = ref (Z.of_int 1_000_000)  (* steps of a record: a proof should not need them *)

(* ---- What is wrong, in the words of check.py. *)
let comma strings = String.concat ", " strings
let numbers l = "(" ^ comma (List.map Z.to_string l) ^ ")"

(* As check.py sees it: in space. *)
let name o =
  let cell = List.filteri (fun i _ -> i < 3) (o.cell @ [ Z.zero; Z.zero; Z.zero ]) in
  Printf.sprintf "(%s, %s, %s)" (Z.to_string o.of_lattice) (Z.to_string o.of_atom) (numbers cell)

let words outcome answer = function
  | NoNumber -> "no number: beyond the range of binary64"
  | NoVector -> "not an array of the expected length"
  | BadScene -> "no volume or shape"
  | BadQuery -> "v is zero, or `from` is not an obstacle of the scene"
  | Determinant -> "a determinant is not +-1: obstacles are missing"
  | NotAlong -> "b_1 is not along v"
  | GapBefore i -> Printf.sprintf "the windows leave a gap before window %s" (Z.to_string i)
  | GapAfter (l, a) -> (
      match answer with Never -> Printf.sprintf "no rows of %s, or a gap" (numbers [ l; a ]) | _ -> numbers [ l; a ] ^ ": a gap")
  | TooMany -> "a window with too many planes, rows, or obstacles in a row"
  | NoRows (l, a) -> Printf.sprintf "no rows of [%s], or met is []" (numbers [ l; a ])
  | Met o -> Printf.sprintf "no rows of [], or met is [%s]" (name o)
  | NotTheOutcome -> (
      match answer with Hit (o, _, _, _) | Inside o -> Printf.sprintf "%s is no %s" (name o) outcome | Never -> "the outcome is not never")
  | ComesFirst o -> name o ^ " comes first"
  | NotRounded -> "time is not correctly rounded"
  | WrongDigits -> "time_decimal is wrong"

(* ---- A record. *)
let own_keys = function
  | "hit" -> [ "lattice"; "atom"; "cell"; "time"; "time_decimal" ]
  | "inside" -> [ "lattice"; "atom"; "cell" ]
  | _ -> []

let check_keys outcome box =
  let present box = List.filter (fun key -> Json.has key box) in
  let has = present (Json.get "expect" box) [ "id"; "lattice"; "atom"; "cell"; "time" ] @ present box [ "time_decimal" ] in
  Record.require
    (has = own_keys outcome && (outcome <> "error" || not (Json.has "certificate" box)))
    (Printf.sprintf "keys: '%s' has %s" outcome (comma (own_keys outcome)))

let check_words box =
  let is_text key = match Json.find key (Json.get "expect" box) with None | Some (Json.String _) -> true | _ -> false in
  Record.require (List.for_all is_text [ "message"; "reason" ]) "what is said of an answer is a string"

(* No theorem is about the outcome `error`. It is checked that the question is invalid. *)
let is_question (scene : Record.scene) box =
  match Record.question scene.size box with q -> is_question scene.prepared q | exception (Record.Flaw _ | Json.Bad _) -> false

let verify (scene : Record.scene) box =
  let outcome = match Json.get "outcome" (Json.get "expect" box) with Json.String s -> s | _ -> "" in
  check_keys outcome box;
  check_words box;
  match outcome with
  | "error" -> Record.require (not (is_question scene box)) "the outcome is not 'error'"
  | "hit" | "inside" | "never" -> (
      let question = Record.question scene.size box in
      let answer = Record.answer scene.size outcome box in
      let certificate = Record.certificate scene (outcome = "never") (Json.get "certificate" box) in
      match check_record scene.prepared question answer certificate !budget with
      | Inl _ -> ()
      | Inr flaw -> Record.flaw (words outcome answer flaw))
  | _ -> Record.flaw (Printf.sprintf "the outcome is not '%s'" outcome)

(* ---- Files. *)
type set = {
  file : string;
  mutable flaws : (int * string) list;
  mutable records : int;
  mutable errors : int;
  mutable scene : Record.scene option;
  mutable text : string;  (* the scene's line *)
  mutable version : Z.t option;
  mutable count : Z.t option;
  tags : (string, unit) Hashtbl.t;
  ids : (string, unit) Hashtbl.t;
}

let read_header set box =
  let head = Json.get "golden" box in
  set.version <- Some (Record.integer (Json.get "format" head));
  set.count <- Some (Record.integer (Json.get "count" head));
  let tags = Json.get "tags" head in
  List.iter (fun tag -> Hashtbl.replace set.tags tag ()) (Json.keys tags);
  let named = List.filter_map (fun key -> Json.find key head) [ "name"; "description"; "generator"; "version" ] in
  let is_string = function Json.String _ -> true | _ -> false in
  Record.require (List.for_all is_string named && List.for_all (fun (_, said) -> is_string said) (Json.members tags)) "names and tags are explained in strings";
  let is_known = function None | Some (Json.String ("binary64" | "binary32")) -> true | Some _ -> false in
  Record.require (is_known (Json.find "precision" head)) "unknown precision"

let find_text text part first =
  let n = String.length part in
  let rec search i =
    if i + n > String.length text then Record.flaw (Printf.sprintf "no %s in the line" part)
    else if String.sub text i n = part then i
    else search (i + 1)
  in
  search first

(* The question's text, "from behind the first `],` to before the first `,"expect"`". *)
let question_text line =
  let first = find_text line "],\"" 0 + 2 and last = find_text line ",\"expect\"" 0 in
  Record.require (first <= last) "the order of the keys";
  String.sub line first (last - first)

(* id, tags, the keys of the question, expect, and then only keys that no question has. *)
let check_order box question =
  let asked = Json.keys (Json.parse ("{" ^ question ^ "}")) in
  let rec follow keys wanted =
    match (keys, wanted) with
    | "expect" :: rest, [] -> List.for_all (fun k -> not (List.mem k [ "x"; "v"; "from" ])) rest
    | key :: keys, want :: wanted -> key = want && follow keys wanted
    | _ -> false
  in
  Record.require (asked <> [] && follow (Json.keys box) ("id" :: "tags" :: asked)) "the order of the keys"

let check_tags set box =
  let tags = Json.list (Json.get "tags" box) in
  Record.require (tags <> [] && List.for_all (fun t -> Hashtbl.mem set.tags (Json.text t)) tags) "unknown tags"

let read_record set box line =
  let question = question_text line in
  check_order box question;
  let own = String.sub (Sha256.to_hex (Sha256.string (set.text ^ "\n" ^ question))) 0 16 in
  Record.require (Json.get "id" box = Json.String own) "the id does not belong";
  Record.require (not (Hashtbl.mem set.ids own)) "the id is there twice";
  Hashtbl.add set.ids own ();
  check_tags set box;
  match set.scene with None -> Record.flaw "no scene" | Some scene ->
  verify scene box;
  if Json.get "outcome" (Json.get "expect" box) = Json.String "error" then set.errors <- set.errors + 1

let is_falsy = function
  | Json.Null | Json.Bool false | Json.String "" | Json.Array [] | Json.Object [] -> true
  | _ -> false

let read_line set number line =
  let identity = ref None in
  try
    let box = Json.parse line in
    Record.require ((number = 1) = Json.has "golden" box) "a golden set begins with its header, and has one";
    if number = 1 then read_header set box
    else if Json.has "scene" box then begin
      Record.require (not (List.exists (fun k -> Json.has k box) [ "id"; "x"; "v"; "from" ])) "a scene's line with a key of a record";
      set.scene <- Some (Record.scene (Json.get "scene" box));
      set.text <- line
    end
    else begin
      let id = Json.get "id" box in
      set.records <- set.records + 1;
      if not (is_falsy id) then identity := Some (match id with Json.String s -> s | _ -> "?");
      read_record set box line
    end
  with
  | (Record.Flaw what | Json.Bad what) ->
      let status = if !identity = None then 2 else 1 in
      let id = Option.value !identity ~default:"None" in
      set.flaws <- (status, Printf.sprintf "%s:%d: %s: ValueError: %s" set.file number id what) :: set.flaws
  | (Z.Overflow | Stack_overflow | Out_of_memory) as e ->
      let status = if !identity = None then 2 else 1 in
      set.flaws <- (status, Printf.sprintf "%s:%d: Error: %s" set.file number (Printexc.to_string e)) :: set.flaws

let without_line_end line =
  let rec length n = if n > 0 && line.[n - 1] = '\r' then length (n - 1) else n in
  String.sub line 0 (length (String.length line))

let without_mark line =
  if String.starts_with ~prefix:"\xef\xbb\xbf" line then String.sub line 3 (String.length line - 3) else line

let is_blank line = String.for_all (function ' ' | '\t' | '\r' -> true | _ -> false) line

(* Lines, each as far as `longest_line`; None, if it is longer. *)
let longest_line = 32 * 1024 * 1024

let each_line channel act =
  let chunk = Bytes.create 65536 and line = Buffer.create 65536 and too_long = ref false and some = ref false in
  let add first n =
    some := true;
    if !too_long || Buffer.length line + n > longest_line then (too_long := true; Buffer.reset line)
    else Buffer.add_subbytes line chunk first n
  in
  let finish () =
    act (if !too_long then None else Some (Buffer.contents line));
    Buffer.clear line;
    too_long := false;
    some := false
  in
  let rec lines first last =
    match Bytes.index_from_opt chunk first '\n' with
    | Some i when i < last -> add first (i - first); finish (); lines (i + 1) last
    | _ -> if first < last then add first (last - first)
  in
  let rec read () =
    match input channel chunk 0 (Bytes.length chunk) with
    | 0 -> if !some then finish ()
    | n -> lines 0 n; read ()
  in
  read ()

let read_lines set channel =
  let number = ref 0 in
  each_line channel (fun line ->
      incr number;
      match line with
      | None -> set.flaws <- (2, Printf.sprintf "%s:%d: a line of more than %d bytes" set.file !number longest_line) :: set.flaws
      | Some line ->
          let line = without_line_end line in
          let line = if !number = 1 then without_mark line else line in
          if !number = 1 || not (is_blank line) then read_line set !number line)

let say_count = function Some n -> Z.to_string n | None -> "None"

let check file =
  let set =
    { file; flaws = []; records = 0; errors = 0; scene = None; text = ""; version = None; count = None; tags = Hashtbl.create 16; ids = Hashtbl.create 1024 }
  in
  let channel = if file = "-" then stdin else open_in_bin file in
  read_lines set channel;
  if file <> "-" then close_in channel;
  let is_known = set.version = Some Z.one || set.version = Some (Z.of_int 2) in
  if not is_known || set.count <> Some (Z.of_int set.records) then
    set.flaws <-
      ((if is_known then 1 else 2), Printf.sprintf "%s:1: format %s with %s records, not %d of 1 or 2" file (say_count set.version) (say_count set.count) set.records) :: set.flaws;
  if set.flaws = [] then Printf.printf "%s: %d records, all verified\n" file set.records
  else List.iter (fun (_, what) -> print_endline what) (List.rev set.flaws);
  if set.errors > 0 then Printf.printf "%s: %d of them of the outcome error, which is outside of the proof\n" file set.errors;
  flush stdout;
  List.fold_left (fun status (s, _) -> max status s) 0 set.flaws

let () =
  try
    let files =
      match List.tl (Array.to_list Sys.argv) with
      | "--budget" :: steps :: files -> budget := Z.of_int (int_of_string steps); files
      | files -> files
    in
    if files = [] then failwith "no file";
    exit (List.fold_left (fun status file -> max status (check file)) 0 files)
  with (Sys_error what | Failure what) -> prerr_endline (what ^ "\n" ^ usage); exit 2
