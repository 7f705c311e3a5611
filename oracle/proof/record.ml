(* From JSON to what Coq's program takes: numbers as digits and exponents, which it makes binary64s of itself. *)
module Zarith = Z
open Checker
module Z = Zarith  (* Checker has a Z of its own *)

exception Flaw of string

let flaw what = raise (Flaw what)
let require condition what = if not condition then flaw what
let map f l = List.rev (List.rev_map f l)  (* of any length *)

(* Integers, ends of windows, and time_decimal are no longer than that. *)
let longest = 2500
let short what text = require (String.length text <= longest) (Printf.sprintf "%s of more than %d characters" what longest)

(* ---- Numbers. *)
let whole digits = if digits = "" then Z.zero else Z.of_string digits

(* The part of `text` before the first of these characters, and what is behind it. *)
let split_at characters text =
  let rec search i = if i >= String.length text then None else if String.contains characters text.[i] then Some i else search (i + 1) in
  match search 0 with
  | Some i -> (String.sub text 0 i, Some (String.sub text (i + 1) (String.length text - i - 1)))
  | None -> (text, None)

let integer_text text =
  let unsigned = if text <> "" && text.[0] = '-' then String.sub text 1 (String.length text - 1) else text in
  if unsigned <> "" && String.for_all (function '0' .. '9' -> true | _ -> false) unsigned then Some (Z.of_string text) else None

let signed_integer text =
  let positive = text <> "" && text.[0] = '+' in
  let text = if positive then String.sub text 1 (String.length text - 1) else text in
  match integer_text text with Some n when not (positive && text.[0] = '-') -> n | _ -> flaw "no exponent"

(* A number of JSON. *)
let decimal text =
  let mantissa, power = split_at "eE" text in
  let before, after = split_at "." mantissa in
  let after = Option.value after ~default:"" in
  let power = match power with Some p -> signed_integer p | None -> Z.zero in
  (whole (before ^ after), Z.sub power (Z.of_int (String.length after)))

(* [+-]?0[xX]H*[.]?H*([pP][+-]?[0-9]+)? with a digit at least, as m 2^e. *)
let hexadecimal text =
  let bad () = flaw (Printf.sprintf "no number: '%s'" text) in
  let negative = text <> "" && text.[0] = '-' in
  let unsigned = if text <> "" && (negative || text.[0] = '+') then String.sub text 1 (String.length text - 1) else text in
  let n = String.length unsigned in
  if n < 3 || unsigned.[0] <> '0' || (unsigned.[1] <> 'x' && unsigned.[1] <> 'X') then bad ();
  let mantissa, power = split_at "pP" (String.sub unsigned 2 (n - 2)) in
  let before, after = split_at "." mantissa in
  let after = Option.value after ~default:"" in
  let digits = before ^ after in
  if digits = "" || not (String.for_all (function '0' .. '9' | 'a' .. 'f' | 'A' .. 'F' -> true | _ -> false) digits) then bad ();
  let power = match power with Some p -> signed_integer p | None -> Z.zero in
  let m = Z.of_string_base 16 digits in
  ((if negative then Z.neg m else m), Z.sub power (Z.of_int (4 * String.length after)))

let numeral = function
  | Json.Number text -> let m, e = decimal text in Decimal (m, e)
  | Json.String text -> let m, e = hexadecimal text in Hexadecimal (m, e)
  | _ -> flaw "no number"

let number json =
  let n = numeral json in
  match number n with Some _ -> n | None -> flaw "no number: beyond the range of binary64"

(* 27, 27.0, 2.7e1, "27". *)
let integer = function
  | Json.Number text -> (
      if not (String.exists (function '.' | 'e' | 'E' -> true | _ -> false) text) then short "an integer" text;
      match integer_text text with
      | Some n -> n
      | None -> (
          let m, e = decimal text in
          match Checker.number (Decimal (m, e)) with
          | Some n when Z.equal n (Z.shift_left (Z.shift_right n 1074) 1074) && Z.leq (Z.abs n) (Z.shift_left Z.one (53 + 1074)) ->
              Z.shift_right n 1074
          | _ -> flaw ("no integer: " ^ text)))
  | Json.String text -> (
      short "an integer" text;
      match integer_text text with Some n -> n | None -> flaw (Printf.sprintf "no integer: '%s'" text))
  | _ -> flaw "no integer"

(* ---- Scenes and questions. *)
let array size read json =
  let l = Json.list json in
  require (List.compare_length_with l size = 0) (Printf.sprintf "no array of %d items" size);
  List.map read l

let at_most size read json =
  let l = Json.list json in
  require (List.compare_length_with l size <= 0) (Printf.sprintf "no array of %d items at most" size);
  List.map read l

let vector size = array size number

let atom size json =
  let shape =
    match (Json.find "radius" json, Json.find "semiaxes" json) with
    | Some r, None -> Radius (number r)
    | None, Some a -> Semiaxes (array size (vector size) a)
    | _ -> flaw "no volume or shape"
  in
  { position = vector size (Json.get "position" json); shape_of = shape }

let lattice size json =
  { vectors = at_most size (vector size) (Json.get "vectors" json);
    atoms = map (atom size) (Json.list (Json.get "atoms" json)) }

let rec nat n = if n = 0 then O else S (nat (n - 1))

let dimension json =
  match Checker.number (numeral json) with
  | Some n when Z.equal n (Z.shift_left (Z.of_int 2) 1074) -> 2
  | Some n when Z.equal n (Z.shift_left (Z.of_int 3) 1074) -> 3
  | _ -> flaw "the dimension is 2 or 3"

(* The number of dimensions, the scene made ready, and the places of its atoms (lattice, atom). *)
type scene = { size : int; prepared : prepared; places : (int * int, int) Hashtbl.t }

let scene json =
  let size = dimension (Json.get "dimension" json) in
  let lattices = map (lattice size) (Json.list (Json.get "lattices" json)) in
  let places = Hashtbl.create 16 in
  List.iteri (fun l (u : lattice) -> List.iteri (fun a _ -> Hashtbl.add places (l, a) (Hashtbl.length places)) u.atoms) lattices;
  match prepare { dimension = nat size; lattices } with
  | Some prepared -> { size; prepared; places }
  | None -> flaw "an empty scene, or no volume or shape"

let obstacle size json =
  { of_lattice = integer (Json.get "lattice" json);
    of_atom = integer (Json.get "atom" json);
    cell = at_most size integer (Json.get "cell" json) }

let question size json =
  { start = vector size (Json.get "x" json);
    velocity = vector size (Json.get "v" json);
    from = Option.map (obstacle size) (Json.find "from" json) }

(* ---- Answers. *)
let has_sign = function Json.Number t | Json.String t -> t <> "" && t.[0] = '-' | _ -> false

let time = function
  | Json.String "inf" -> None
  | json ->
      let n = number json in
      require (not (has_sign json)) "time is not correctly rounded";
      Some n

(* [0-9]+([.][0-9]+)?(e[+-][0-9]{1,4})?; of 0 only "0". That there are 40 digits is for Checker. *)
let time_decimal text =
  let bad () = flaw "time_decimal is not a number" in
  let digits s = if s = "" || not (String.for_all (function '0' .. '9' -> true | _ -> false) s) then bad () in
  short "time_decimal" text;
  let mantissa, power = split_at "e" text in
  let before, after = split_at "." mantissa in
  digits before;
  Option.iter digits after;
  let after = Option.value after ~default:"" in
  let power =
    match power with
    | None -> Z.zero
    | Some p ->
        let n = String.length p in
        if n < 2 || n > 5 || (p.[0] <> '+' && p.[0] <> '-') then bad ();
        digits (String.sub p 1 (n - 1));
        signed_integer p
  in
  let m = whole (before ^ after) in
  require (text = "0" || Z.sign m > 0) "time_decimal is wrong";
  (m, Z.sub power (Z.of_int (String.length after)))

let answer size outcome json =
  let expect = Json.get "expect" json in
  match outcome with
  | "hit" ->
      let o = obstacle size expect and t = time (Json.get "time" expect) in
      let m, k = time_decimal (Json.text (Json.get "time_decimal" json)) in
      Hit (o, t, m, k)
  | "inside" -> Inside (obstacle size expect)
  | _ -> Never

(* ---- Certificates. Nothing of this need be trusted: whatever they are read as, the claims are checked. *)
let largest_exponent = Z.of_int 16384

let nothing = { mantissa = Z.zero; exponent = Z.zero }
let window_end = function
  | Json.String text ->
      short "a window's end" text;
      let m, e = hexadecimal text in
      require (Z.leq (Z.abs e) largest_exponent) "an exponent beyond 16384";
      { mantissa = m; exponent = e }
  | json -> ( match end_at_number (numeral json) with Some e -> e | None -> flaw "no number: beyond the range of binary64")

let basis size json = at_most size (at_most size integer) (Json.get "basis" json)

let piece size ends place json =
  let to_end = match Json.find "to" json with Some (Json.String "inf") -> None | _ when not ends -> None | _ -> Some (window_end (Json.get "to" json)) in
  { place_in_list = Z.of_int place; from_end = (if ends then window_end (Json.get "from" json) else nothing); to_end; basis = basis size json }

(* The pieces of each atom, in the order in which they are listed. *)
let pieces scene ends list =
  let of_atom = Array.make (Hashtbl.length scene.places) [] in
  let add place json =
    let l = integer (Json.get "lattice" json) and a = integer (Json.get "atom" json) in
    match if Z.fits_int l && Z.fits_int a then Hashtbl.find_opt scene.places (Z.to_int l, Z.to_int a) else None with
    | Some i -> of_atom.(i) <- piece scene.size ends place json :: of_atom.(i)
    | None -> flaw (Printf.sprintf "no atom (%s, %s)" (Z.to_string l) (Z.to_string a))
  in
  List.iteri add list;
  Array.to_list (Array.map List.rev of_atom)

let certificate scene never json =
  let list ends key = match Json.find key json with Some l -> pieces scene ends (Json.list l) | None -> pieces scene ends [] in
  require (Json.has "windows" json || Json.has "rows" json) "a certificate without windows or rows";
  let certificate = { windows = list true "windows"; rows_along = list false "rows" } in
  require (never || List.for_all (( = ) []) certificate.rows_along) "rows prove `never` only";
  certificate
