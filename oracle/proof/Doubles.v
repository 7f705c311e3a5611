(* The numbers of the model of the engine: m 2^e, which is computed with, and what it means. An operation is the
   real one, rounded as `nearest64` rounds; so a number is a binary64, but for one thing: there is no largest,
   and no infinity. *)
From Coq Require Import ZArith Reals Lra Lia Bool.
From Flocq Require Import Core Bracket Round Operations Div Sqrt.
From Lorentz Require Import Spec.
Local Open Scope Z_scope.

Notation exponent_of := (FLT_exp (-1074) 53).
Notation binary64 := (generic_format radix2 exponent_of).

#[global] Instance digits_53 : Prec_gt_0 53.
Proof. reflexivity. Qed.

Definition num : Set := float radix2.
Definition val (a : num) : R := F2R a.

(* ---- Exact: integers, powers of two, signs, comparisons, and the integers beside a number. *)
Definition whole (n : Z) : num := Float radix2 n 0.
Definition power (e : Z) : num := Float radix2 1 e.
Definition neg (a : num) : num := Float radix2 (- Fnum a) (Fexp a).
Definition size_of (a : num) : num := Float radix2 (Z.abs (Fnum a)) (Fexp a).
Definition below (a b : num) : bool := let '(m, n, _) := Falign a b in m <? n.
Definition at_most (a b : num) : bool := let '(m, n, _) := Falign a b in m <=? n.
Definition floor (a : num) : Z :=
  if 0 <=? Fexp a then Fnum a * 2 ^ Fexp a else Fnum a / 2 ^ (- Fexp a).
Definition ceiling (a : num) : Z := - floor (neg a).
Definition larger (a b : num) : num := if below a b then b else a.

(* ---- Rounded. The size is m 2^e and what the location says; first the digits beyond 53 are cut off. *)
Definition cut (negative : bool) (m e : Z) (l : SpecFloat.location) : num :=
  let '(m, e, l) := truncate radix2 exponent_of (m, e, l) in
  Float radix2 (SpecFloat.cond_Zopp negative (cond_incr (round_N (negb (Z.even m)) l) m)) e.
Definition rounded (a : num) : num := cut (Fnum a <? 0) (Z.abs (Fnum a)) (Fexp a) SpecFloat.loc_Exact.
Definition plus (a b : num) : num := rounded (Fplus a b).
Definition minus (a b : num) : num := rounded (Fplus a (neg b)).
Definition times (a b : num) : num := rounded (Fmult a b).
Definition over (a b : num) : num :=  (* 0 if b is not positive *)
  if (Fnum a =? 0) || (Fnum b <=? 0) then whole 0
  else let '(m, e, l) := Fdiv exponent_of (size_of a) b in cut (Fnum a <? 0) m e l.
Definition root (a : num) : num :=  (* 0 if a is not positive *)
  if Fnum a <=? 0 then whole 0 else let '(m, e, l) := Fsqrt exponent_of a in cut false m e l.
(* a - k b in one rounding, and what a product and a sum leave: a b = p + .., a + b = s + .. *)
Definition remainder (a : num) (k : Z) (b : num) : num := rounded (Fplus a (Fmult (whole (- k)) b)).
Definition rest_of_product (a b p : num) : num := rounded (Fplus (Fmult a b) (neg p)).
Definition rest_of_sum (a b s : num) : num := rounded (Fplus (Fplus a b) (neg s)).

(* ---- What they mean. *)
Local Open Scope R_scope.

Lemma val_whole n : val (whole n) = IZR n.
Proof. unfold val, whole, F2R. cbn. lra. Qed.
Lemma val_power e : val (power e) = bpow radix2 e.
Proof. unfold val, power, F2R. cbn. lra. Qed.
Lemma val_neg a : val (neg a) = - val a.
Proof. unfold val, neg, F2R. cbn. rewrite opp_IZR. lra. Qed.
Lemma val_size a : val (size_of a) = Rabs (val a).
Proof.
  unfold val, size_of, F2R. cbn. rewrite abs_IZR, Rabs_mult, (Rabs_pos_eq (bpow _ _)); auto.
  apply bpow_ge_0.
Qed.

