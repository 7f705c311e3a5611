(* The whole check of a record, from what is written. What is said of the certificate alone need not be
   proved: only what the claims need of it is. *)
From Coq Require Import ZArith List Bool.
From Lorentz Require Import Spec Time Rounding Vectors Number Steps Space View Windows Claims Reading.
Import ListNotations.
Local Open Scope Z_scope.

(* ---- A scene, made ready once for all its records. *)
Record placed := Placed { lattice_index : Z; atom_index : Z; its_solid : solid }.
Record prepared := Prepared { flat : bool; count : nat; solids : list placed; bits : Z (* of all numbers *) }.

Definition is_empty {A} (l : list A) : bool := match l with [] => true | _ => false end.
Definition place_atoms (planar : bool) (l : Z * lattice) : option (list placed) :=
  if is_empty (atoms (snd l)) then None
  else all_some (fun a => option_map (Placed (fst l) (fst a)) (read_solid planar (snd l) (snd a)))
    (numbered 0 (atoms (snd l))).
Definition prepare (sc : scene) : option prepared :=
  if ((dimension sc =? 2)%nat || (dimension sc =? 3)%nat) && negb (is_empty (lattices sc)) then
    let planar := (dimension sc =? 2)%nat in
    match all_some (place_atoms planar) (numbered 0 (lattices sc)) with
    | Some placed =>
      let solids := concat placed in
      Some (Prepared planar (dimension sc) solids
        (fold_right (fun p b => fold_right Z.lor b (all_numbers planar (its_solid p))) 0 solids))
    | None => None
    end
  else None.

(* ---- Certificates, as they are written. An end in hexadecimal is not rounded to a binary64. *)
Inductive window_end := AtNumber (n : numeral) | Exactly (m e : Z).  (* m 2^e *)
Record written_piece := WrittenPiece
  { of_lattice_written : Z; of_atom_written : Z; from_end : window_end; to_end : window_end;
    basis : list (list Z) }.
Inductive certificate := Windows (l : list written_piece) | Rows (l : list written_piece).

Definition largest_exponent : Z := 2 ^ 16.
Definition read_end (e : window_end) : option Z :=  (* in units of 2^-1074: rounding only moves it *)
  match e with
  | AtNumber n => number n
  | Exactly m e => if Z.abs e <=? largest_exponent then Some (Z.shiftl m (e + 1074)) else None
  end.
Definition read_row (planar : bool) (r : list Z) : option zv :=
  match planar, r with true, [a; b] => Some (V a b 0) | false, [a; b; c] => Some (V a b c) | _, _ => None end.
Definition read_basis (planar : bool) (rows : list (list Z)) : option (zv * zv * zv) :=
  match planar, all_some (read_row planar) rows with
  | true, Some [a; b] => Some (a, b, V 0 0 1)
  | false, Some [a; b; c] => Some (a, b, c)
  | _, _ => None
  end.
Definition read_piece (planar : bool) (w : Z * written_piece) : option piece :=
  let (i, w) := w in
  match read_end (from_end w), read_end (to_end w), read_basis planar (basis w) with
  | Some b, Some e, Some (r1, r2, r3) => Some (Piece i (of_lattice_written w) (of_atom_written w) b e r1
    r2 r3)
  | _, _, _ => None
  end.

