(* docs/certificates.md, "What is claimed", for one obstacle. It is met iff |h|^2 < r^2 v^2. If it is met, the
   ray enters it iff s > 0 and |w| >= r. It contains x iff |w| < r. All three hold because the line is in it when
   (Q t - s)^2 < D = r^2 v^2 - |h|^2, and s^2 + h^2 = Q w^2. *)
From Coq Require Import ZArith Reals Lra Lia Psatz.
From Lorentz Require Import Spec Time.
Local Open Scope R_scope.

Section Quadratic.
  Variables (inside : R -> Prop) (s D Q : Z).
  Hypothesis HQ : (0 < Q)%Z.
  Hypothesis quadratic : forall t, inside t <-> (IZR Q * t - IZR s) * (IZR Q * t - IZR s) < IZR D.
  Notation begins := (time_value (Time s D Q)).
  Notation ends := ((IZR s + sqrt (IZR D)) / IZR Q).

  Lemma chord_interval t : inside t <-> (0 < D)%Z /\ begins < t < ends.
  Proof using HQ quadratic.
    rewrite quadratic. unfold time_value; cbn [ts td tq]. apply IZR_lt in HQ. set (q := IZR Q) in *.
    assert (A : forall y, (y / q < t <-> y < q * t) /\ (t < y / q <-> q * t < y)).
    { intros y. assert (y = q * (y / q)) as Ey by (field; lra). set (z := y / q) in *. rewrite Ey.
      split; split; intros; nra. }
    destruct (A (IZR s - sqrt (IZR D))) as [-> _]. destruct (A (IZR s + sqrt (IZR D))) as [_ ->].
    set (z := q * t) in *. pose proof (sqrt_pos (IZR D)). split.
    - intros K. assert (Dp : 0 < IZR D) by (pose proof (Rle_0_sqr (z - IZR s)); unfold Rsqr in *; lra).
      split; [apply lt_IZR; auto|].
      pose proof (sqrt_sqrt (IZR D) ltac:(lra)). set (r := sqrt (IZR D)) in *. split; nra.
    - intros (Dp & K1 & K2). apply IZR_lt in Dp. pose proof (sqrt_sqrt (IZR D) ltac:(lra)).
      set (r := sqrt (IZR D)) in *. nra.
  Qed.

  Lemma contains_iff : inside 0 <-> (s * s < D)%Z.
  Proof using quadratic.
    rewrite quadratic, Rmult_0_r. split; intros K.
    - apply lt_IZR. rewrite mult_IZR. lra.
    - apply IZR_lt in K. rewrite mult_IZR in K. lra.
  Qed.

  Lemma begins_facts : (0 < D)%Z -> begins < ends /\ (0 <= begins <-> (0 < s)%Z /\ (D <= s * s)%Z).
  Proof using HQ.
    intros Dp. pose proof HQ as HQ'. apply IZR_lt in HQ', Dp.
    pose proof (sqrt_lt_R0 _ Dp) as Sp. pose proof (sqrt_sqrt (IZR D) ltac:(lra)) as S2.
    unfold time_value; cbn [ts td tq]. set (r := sqrt (IZR D)) in *.
    pose proof (Rinv_0_lt_compat _ HQ') as Ip. unfold Rdiv.
    set (i := / IZR Q) in *. split; [nra|]. split.
    - intros K. assert (r <= IZR s) by nra. split; [apply lt_IZR; lra|apply le_IZR; rewrite mult_IZR; nra].
    - intros [K1 K2]. apply IZR_lt in K1. apply IZR_le in K2. rewrite mult_IZR in K2.
      assert (r <= IZR s) by nra. nra.
  Qed.

  (* A point of the chord between its beginning and what is later. *)
  Lemma soon_inside later : (0 < D)%Z -> begins < later -> exists t, inside t /\ t < later.
  Proof using HQ quadratic.
    intros Dp K. destruct (begins_facts Dp) as [G _].
    exists (Rmin ((begins + ends) / 2) ((begins + later) / 2)). split.
    - apply chord_interval. unfold Rmin. destruct Rle_dec; repeat split; auto; lra.
    - unfold Rmin. destruct Rle_dec; lra.
  Qed.

  Lemma enters_iff t :
    (0 <= t /\ (forall t', inside t' -> t <= t') /\ (forall later, t < later -> exists t', inside t' /\
      t' < later)) <->
    (0 < D)%Z /\ t = begins /\ (0 < s)%Z /\ (D <= s * s)%Z.
  Proof using HQ quadratic.
    split.
    - intros (H0 & Hl & Hg). destruct (Hg (t + 1) ltac:(lra)) as (t0 & Ht0 & _).
      pose proof (proj1 (proj1 (chord_interval t0) Ht0)) as Dp. destruct (begins_facts Dp) as [_ G].
      assert (t = begins) as ->; [|tauto].
      apply Rle_antisym; apply Rnot_lt_le; intros K.
      + destruct (soon_inside t Dp K) as (y & Hy & L). specialize (Hl _ Hy). lra.
      + destruct (Hg _ K) as (t1 & Ht1 & L1). apply chord_interval in Ht1. lra.
    - intros (Dp & -> & Hs). destruct (begins_facts Dp) as [_ G]. split; [tauto|]. split.
      + intros t' K. apply chord_interval in K. lra.
      + intros later. apply soon_inside; auto.
  Qed.
End Quadratic.

Lemma begins_nonpos s D Q : (0 < Q)%Z -> (s * s < D)%Z -> time_value (Time s D Q) <= 0.
Proof.
  intros HQ C. assert (Dp : (0 < D)%Z) by nia. unfold time_value; cbn [ts td tq].
  apply IZR_lt in C, Dp, HQ. rewrite mult_IZR in C. pose proof (sqrt_pos (IZR D)) as SP.
  pose proof (sqrt_sqrt (IZR D) (Rlt_le _ _ Dp)) as S2.
  assert (IZR s <= sqrt (IZR D)).
  { apply Rnot_lt_le. intros L. pose proof (Rmult_le_0_lt_compat _ _ _ _ SP SP L L). lra. }
  apply Rmult_le_reg_r with (IZR Q); auto. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra.
Qed.
