(* The engine `reduction` among discs on the unit square, in its first stage: binary64. Operation by operation it
   is what src/engines/reduction/ does (offset-inl.hpp, direction_2d-inl.hpp, search_2d-inl.hpp, search_2d.hpp), but
   where that goes on in double-double, or among tiny discs from an anchor, the model is undecided. *)
From Coq Require Import ZArith List Bool.
From Flocq Require Import Core.
From Lorentz Require Import Spec Doubles Euclid.
Import ListNotations.
Local Open Scope Z_scope.

(* Constants: bounds.hpp. *)
Definition max_coefficient : Z := 2 ^ 53.
Definition flushed : num := power (-390).              (* kFlushed *)
Definition tiny : num := power (-450).                 (* kTinyComponent *)
Definition anchor_terms : num := power (-100).         (* kAnchorTerms *)
Definition eight_roundoffs : num := power (-50).       (* kHeight u, kAlong u *)
Definition six_roundoffs : num := Float radix2 3 (-52).  (* kRho u, kInside u *)
Definition row_entry : num := power (-49).             (* kRowEntry u *)
Definition roundoff : num := power (-53).
Definition row_slop : num := power (-28).              (* kRowSlop *)
Definition slop : num := power (-30).                  (* kSlop2d *)
Definition more_than_one : num := Float radix2 (2 ^ 30 + 1) (-30).
Definition less_than_one : num := Float radix2 (2 ^ 30 - 1) (-30).
Definition below_half : num := Float radix2 (2 ^ 53 - 1) (-54).  (* kBelowHalf *)
Definition least_width : num := power (-20).           (* kRhoOfAnchor *)
Definition max_unsure : num := power (-2).
Definition smallest_radius : num := power (-16).       (* of the model *)
Definition max_rows : nat := 64.
Definition max_candidates : nat := 16.
Definition max_steps : nat := 200.

(* ---- What does not depend on the start: direction_2d-inl.hpp. *)
Record direction := Direction {
  arm_R : arm; arm_L : arm; is_flipped : bool;
  rho : num; rises : bool;
  S_R : num; S_L : num;
  inverse_A : num; inverse_D_L : num; inverse_S_L : num }.
Notation D_R to := (height (arm_R to)).
Notation D_L to := (height (arm_L to)).

Definition sum_of_products (a0 b0 a1 b1 : num) : num := plus (times a0 b0) (times a1 b1).
Definition along_arm (v0 v1 : num) (a : arm) : num := sum_of_products (whole (n0 a)) v0 (whole (n1 a)) v1.
(* v in the first octant. None: not usable. *)
Definition set_direction (v0 v1 r : num) : option direction :=
  let v2 := sum_of_products v0 v0 v1 v1 in
  let rho := times r (root v2) in
  let passable := times (times (whole 2) rho) less_than_one in
  match euclid max_steps passable (first_R v0) (first_L v1) false with
  | None => None
  | Some (R, L, flipped) =>
    if (n0 L <? max_coefficient) && (n1 L <? max_coefficient) && at_most (whole 0) (height L) then
      let S_L := along_arm v0 v1 L in
      Some (Direction R L flipped rho (below (whole 0) (height L)) (along_arm v0 v1 R) S_L
        (over (whole 1) v2) (over (whole 1) (height L)) (over (whole 1) S_L))
    else None
  end.

