(* The model of the engine on flights, one a line: x0 x1 v0 v1 r, and the cell of `from`, or "- -". For each what the
   model says and what it computed on the way, to the bit: tests/engines/model/flights.cpp prints the same of the engine. *)
module N = Z  (* Zarith's; the model has a Z of its own *)
open Model

let number_of text =
  let bits = Int64.bits_of_float (float_of_string text) in
  let field = Int64.to_int (Int64.logand (Int64.shift_right_logical bits 52) 2047L) in
  let fraction = Int64.logand bits 0xFFFFFFFFFFFFFL in
  let m = if field = 0 then fraction else Int64.logor fraction 0x10000000000000L in
  let m = N.of_int64 m in
  { fnum = (if Int64.compare bits 0L < 0 then N.neg m else m); fexp = N.of_int (max field 1 - 1075) }

(* "h3/-5" is 3 2^-5: an odd number and an exponent. *)
let text_of a =
  if N.equal a.fnum N.zero then "0"
  else
    let twos = N.trailing_zeros a.fnum in
    Printf.sprintf "%s/%s" (N.to_string (N.shift_right a.fnum twos)) (N.to_string (N.add a.fexp (N.of_int twos)))

let show_arm a = Printf.sprintf " %s %s %s" (N.to_string a.n0) (N.to_string a.n1) (text_of a.height)

(* As fly_outside turns them. *)
let on_the_way x0 x1 v0 v1 r =
  let steep = below (size_of v0) (size_of v1) in
  let there a b = if steep then (b, a) else (a, b) in
  let w0, w1 = there (size_of v0) (size_of v1) in
  let d0, d1 = there (turned (turn_sign v0) (offset_of x0)) (turned (turn_sign v1) (offset_of x1)) in
  match set_direction w0 w1 r with
  | None -> "no direction"
  | Some t ->
    let here = set_start t.is_flipped w0 w1 d0 d1 in
    let numbers =
      [ t.rho; t.s_R; t.s_L; t.inverse_A; t.inverse_S_L; here.y; here.y_error; here.s; here.s_error;
        row_beside_start t here; reach_of_rows t; slope_of_rows t ]
      @ (if t.rises then [ t.inverse_D_L ] else []) in
    show_arm t.arm_R ^ show_arm t.arm_L ^ (if t.is_flipped then " -" else " +")
    ^ String.concat "" (List.map (fun a -> " " ^ text_of a) numbers)
    ^ if are_in_order t then " in order" else " not in order"

let () =
  try
    while true do
      match String.split_on_char ' ' (input_line stdin) with
      | [ x0; x1; v0; v1; r; i; j ] ->
        let x0, x1, v0, v1, r = (number_of x0, number_of x1, number_of v0, number_of v1, number_of r) in
        let from = if i = "-" then None else Some (N.of_string i, N.of_string j) in
        let way = on_the_way x0 x1 v0 v1 r in
        (match fly x0 x1 v0 v1 r from with
         | HitAt (i, j) -> Printf.printf "hit %s %s |%s\n" (N.to_string i) (N.to_string j) way
         | InsideAt (i, j) -> Printf.printf "inside %s %s\n" (N.to_string i) (N.to_string j)
         | NeverHit -> Printf.printf "never |%s\n" way
         | Undecided -> Printf.printf "undecided\n")
      | _ -> failwith "not a flight"
    done
  with End_of_file -> ()
