(* The whole check of a record, from what is written. *)
From Coq Require Import ZArith List Bool.
From Lorentz Require Import Spec Time Rounding Vectors Number Steps Space View Windows Claims Reading.
Import ListNotations.
Local Open Scope Z_scope.

(* ---- A scene, made ready once for all its records. *)
Record placed := Placed { lattice_index : Z; atom_index : Z; its_solid : solid }.
Record prepared := Prepared { flat : bool; solids : list placed; bits : Z (* of all numbers *) }.

Definition is_empty {A} (l : list A) : bool := match l with [] => true | _ => false end.
Definition place_atoms (planar : bool) (l : Z * lattice) : option (list placed) :=
  if is_empty (atoms (snd l)) then None
  else all_some_long (fun a => option_map (Placed (fst l) (fst a)) (read_solid planar (snd l) (snd a)))
    (numbered_long (atoms (snd l))).
Definition prepare (sc : scene) : option prepared :=
  if ((dimension sc =? 2)%nat || (dimension sc =? 3)%nat) && negb (is_empty (lattices sc)) then
    let planar := (dimension sc =? 2)%nat in
    match all_some_long (place_atoms planar) (numbered_long (lattices sc)) with
    | Some placed =>
      let solids := concat_long placed in
      Some (Prepared planar solids
        (fold_left (fun b p => fold_right Z.lor b (all_numbers planar (its_solid p))) solids 0))
    | None => None
    end
  else None.

(* The windows and the rows of each atom of the scene, in the scene's order. *)
Record certificate := Certificate { windows : list (list written_piece); rows_along : list (list written_piece) }.

(* ---- The question. *)
Definition same_atom (o : obstacle) (l a : Z) : bool := (of_lattice o =? l) && (of_atom o =? a).
Definition is_obstacle (p : prepared) (o : obstacle) : bool :=
  existsb (fun s => same_atom o (lattice_index s) (atom_index s) &&
    (length (cell o) =? rank (its_solid s))%nat) (solids p).
Definition see_all (p : prepared) (k : Z) (x v : zv) : list sight :=
  map_long (fun s => Sight (lattice_index s) (atom_index s) (see (shrink k x) (shrink k v)
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

Definition check_answer (sights : list sight) (from : option obstacle) (a : answer) (c : certificate) : check :=
  match a with
  | Hit X time m k =>
    let? s := find_sight sights X else NotTheOutcome in
    let? n := read_row (sk (its_view s)) (cell X) else NoVector in
    check_hit sights from (windows c) s n ;; check_times (time_of (its_view s) n) time m k
  | Inside X =>
    let? s := find_sight sights X else NotTheOutcome in
    let? n := read_row (sk (its_view s)) (cell X) else NoVector in
    check_inside sights from (windows c) s n
  | Never => check_never sights from (windows c) (rows_along c)
  end.

Definition check_record (p : prepared) (q : query) (a : answer) (c : certificate) : check :=
  let? x := read_vector (flat p) (start q) else BadQuery in
  let? v := read_vector (flat p) (velocity q) else BadQuery in
  let bits := fold_right Z.lor (bits p) (numbers_of x ++ numbers_of v) in let k := twos bits in
  require (match from q with None => true | Some o => is_obstacle p o end) BadQuery ;;
  require (0 <? dot v v) BadQuery ;;
  require ((0 <=? k) && divisible k (numbers_of x ++ numbers_of v) && visible p k v) BadScene ;;
  check_answer (see_all p k x v) (from q) a c.