(* ---- The rows as a start sees them: search_2d-inl.hpp. *)
Record start_seen := Start { y : num; y_error : num; s : num; s_error : num }.
Definition signed (flipped : bool) (a : num) : num := if flipped then neg a else a.
(* d: the disc of the home cell, as seen from the start. *)
Definition set_start (flipped : bool) (v0 v1 d0 d1 : num) : start_seen :=
  let size := plus (size_of d0) (size_of d1) in
  let p := times d1 v0 in let p' := rest_of_product d1 v0 p in
  let q := times d0 (neg v1) in let q' := rest_of_product d0 (neg v1) q in
  let h := plus p q in let h' := rest_of_sum p q h in
  let y := signed flipped (plus h (plus h' (plus p' q'))) in
  Start y (plus (plus (times roundoff (size_of y)) (times anchor_terms size)) flushed)
    (sum_of_products v0 d0 v1 d1) (times eight_roundoffs size).

Section Rows.
  Variables (to : direction) (here : start_seen).

  Definition row_beside_start : num :=
    times (neg (plus (times (S_L to) (y here)) (times (D_L to) (s here)))) (inverse_A to).
  Definition reach_of_rows : num := plus row_slop (times (times (S_L to) (rho to)) (inverse_A to)).
  Definition slope_of_rows : num := times (D_L to) (inverse_A to).
  Definition are_in_order : bool := below (times (times (whole 2) (rho to)) more_than_one) (D_R to).
  Definition passing_of_row (n : Z) : num :=
    times (neg (plus (s here) (times (whole n) (S_R to)))) (inverse_S_L to).
  (* The m at which row n enters the strip, or passes the start, and what that errs by. *)
  Definition start_of_row (n : Z) : num * num :=
    let nD := times (whole n) (D_R to) in let y_n := plus (y here) nD in
    let passing := passing_of_row n in
    if rises to then
      let m := larger passing (times (minus y_n (rho to)) (inverse_D_L to)) in
      let terms := plus (plus (size_of y_n) (size_of nD)) (rho to) in
      (m, plus slop (times (plus (times row_entry terms) (y_error here)) (inverse_D_L to)))
    else (passing, slop).

  Definition height_in_row (n m : Z) : num :=
    minus (plus (y here) (times (whole n) (D_R to))) (times (whole m) (D_L to)).
  Definition height_error (n m : Z) : num :=
    plus (times eight_roundoffs (plus (plus (size_of (y here)) (size_of (times (whole n) (D_R to))))
      (size_of (times (whole m) (D_L to))))) (y_error here).
  Definition sum_along (n m : Z) : num :=
    plus (plus (s here) (times (whole n) (S_R to))) (times (whole m) (S_L to)).
  Definition along_error (n m : Z) : num :=
    plus (s_error here) (times eight_roundoffs (plus (size_of (times (whole n) (S_R to)))
      (size_of (times (whole m) (S_L to))))).
End Rows.

(* predicates.hpp: is |value| < limit, where value errs by at most error? *)
Inductive decision := Yes | No | Doubtful.
Definition is_below (value limit error : num) : decision :=
  let spread := plus error (times six_roundoffs limit) in
  if below (plus (size_of value) spread) limit then Yes
  else if below limit (minus (size_of value) spread) then No
  else Doubtful.

(* ---- The search: search_2d.hpp. *)
Record found := Found { at_n : Z; at_m : Z; found_s : num; found_error : num }.
Inductive look := Before | Taken (f : found) | Beyond | Unsure.
Definition cell_at (to : direction) (n m : Z) : Z * Z :=
  (n * n0 (arm_R to) + m * n0 (arm_L to), n * n1 (arm_R to) + m * n1 (arm_L to)).
Definition exact_cell (to : direction) (n m : Z) : bool :=
  forallb (fun c => Z.abs c <? max_coefficient)
    [n * n0 (arm_R to); m * n0 (arm_L to); n * n1 (arm_R to); m * n1 (arm_L to);
     fst (cell_at to n m); snd (cell_at to n m)].
Definition is_cell (from : option (Z * Z)) (c : Z * Z) : bool :=
  match from with Some f => (fst f =? fst c) && (snd f =? snd c) | None => false end.

Definition is_after (at_s error : num) (best : option found) : bool :=
  match best with Some f => below (plus (found_s f) (found_error f)) (minus at_s error) | None => false end.
Definition is_before (at_s error : num) (best : option found) : bool :=
  match best with Some f => below (plus at_s error) (minus (found_s f) (found_error f)) | None => true end.

Section Search.
  Variables (to : direction) (here : start_seen) (from : option (Z * Z)).

  Definition look_at (best : option found) (n m : Z) : look :=
    let h := height_in_row to here n m in
    let at_s := sum_along to here n m in let error := along_error to here n m in
    let met := is_below h (rho to) (height_error to here n m) in
    match met with
    | No => if below h (whole 0) || negb (rises to) then Beyond else Before
    | _ =>
      if below at_s (neg error) then Before
      else if is_after at_s error best then Beyond
      else if negb (exact_cell to n m) then Unsure
      else if is_cell from (cell_at to n m) then Before
      else match met with
           | Yes =>
             if below error at_s && is_before at_s error best then Taken (Found n m at_s error) else Unsure
           | _ => Unsure
           end
    end.
  (* The balls of row n from m on; the best so far. None: undecided. *)
  Fixpoint look_from (candidates : nat) (best : option found) (n m : Z) : option (option found) :=
    match candidates with
    | O => None
    | S candidates =>
      match look_at best n m with
      | Before => look_from candidates best n (m + 1)
      | Taken f => Some (Some f)
      | Beyond => Some best
      | Unsure => None
      end
    end.
  Definition look_in_row (best : option found) (n : Z) : option (option found) :=
    let '(m, unsure) := start_of_row to here n in
    if below max_unsure unsure then None
    else look_from max_candidates best n (ceiling (minus m unsure)).
  Definition is_beyond_last (best : option found) (n : Z) : bool :=
    let last := plus (row_beside_start to here) (reach_of_rows to) in
    if rises to then
      match best with
      | Some f => below (plus last (times (found_s f) (slope_of_rows to))) (whole n)
      | None => false
      end
    else below last (whole n).
  Fixpoint look_in_rows (rows : nat) (best : option found) (n : Z) : option (option found) :=
    match rows with
    | O => None
    | S rows =>
      if is_beyond_last best n then Some best
      else match look_in_row best n with
           | None => None
           | Some (Some f) => if are_in_order to then Some (Some f) else look_in_rows rows (Some f) (n + 1)
           | Some None => look_in_rows rows None (n + 1)
           end
    end.
  Definition search : option (option found) :=
    let nu := row_beside_start to here in let reach := reach_of_rows to in
    if below (plus (size_of nu) reach) (whole max_coefficient)
    then look_in_rows max_rows None (ceiling (minus nu reach))
    else None.
End Search.

(* ---- A flight: flight_kernel.hpp, atom_start.hpp, offset-inl.hpp. *)
(* The home cell, whose disc is the only one that x can be in; and where it is. *)
Definition home_of (x : num) : Z := floor (plus x below_half).
Definition offset_of (x : num) : num := minus (whole (home_of x)) x.
Definition is_inside (d0 d1 r : num) : decision :=
  let limit := times r r in let square := sum_of_products d0 d0 d1 d1 in
  let gap := minus limit square in let spread := times six_roundoffs (plus square limit) in
  if below spread gap then Yes else if below gap (neg spread) then No else Doubtful.

(* Zero, or not so small that the engine takes it as zero. *)
Definition not_tiny (a : num) : bool := (Fnum a =? 0) || at_most tiny (size_of a).

Inductive verdict := HitAt (i j : Z) | InsideAt (i j : Z) | NeverHit | Undecided.

Definition turn_sign (a : num) : Z := if Fnum a <? 0 then -1 else 1.
Definition turned (sign : Z) (a : num) : num := if sign <? 0 then neg a else a.
Definition relative (home : Z * Z) (from : option (Z * Z)) : option (Z * Z) :=
  match from with Some f => Some (fst f - fst home, snd f - snd home) | None => None end.
(* From a start in no disc: turned by the symmetry that brings v into the first octant, and back. *)
Definition fly_outside (home : Z * Z) (d0 d1 v0 v1 r : num) (leaving : option (Z * Z)) : verdict :=
  let steep := below (size_of v0) (size_of v1) in
  let sign0 := turn_sign v0 in let sign1 := turn_sign v1 in
  let there {A} (a b : A) : A * A := if steep then (b, a) else (a, b) in
  let w := there (size_of v0) (size_of v1) in
  let d := there (turned sign0 d0) (turned sign1 d1) in
  let leaving_there :=
    match leaving with Some f => Some (there (sign0 * fst f) (sign1 * snd f)) | None => None end in
  match set_direction (fst w) (snd w) r with
  | None => Undecided
  | Some to =>
    match search to (set_start (is_flipped to) (fst w) (snd w) (fst d) (snd d)) leaving_there with
    | None => Undecided
    | Some None => NeverHit
    | Some (Some f) =>
      let N := cell_at to (at_n f) (at_m f) in
      let here := there (fst N) (snd N) in
      HitAt (fst home + sign0 * fst here) (snd home + sign1 * snd here)
    end
  end.
(* The larger component of v is in [1, 2). *)
Definition fly (x0 x1 v0 v1 r : num) (from : option (Z * Z)) : verdict :=
  let d0 := offset_of x0 in let d1 := offset_of x1 in
  let largest := larger (size_of v0) (size_of v1) in
  if below (size_of x0) (power 51) && below (size_of x1) (power 51) &&
     not_tiny v0 && not_tiny v1 && not_tiny d0 && not_tiny d1 &&
     at_most (whole 1) largest && below largest (whole 2) &&
     at_most smallest_radius r && at_most r (power (-1)) then
    let home := (home_of x0, home_of x1) in
    let leaving := relative home from in
    match (if is_cell leaving (0, 0) then No else is_inside d0 d1 r) with
    | Yes => InsideAt (fst home) (snd home)
    | Doubtful => Undecided
    | No => fly_outside home d0 d1 v0 v1 r leaving
    end
  else Undecided.