Lemma aligned a b : let '(m, n, e) := Falign a b in val a = IZR m * bpow radix2 e /\
  val b = IZR n * bpow radix2 e.
Proof. pose proof (Falign_spec a b) as K. destruct (Falign a b) as [[m n] e]. exact K. Qed.
Lemma below_ok a b : reflect (val a < val b) (below a b).
Proof.
  unfold below. pose proof (aligned a b) as K. destruct (Falign a b) as [[m n] e]. destruct K as [-> ->].
  pose proof (bpow_gt_0 radix2 e). destruct (m <? n)%Z eqn:L; constructor.
  - apply Z.ltb_lt, IZR_lt in L. apply Rmult_lt_compat_r; auto.
  - apply Z.ltb_ge, IZR_le in L. apply Rle_not_lt, Rmult_le_compat_r; lra.
Qed.
Lemma at_most_ok a b : reflect (val a <= val b) (at_most a b).
Proof.
  unfold at_most. pose proof (aligned a b) as K. destruct (Falign a b) as [[m n] e]. destruct K as [-> ->].
  pose proof (bpow_gt_0 radix2 e). destruct (m <=? n)%Z eqn:L; constructor.
  - apply Z.leb_le, IZR_le in L. apply Rmult_le_compat_r; lra.
  - apply Z.leb_gt, IZR_lt in L. apply Rlt_not_le, Rmult_lt_compat_r; auto.
Qed.
Lemma val_larger a b : val (larger a b) = Rmax (val a) (val b).
Proof. unfold larger, Rmax. destruct (below_ok a b), (Rle_dec (val a) (val b)); lra. Qed.

Lemma floor_ok a : floor a = Zfloor (val a).
Proof.
  unfold floor, val, F2R. destruct (Z.leb_spec 0 (Fexp a)) as [L|L].
  - rewrite <- IZR_Zpower by auto. rewrite <- mult_IZR. symmetry. apply Zfloor_IZR.
  - rewrite <- Zfloor_div by (pose proof (Z.pow_pos_nonneg 2 (- Fexp a)); lia). f_equal. unfold Rdiv.
    f_equal. replace (Fexp a) with (- - Fexp a)%Z at 2 by lia. rewrite bpow_opp, <- IZR_Zpower by lia.
    reflexivity.
Qed.
Lemma ceiling_ok a : ceiling a = Zceil (val a).
Proof. unfold ceiling, Zceil. rewrite floor_ok, val_neg. reflexivity. Qed.


Lemma cut_ok x m e l : inbetween_float radix2 m e (Rabs x) l ->
  (e <= cexp radix2 exponent_of x)%Z \/ l = SpecFloat.loc_Exact -> val (cut (Rlt_bool x 0) m e l) = nearest64 x.
