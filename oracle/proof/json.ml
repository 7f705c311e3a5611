(* JSON (RFC 8259), strictly: UTF-8 without halves of surrogate pairs, nested no deeper than 64 levels, no key twice in an
   object, nothing behind. *)

type t =
  | Null
  | Bool of bool
  | Number of string  (* as it is written *)
  | String of string
  | Array of t list
  | Object of (string * t) list  (* in order *)

exception Bad of string

let bad at what = raise (Bad (Printf.sprintf "%s at byte %d" what at))
let deepest = 64

type reader = { text : string; mutable at : int }

let peek r = if r.at < String.length r.text then r.text.[r.at] else '\000'
let next r = r.at <- r.at + 1
let expect r c = if peek r = c then next r else bad r.at (Printf.sprintf "no %C" c)  (* c is never '\000' *)
let rec space r = match peek r with ' ' | '\t' | '\n' | '\r' -> next r; space r | _ -> ()

let word r w value = String.iter (expect r) w; value

let rec digits r = match peek r with '0' .. '9' -> next r; digits r | _ -> ()
let some_digits r = match peek r with '0' .. '9' -> digits r | _ -> bad r.at "no digit"

let number r =
  let first = r.at in
  if peek r = '-' then next r;
  if peek r = '0' then next r else some_digits r;
  if peek r = '.' then (next r; some_digits r);
  (match peek r with
  | 'e' | 'E' ->
      next r;
      (match peek r with '+' | '-' -> next r | _ -> ());
      some_digits r
  | _ -> ());
  Number (String.sub r.text first (r.at - first))

let hexadecimal_4 r =
  let value = ref 0 in
  for _ = 1 to 4 do
    let digit =
      match peek r with
      | '0' .. '9' as c -> Char.code c - 48
      | 'a' .. 'f' as c -> Char.code c - 87
      | 'A' .. 'F' as c -> Char.code c - 55
      | _ -> bad r.at "no hexadecimal digit"
    in
    value := (16 * !value) + digit;
    next r
  done;
  !value

let is_high code = code land 0xfc00 = 0xd800
let is_low code = code land 0xfc00 = 0xdc00

let unicode_escape r buffer =
  let code = hexadecimal_4 r in
  let code =
    if is_high code then begin
      expect r '\\';
      expect r 'u';
      let low = hexadecimal_4 r in
      if not (is_low low) then bad r.at "half a surrogate";
      0x10000 + ((code land 0x3ff) lsl 10) + (low land 0x3ff)
    end
    else if is_low code then bad r.at "half a surrogate"
    else code
  in
  Buffer.add_utf_8_uchar buffer (Uchar.of_int code)

let escape r buffer =
  let c = peek r in
  next r;
  match c with
  | '"' | '\\' | '/' -> Buffer.add_char buffer c
  | 'b' -> Buffer.add_char buffer '\b'
  | 'f' -> Buffer.add_char buffer '\012'
  | 'n' -> Buffer.add_char buffer '\n'
  | 'r' -> Buffer.add_char buffer '\r'
  | 't' -> Buffer.add_char buffer '\t'
  | 'u' -> unicode_escape r buffer
  | _ -> bad r.at "no such escape"

let string r =
  expect r '"';
  let buffer = Buffer.create 16 in
  let rec rest () =
    if r.at >= String.length r.text then bad r.at "a string without end";
    match peek r with
    | '"' -> next r
    | '\\' -> next r; escape r buffer; rest ()
    | '\000' .. '\031' -> bad r.at "a control character"
    | c -> Buffer.add_char buffer c; next r; rest ()
  in
  rest ();
  Buffer.contents buffer

(* Items between commas, up to `close`. *)
let items r close item =
  next r;
  space r;
  if peek r = close then (next r; [])
  else
    let rec more got =
      let got = item () :: got in
      space r;
      if peek r = ',' then (next r; more got) else (expect r close; List.rev got)
    in
    more []

(* "x" and "\u0078" are one key. *)
let distinct r members =
  let rec differ = function a :: (b :: _ as l) -> if a = b then bad r.at (Printf.sprintf "the key %S comes twice" a) else differ l | _ -> () in
  differ (List.sort String.compare (List.rev_map fst members));
  members

let rec value r depth =
  space r;
  match peek r with
  | '{' | '[' when depth >= deepest -> bad r.at "nested too deep"
  | '{' -> Object (distinct r (items r '}' (fun () -> member r depth)))
  | '[' -> Array (items r ']' (fun () -> value r (depth + 1)))
  | '"' -> String (string r)
  | 't' -> word r "true" (Bool true)
  | 'f' -> word r "false" (Bool false)
  | 'n' -> word r "null" Null
  | _ -> number r

and member r depth =
  space r;
  let key = string r in
  space r;
  expect r ':';
  (key, value r (depth + 1))

(* Sequences of UTF-8 that are the shortest of their kind and no surrogates. *)
let is_utf_8 text =
  let n = String.length text in
  let byte i = if i < n then Char.code text.[i] else 0 in
  let tail i = byte i land 0xc0 = 0x80 in
  let within i low high = byte i >= low && byte i <= high in
  let rec from i =
    i >= n
    ||
    match text.[i] with
    | '\000' .. '\127' -> from (i + 1)
    | '\xc2' .. '\xdf' -> tail (i + 1) && from (i + 2)
    | '\xe0' .. '\xef' as c ->
        within (i + 1) (if c = '\xe0' then 0xa0 else 0x80) (if c = '\xed' then 0x9f else 0xbf)
        && tail (i + 2)
        && from (i + 3)
    | '\xf0' .. '\xf4' as c ->
        within (i + 1) (if c = '\xf0' then 0x90 else 0x80) (if c = '\xf4' then 0x8f else 0xbf)
        && tail (i + 2)
        && tail (i + 3)
        && from (i + 4)
    | _ -> false
  in
  from 0

let parse text =
  if not (is_utf_8 text) then raise (Bad "no UTF-8");
  let r = { text; at = 0 } in
  let box = value r 0 in
  space r;
  if r.at < String.length text then bad r.at "something behind";
  box

(* ---- Members. *)
let members = function Object l -> l | _ -> raise (Bad "no object")
let find key box = List.assoc_opt key (members box)
let get key box = match find key box with Some v -> v | None -> raise (Bad ("no key " ^ key))
let has key box = List.mem_assoc key (members box)
let keys box = List.rev (List.rev_map fst (members box))
let list = function Array l -> l | _ -> raise (Bad "no array")
let text = function String s -> s | _ -> raise (Bad "no string")
