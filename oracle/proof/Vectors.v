(* Vectors of integers in space. *)
From Coq Require Import ZArith Lia Psatz.
Local Open Scope Z_scope.

Record zv := V { vx : Z; vy : Z; vz : Z }.
Definition dot (a b : zv) := vx a * vx b + vy a * vy b + vz a * vz b.
Definition cross (a b : zv) :=
  V (vy a * vz b - vz a * vy b) (vz a * vx b - vx a * vz b) (vx a * vy b - vy a * vx b).
Definition det (a b c : zv) := dot a (cross b c).
Definition add (w : zv) (k : Z) (b : zv) := V (vx w + k * vx b) (vy w + k * vy b) (vz w + k * vz b).
Definition place (w n a b c : zv) := add (add (add w (vz n) c) (vy n) b) (vx n) a.  (* w + n_1 a + n_2 b +
  n_3 c *)
Definition origin := V 0 0 0.

(* `spread`: the first k of a, b, c are independent. `fits`: the coordinates beyond the first k are 0. *)
Definition spread (k : nat) (a b c : zv) : bool :=
  match k with
  | 0%nat => true
  | 1%nat => negb (dot a a =? 0)
  | 2%nat => let n := cross a b in negb (dot n n =? 0)
  | _ => negb (det a b c =? 0)
  end.
Definition fits (k : nat) (n : zv) : Prop :=
  ((k <= 2)%nat -> vz n = 0) /\ ((k <= 1)%nat -> vy n = 0) /\ ((k <= 0)%nat -> vx n = 0).

Ltac vectors := repeat match goal with a : zv |- _ => destruct a end;
  unfold place, origin, det, dot, cross, add in *; cbn [vx vy vz] in *.

Lemma zv_eq a b : vx a = vx b -> vy a = vy b -> vz a = vz b -> a = b.
Proof. destruct a, b; cbn; intros; subst; reflexivity. Qed.

Lemma square a : 0 <= dot a a.
Proof. unfold dot. nia. Qed.

Lemma cauchy a b : dot a b * dot a b <= dot a a * dot b b.
Proof.
  assert (dot a a * dot b b - dot a b * dot a b = dot (cross a b) (cross a b)) as E by (vectors; ring).
  pose proof (square (cross a b)). lia.
Qed.

Lemma dot_add a w k b : dot a (add w k b) = dot a w + k * dot a b.
Proof. vectors. ring. Qed.

(* docs/certificates.md, "Windows", 2.: "The determinant of each basis is +1 or -1 (without vectors it is 1). So
   every obstacle is w = w_0 + k_1 b_1 + k_2 b_2 + .." *)
Lemma unimodular n a b c : Z.abs (det a b c) = 1 -> exists k, n = place origin k a b c.
Proof.
  intros D.
  exists (V (det a b c * dot n (cross b c)) (det a b c * dot n (cross c a)) (det a b c * dot n (cross a b))).
  assert (D2 : det a b c * det a b c = 1) by nia.
  assert (E : forall t, t = det a b c * det a b c * t) by (intros; rewrite D2; ring).
  destruct n as [n1 n2 n3]. apply zv_eq; unfold place, origin, add; cbn [vx vy vz];
    [rewrite (E n1) at 1|rewrite (E n2) at 1|rewrite (E n3) at 1]; clear; vectors; ring.
Qed.

(* In this basis of the lattice g. *)
Lemma place_place w g1 g2 g3 k a b c : place w (place origin k a b c) g1 g2 g3 =
  place w k (place origin a g1 g2 g3) (place origin b g1 g2 g3) (place origin c g1 g2 g3).
Proof. vectors. f_equal; ring. Qed.

(* A step b along the lattice. *)
Lemma place_step w n m b g1 g2 g3 : place w (add n m b) g1 g2 g3 =
  add (place w n g1 g2 g3) m (place origin b g1 g2 g3).
Proof. vectors. f_equal; ring. Qed.
