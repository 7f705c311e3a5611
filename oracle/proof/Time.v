(* docs/certificates.md, "What is claimed": "entered at t = (s - sqrt(r^2 v^2 - |h|^2)) / v^2". Two such times
   are compared without a square root. *)
From Coq Require Import ZArith Reals Lra Lia Psatz.
Local Open Scope Z_scope.

(* The time (s - sqrt D) / Q. *)
Record time := Time { ts : Z; td : Z; tq : Z }.
Definition time_value (t : time) : R := ((IZR (ts t) - sqrt (IZR (td t))) / IZR (tq t))%R.
Definition regular (t : time) : Prop := 0 <= td t /\ 0 < tq t.

(* The sign of a + sqrt b - sqrt c; for a >= 0 it is that of 2 a sqrt b - z. *)
Definition sign_nonneg (a b c : Z) : comparison :=
  let z := c - a * a - b in if z <? 0 then Gt else (4 * a * a * b ?= z * z).
Definition sign (a b c : Z) : comparison :=
  if a <? 0 then CompOpp (sign_nonneg (- a) c b) else sign_nonneg a b c.
Definition order (t u : time) : comparison :=
  sign (ts t * tq u - ts u * tq t) (td u * (tq t * tq t)) (td t * (tq u * tq u)).

Definition agrees (c : comparison) (a b : R) : Prop :=
  match c with Lt => (a < b)%R | Eq => a = b | Gt => (a > b)%R end.

Lemma agrees_opp c a b : agrees c a b -> agrees (CompOpp c) b a.
Proof. destruct c; simpl; intros; lra. Qed.

(* Two numbers of which one is not negative compare as their squares do. *)
Lemma agrees_squares (x y : R) (m n : Z) : (0 <= x)%R -> (0 <= y)%R -> (x * x = IZR m)%R ->
  (y * y = IZR n)%R ->
  agrees (m ?= n) x y.
Proof.
  intros Hx Hy Hm Hn. destruct (Z.compare_spec m n) as [E|L|G]; simpl.
  - subst n. apply Rsqr_inj; unfold Rsqr; lra.
  - apply IZR_lt in L. apply Rsqr_incrst_0; unfold Rsqr; lra.
  - apply IZR_lt in G. apply Rsqr_incrst_0; unfold Rsqr; lra.
Qed.

Lemma sign_nonneg_ok a b c : 0 <= a -> 0 <= b -> 0 <= c ->
  agrees (sign_nonneg a b c) (IZR a + sqrt (IZR b)) (sqrt (IZR c)).
Proof.
  intros Ha Hb Hc. unfold sign_nonneg. cbv zeta. set (z := c - a * a - b).
  assert (Ez : IZR z = (IZR c - IZR a * IZR a - IZR b)%R) by (unfold z; rewrite !minus_IZR, mult_IZR;
    reflexivity).
  apply IZR_le in Ha, Hb, Hc.
  pose proof (sqrt_pos (IZR b)) as HB. pose proof (sqrt_pos (IZR c)) as HC.
  pose proof (sqrt_sqrt _ Hb) as HB2. pose proof (sqrt_sqrt _ Hc) as HC2.
  set (B := sqrt (IZR b)) in *. set (C := sqrt (IZR c)) in *.
  assert (HaB : (0 <= IZR a * B)%R) by (apply Rmult_le_pos; lra).
  destruct (Z.ltb_spec z 0) as [Hz|Hz].
  - apply IZR_lt in Hz. simpl. nra.
  - apply IZR_le in Hz.
    assert (S : (2 * IZR a * B * (2 * IZR a * B) = IZR (4 * a * a * b))%R) by (rewrite !mult_IZR, <- HB2;
      ring).
    assert (K : agrees (4 * a * a * b ?= z * z) (2 * IZR a * B) (IZR z))
      by (apply agrees_squares; [lra|lra|exact S|rewrite mult_IZR; reflexivity]).
    rewrite Ez in K. clear S Ez Hz. destruct (4 * a * a * b ?= z * z); simpl in *.
    + apply Rsqr_inj; unfold Rsqr; nra.
    + apply Rsqr_incrst_0; unfold Rsqr; nra.
    + apply Rsqr_incrst_0; unfold Rsqr; nra.
Qed.

Lemma sign_ok a b c : 0 <= b -> 0 <= c -> agrees (sign a b c) (IZR a + sqrt (IZR b)) (sqrt (IZR c)).
Proof.
  intros Hb Hc. unfold sign. destruct (Z.ltb_spec a 0).
  - apply agrees_opp. assert (Ha : 0 <= - a) by lia. pose proof (sign_nonneg_ok (- a) c b Ha Hc Hb) as K.
    rewrite opp_IZR in K. destruct (sign_nonneg (- a) c b); simpl in *; lra.
  - apply sign_nonneg_ok; lia.
Qed.

Lemma sqrt_scale d q : 0 <= d -> 0 <= q -> (sqrt (IZR (d * (q * q))) = sqrt (IZR d) * IZR q)%R.
Proof.
  intros Hd Hq. apply IZR_le in Hd, Hq. rewrite !mult_IZR, sqrt_mult, sqrt_square; try lra. nra.
Qed.

Theorem order_ok t u : regular t -> regular u -> agrees (order t u) (time_value t) (time_value u).
Proof.
  destruct t as [s d q], u as [s' d' q']; unfold regular, order, time_value; simpl. intros [Hd Hq] [Hd' Hq'].
  pose proof (sign_ok (s * q' - s' * q) (d' * (q * q)) (d * (q' * q'))) as K.
  assert (0 <= d' * (q * q)) by nia. assert (0 <= d * (q' * q')) by nia. specialize (K ltac:(lia) ltac:(lia)).
  rewrite !sqrt_scale, minus_IZR, !mult_IZR in K by lia.
  apply IZR_lt in Hq, Hq'.
  set (S := sqrt (IZR d)) in *. set (S' := sqrt (IZR d')) in *.
  assert (F : ((IZR s - S) / IZR q - (IZR s' - S') / IZR q' =
    (IZR s * IZR q' - IZR s' * IZR q + S' * IZR q - S * IZR q') * (/ IZR q * / IZR q'))%R) by (field; lra).
  assert (G : (0 < / IZR q * / IZR q')%R) by (apply Rmult_lt_0_compat; apply Rinv_0_lt_compat; lra).
  set (g := (/ IZR q * / IZR q')%R) in *. set (x := (IZR s * IZR q' - IZR s' * IZR q + S' * IZR q - S *
    IZR q')%R) in *.
  destruct (sign _ _ _); simpl in *.
  - assert (x = 0)%R as Z0 by (unfold x; lra). rewrite Z0 in F. lra.
  - assert (x < 0)%R as Z0 by (unfold x; lra). nra.
  - assert (x > 0)%R as Z0 by (unfold x; lra). nra.
Qed.