Proof.
  intros I H. unfold nearest64.
  rewrite (round_trunc_sign_any_correct' radix2 exponent_of ZnearestE
    (fun (s : bool) m l => cond_incr (round_N (negb (Z.even m)) l) m) (@inbetween_int_NE_sign) x m e l I H).
  unfold cut, val. destruct (truncate radix2 exponent_of (m, e, l)) as [[m' e'] l']. reflexivity.
Qed.
Lemma negative_ok a : (Fnum a <? 0)%Z = Rlt_bool (val a) 0.
Proof.
  unfold val. symmetry. destruct (Z.ltb_spec (Fnum a) 0) as [L|L].
  - apply Rlt_bool_true, F2R_lt_0, L.
  - apply Rlt_bool_false, F2R_ge_0, L.
Qed.
Lemma rounded_ok a : val (rounded a) = nearest64 (val a).
Proof.
  unfold rounded. rewrite negative_ok. apply cut_ok; [|auto]. rewrite <- val_size. apply inbetween_Exact.
  reflexivity.
Qed.
Lemma plus_ok a b : val (plus a b) = nearest64 (val a + val b).
Proof. unfold plus. rewrite rounded_ok. f_equal. apply F2R_plus. Qed.
Lemma minus_ok a b : val (minus a b) = nearest64 (val a - val b).
Proof. unfold minus. rewrite rounded_ok. f_equal. unfold val. rewrite F2R_plus. fold (val (neg b)).
  rewrite val_neg. reflexivity. Qed.
Lemma times_ok a b : val (times a b) = nearest64 (val a * val b).
Proof. unfold times. rewrite rounded_ok. f_equal. apply F2R_mult. Qed.
Lemma remainder_ok a k b : val (remainder a k b) = nearest64 (val a - IZR k * val b).
Proof.
  unfold remainder. rewrite rounded_ok. f_equal. unfold val. rewrite F2R_plus, F2R_mult.
  fold (val (whole (- k))). rewrite val_whole, opp_IZR. lra.
Qed.
Lemma rest_of_product_ok a b p : val (rest_of_product a b p) = nearest64 (val a * val b - val p).
Proof.
  unfold rest_of_product. rewrite rounded_ok. f_equal. unfold val. rewrite F2R_plus, F2R_mult.
  fold (val (neg p)). rewrite val_neg. reflexivity.
Qed.
Lemma rest_of_sum_ok a b s : val (rest_of_sum a b s) = nearest64 (val a + val b - val s).
Proof.
  unfold rest_of_sum. rewrite rounded_ok. f_equal. unfold val. rewrite !F2R_plus. fold (val (neg s)).
  rewrite val_neg. reflexivity.
Qed.

Lemma nearest64_0 : nearest64 0 = 0.
Proof. apply round_0, valid_rnd_N. Qed.
Lemma positive_val a : (0 < Fnum a)%Z <-> 0 < val a.
Proof.
  split; [apply F2R_gt_0|]. intros K. apply Z.nle_gt. intros L.
  pose proof (F2R_le_0 radix2 a L). unfold val in K. lra.
Qed.
Lemma over_ok a b : 0 < val b -> val (over a b) = nearest64 (val a / val b).
Proof.
  intros B. unfold over. destruct (Z.eqb_spec (Fnum a) 0) as [Z0|N]; cbn [orb].
  - assert (E : val a = 0) by (unfold val, F2R; rewrite Z0; lra). rewrite E, val_whole. unfold Rdiv.
    rewrite Rmult_0_l, nearest64_0. reflexivity.
  - destruct (Z.leb_spec (Fnum b) 0) as [L|L]; [apply positive_val in B; lia|].
    assert (S : 0 < val (size_of a)) by (apply positive_val; cbn; lia).
    pose proof (@Fdiv_correct radix2 exponent_of (size_of a) b S B) as K.
    destruct (Fdiv exponent_of (size_of a) b) as [[m e] l]. destruct K as [K1 K2].
    assert (Q : Rabs (val a / val b) = F2R (size_of a) / F2R b).
    { unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ val b)) by (apply Rlt_le, Rinv_0_lt_compat, B).
      rewrite <- val_size. reflexivity. }
    assert (E : (Fnum a <? 0)%Z = Rlt_bool (val a / val b) 0).
    { rewrite negative_ok. pose proof (Rinv_0_lt_compat _ B) as P. unfold Rdiv. set (i := / val b) in *.
      destruct (Rlt_le_dec (val a) 0) as [D|D].
      - rewrite !Rlt_bool_true; auto; nra.
      - rewrite !Rlt_bool_false; auto; nra. }
    rewrite E. apply cut_ok; [rewrite Q; exact K2|left]. rewrite <- cexp_abs, Q. exact K1.
Qed.
Lemma root_ok a : 0 <= val a -> val (root a) = nearest64 (sqrt (val a)).
Proof.
  intros P. unfold root. destruct (Z.leb_spec (Fnum a) 0) as [L|L].
  - assert (E : val a = 0) by (pose proof (F2R_le_0 radix2 a L); unfold val in *; lra).
    rewrite E, sqrt_0, nearest64_0. apply val_whole.
  - pose proof (proj1 (positive_val a) L) as A. pose proof (@Fsqrt_correct radix2 exponent_of a A) as K.
    destruct (Fsqrt exponent_of a) as [[m e] l]. destruct K as [K1 K2].
    pose proof (sqrt_lt_R0 _ A) as S.
    assert (E : false = Rlt_bool (sqrt (val a)) 0) by (symmetry; apply Rlt_bool_false, Rlt_le, S).
    rewrite E. apply cut_ok; [rewrite Rabs_pos_eq by (apply Rlt_le, S); exact K2|left; exact K1].
Qed.