(* Powers of two that numbers have in common go: of those of a question, and of those of the windows' ends. *)
Definition twos (bits : Z) : Z := if bits =? 0 then 0 else Z.log2 (Z.land bits (- bits)).
Definition shrink_ends (k : Z) (w : piece) : piece :=
  Piece (number_of w) (piece_lattice w) (piece_atom w) (Z.shiftr (begin_at w) k) (Z.shiftr (end_at w) k)
    (r1 w) (r2 w) (r3 w).

(* ---- The question. *)
Definition same_atom (o : obstacle) (l a : Z) : bool := (of_lattice o =? l) && (of_atom o =? a).
Definition is_obstacle (p : prepared) (o : obstacle) : bool :=
  existsb (fun s => same_atom o (lattice_index s) (atom_index s)) (solids p) &&
    (length (cell o) =? count p)%nat.
Definition see_all (p : prepared) (k : Z) (x v : zv) : list sight :=
  map (fun s => Sight (lattice_index s) (atom_index s) (see (shrink k x) (shrink k v)
    (shrink_solid (flat p) k (its_solid s))))
    (solids p).
Definition visible (p : prepared) (k : Z) (v : zv) : bool :=
  forallb (fun s => divisible k (all_numbers (flat p) (its_solid s)) &&
    let M := adjugate (shrink_body (flat p) k (shaped (its_solid s))) in let w := apply_to M (shrink k v) in
    negb (radius M =? 0) && (0 <? dot w w)) (solids p).

(* For records of the outcome `error`, which no theorem is about. *)
Definition is_question (p : prepared) (q : query) : bool :=
  match read_vector (flat p) (start q), read_vector (flat p) (velocity q) with
  | Some _, Some v => (0 <? dot v v) && match from q with None => true | Some o => is_obstacle p o end
  | _, _ => false
  end.

(* ---- The answer. *)
Definition read_cell (planar : bool) (n : list Z) : option zv := read_row planar n.
Definition find_sight (sights : list sight) (o : obstacle) : option sight :=
  find (fun s => same_atom o (its_lattice s) (its_atom s)) sights.

(* `time` and `time_decimal`; t = 0 has the one decimal text 0. *)
Definition check_times (t : time) (time : option numeral) (m k : Z) : check :=
  match time with
  | None => require (beyond t) NotRounded
  | Some x =>
    let? n := number x else NoNumber in
    let e := Z.max 0 (Z.log2 n - 52) in
    require (Z.shiftl (Z.shiftr n e) e =? n) NotRounded ;;
    require (rounds64 t (Z.shiftr n e) (e - 1074)) NotRounded
  end ;;
  require (Z.abs k <=? largest_exponent) NoNumber ;;
  require (if ts t * ts t =? td t then m =? 0 else rounds40 t m k) WrongDigits.

Definition check_answer (planar : bool) (E : Z) (sights : list sight) (from : option obstacle)
  (ws : list piece)
    (a : answer) (windows : bool) : check :=
  match a with
  | Hit X time m k =>
    let? s := find_sight sights X else NotTheOutcome in let? n := read_cell planar (cell X) else NoVector in
    require windows NotTheOutcome ;;
    check_hit planar E sights from ws s n ;; check_times (time_of (its_view s) n) time m k
  | Inside X =>
    let? s := find_sight sights X else NotTheOutcome in let? n := read_cell planar (cell X) else NoVector in
    require windows NotTheOutcome ;; check_inside planar E sights from ws s n
  | Never => require (negb windows) NotTheOutcome ;; check_never planar sights ws
  end.

Definition check_record (p : prepared) (q : query) (a : answer) (c : certificate) : check :=
  let? x := read_vector (flat p) (start q) else BadQuery in
  let? v := read_vector (flat p) (velocity q) else BadQuery in
  let bits := fold_right Z.lor (bits p) (numbers_of x ++ numbers_of v) in let k := twos bits in
  require (match from q with None => true | Some o => is_obstacle p o end) BadQuery ;;
  require (0 <? dot v v) BadQuery ;;
  require ((0 <=? k) && divisible k (numbers_of x ++ numbers_of v) && visible p k v) BadScene ;;
  let (windows, written) := match c with Windows l => (true, l) | Rows l => (false, l) end in
  let? ws := all_some (read_piece (flat p)) (numbered 0 written) else NoVector in
  let sights := see_all p k x v in
  each_in ws (fun w => require (existsb (fun s => mine s w) sights)
    (NoAtom (piece_lattice w) (piece_atom w))) ;;
  let e := Z.min 1074 (twos (fold_right (fun w b => Z.lor (begin_at w) (Z.lor (end_at w) b)) 0 ws)) in
  require (e <=? 1074) NoNumber ;;
  check_answer (flat p) (2 ^ (1074 - e)) sights (from q) (map (shrink_ends e) ws) a windows.
