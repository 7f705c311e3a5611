(* What a golden record claims, over the real numbers: docs/formats.md, "Scenes", "Queries" and "Answers".
   This file and the statement of `check_sound` (Main.v) say what is proved. *)
From Coq Require Import ZArith Reals List.
From Flocq Require Import Core.
Import ListNotations.
Local Open Scope R_scope.

(* ---- Numbers: decimal m 10^e, hexadecimal m 2^e; each means the nearest binary64, ties to even. *)
Inductive numeral := Decimal (m e : Z) | Hexadecimal (m e : Z).
Definition radix10 : radix := Build_radix 10 eq_refl.
Definition written (n : numeral) : R :=
  match n with Decimal m e => IZR m * bpow radix10 e | Hexadecimal m e => IZR m * bpow radix2 e end.
Definition nearest64 (x : R) : R := round radix2 (FLT_exp (-1074) 53) ZnearestE x.
Definition value (n : numeral) : R := nearest64 (written n).
Definition finite (n : numeral) : Prop := Rabs (value n) < bpow radix2 1024.

(* ---- Vectors of d coordinates, d = 2 or 3. *)
Definition vec := list R.
Definition point (p : list numeral) : vec := map value p.
Definition norm (a : vec) : R := sqrt (fold_right (fun c sum => c * c + sum) 0 a).
Definition along (p : vec) (c : R) (b : vec) : vec :=  (* p + c b *)
  map (fun q => fst q + c * snd q) (combine p b).
Fixpoint combination (p : vec) (k : list R) (b : list vec) : vec :=  (* p + k_1 b_1 + k_2 b_2 + .. *)
  match k, b with c :: k, e :: b => combination (along p c e) k b | _, _ => p end.

(* ---- Scenes, as they are written. *)
Inductive shape := Radius (r : numeral) | Semiaxes (a : list (list numeral)).
Record atom := Atom { position : list numeral; shape_of : shape }.
Record lattice := Lattice { vectors : list (list numeral); atoms : list atom }.
Record scene := Scene { dimension : nat; lattices : list lattice }.
Record obstacle := Obstacle { of_lattice : Z; of_atom : Z; cell : list Z }.
Record query := Query { start : list numeral; velocity : list numeral; from : option obstacle }.

Definition item {A} (l : list A) (i : Z) : option A := if (i <? 0)%Z then None else nth_error l (Z.to_nat i).
Definition atom_of (sc : scene) (o : obstacle) (L : lattice) (A : atom) : Prop :=
  item (lattices sc) (of_lattice o) = Some L /\ item (atoms L) (of_atom o) = Some A /\
  length (cell o) = length (vectors L).  (* k: in how many directions the lattice repeats *)

(* The point q lies in the obstacle o: obstacles are open. *)
Definition occupied (sc : scene) (o : obstacle) (q : vec) : Prop :=
  exists L A, atom_of sc o L A /\
  let centre := combination (point (position A)) (map IZR (cell o)) (map point (vectors L)) in
  match shape_of A with
  | Radius r => norm (along q (-1) centre) < value r
  | Semiaxes a => exists y, length y = dimension sc /\ norm y < 1 /\ q = combination centre y (map point a)
  end.

(* ---- What is first. `within o t`: at time t the line is in o; all that follows depends on this alone. *)
Section Line.
  Variables (within : obstacle -> R -> Prop) (from : option obstacle).

  (* The chord of o is not empty and begins at t, its infimum; and t >= 0. *)
  Definition enters (o : obstacle) (t : R) : Prop :=
    0 <= t /\ (forall t', within o t' -> t <= t') /\
    (forall later, t < later -> exists t', within o t' /\ t' < later).

  (* Compared number by number: lattice, atom, cell. *)
  Fixpoint less (a b : list Z) : Prop :=
    match a, b with i :: a, j :: b => (i < j)%Z \/ i = j /\ less a b | _, _ => False end.
  Definition name (o : obstacle) : list Z := of_lattice o :: of_atom o :: cell o.
  Definition not_after (o o' : obstacle) : Prop := o = o' \/ less (name o) (name o').

  Definition first_hit (o : obstacle) (t : R) : Prop :=
    from <> Some o /\ enters o t /\
    (forall o', from <> Some o' -> ~ within o' 0) /\
    (forall o' t', from <> Some o' -> enters o' t' -> t < t' \/ t = t' /\ not_after o o').
  Definition first_inside (o : obstacle) : Prop :=
    from <> Some o /\ within o 0 /\ (forall o', from <> Some o' -> within o' 0 -> not_after o o').
  Definition nothing : Prop := forall o, from <> Some o -> ~ within o 0 /\ forall t, ~ enters o t.
End Line.

(* ---- Answers. The time: a number, `None` beyond the largest binary64; m 10^k has 40 significant digits. *)
Inductive answer := Hit (o : obstacle) (time : option numeral) (m k : Z) | Inside (o : obstacle) | Never.
Definition nearest40 (x : R) : R := round radix10 (FLX_exp 40) ZnearestE x.
Definition correct (sc : scene) (q : query) (a : answer) : Prop :=
  let within o t := occupied sc o (along (point (start q)) t (point (velocity q))) in
  match a with
  | Hit o time m k => exists t, first_hit within (from q) o t /\ IZR m * bpow radix10 k = nearest40 t /\
      match time with Some n => finite n /\ value n = nearest64 t
      | None => bpow radix2 1024 <= nearest64 t end
  | Inside o => first_inside within (from q) o
  | Never => nothing within (from q)
  end.

(* ---- Valid questions; others have the answer `error`. *)
Definition zero (d : nat) : vec := repeat 0 d.
Definition sized (d : nat) (a : list numeral) : Prop := length a = d /\ Forall finite a.
Definition independent (d : nat) (b : list (list numeral)) : Prop :=
  (length b <= d)%nat /\ Forall (sized d) b /\
  forall k, length k = length b -> combination (zero d) k (map point b) = zero d -> k = zero (length b).
Definition valid_atom (d : nat) (A : atom) : Prop := sized d (position A) /\
  match shape_of A with Radius r => finite r /\ 0 < value r | Semiaxes a => length a = d /\ independent d a end.
Definition valid_scene (sc : scene) : Prop :=
  (dimension sc = 2 \/ dimension sc = 3)%nat /\ lattices sc <> [] /\
  Forall (fun L => independent (dimension sc) (vectors L) /\ atoms L <> [] /\
    Forall (valid_atom (dimension sc)) (atoms L)) (lattices sc).
Definition valid_query (sc : scene) (q : query) : Prop :=
  sized (dimension sc) (start q) /\ sized (dimension sc) (velocity q) /\
  point (velocity q) <> zero (dimension sc) /\
  forall o, from q = Some o -> exists L A, atom_of sc o L A.
