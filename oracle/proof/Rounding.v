(* docs/certificates.md: "`time` is t_X correctly rounded". One test serves binary64 and 40 decimal digits: t
   lies between the midpoints to the neighbours of n base^k, or at one if n is even. Rounding itself is
   Flocq's. *)
From Coq Require Import ZArith Reals Lra Lia Psatz Bool.
From Flocq Require Import Core.
From Lorentz Require Import Spec Time.
Local Open Scope Z_scope.

Section Rounding.
  Variables (base : radix) (digits lowest : Z).  (* numbers n base^k, n < base^digits, k >= lowest *)
  Hypothesis several : 1 < digits.
  Notation b := (radix_val base).
  Notation fexp := (FLT_exp lowest digits).
  Notation format := (generic_format base fexp).

  (* c base^k / (2 base). *)
  Definition fraction (c k : Z) : time := Time (c * b ^ Z.max k 0) 0 (2 * b * b ^ Z.max (- k) 0).
  (* The number below a power of the base is nearer than the one above; below the lowest, it is not. *)
  Definition side (n k : Z) : Z := if (n =? b ^ (digits - 1)) && negb (k =? lowest) then 1 else b.
  Definition rounds (t : time) (n k : Z) : bool :=
    (0 <=? n) && (n <? b ^ digits) && (lowest <=? k) && ((b ^ (digits - 1) <=? n) || (k =? lowest)) &&
    match order t (fraction (2 * b * n - side n k) k) with Lt => false | Eq => Z.even n | Gt => true end &&
    match order t (fraction (2 * b * n + b) k) with Gt => false | Eq => Z.even n | Lt => true end.

  Local Instance positive_digits : Prec_gt_0 digits.
  Proof. unfold Prec_gt_0. lia. Qed.

  Lemma base_ge_2 : 2 <= b.
  Proof. pose proof (radix_prop base) as K. apply Z.leb_le in K. exact K. Qed.
  Lemma IZR_power m : 0 <= m -> IZR (b ^ m) = bpow base m.
  Proof. intros. apply IZR_Zpower; auto. Qed.
  Lemma power_pos m : 0 <= m -> 0 < b ^ m.
  Proof. intros. apply Z.pow_pos_nonneg; pose proof base_ge_2; lia. Qed.

  Lemma fraction_regular c k : regular (fraction c k).
  Proof.
    pose proof base_ge_2. pose proof (power_pos (Z.max (- k) 0) ltac:(lia)).
    split; cbn [fraction td tq]; [lia|]. repeat apply Z.mul_pos_pos; lia.
  Qed.
  Lemma fraction_value c k : time_value (fraction c k) = (IZR c / (2 * IZR b) * bpow base k)%R.
  Proof.
    unfold time_value, fraction; cbn [ts td tq]. rewrite sqrt_0, !mult_IZR, !IZR_power by lia.
    assert (E : bpow base (Z.max k 0) = (bpow base k * bpow base (Z.max (- k) 0))%R) by (rewrite <- bpow_plus;
      f_equal; lia).
    assert (B : (2 <= IZR b)%R) by apply IZR_le, base_ge_2.
    rewrite E. pose proof (bpow_gt_0 base (Z.max (- k) 0)). field. lra.
  Qed.

  Section Candidate.
    Variables (n k : Z).
    Let f := F2R (Float base n k).
    Let u := bpow base k.
    Let sd := IZR (side n k).
    Let B := IZR b.
    Hypothesis nonneg : 0 <= n.
    Hypothesis fits : n < b ^ digits.
    Hypothesis above : lowest <= k.
    Hypothesis full : b ^ (digits - 1) <= n \/ k = lowest.

    Lemma u_pos : (0 < u)%R.
    Proof. apply bpow_gt_0. Qed.
    Lemma B_ge_2 : (2 <= B)%R.
    Proof. apply IZR_le, base_ge_2. Qed.
    Lemma f_eq : f = (IZR n * u)%R.
    Proof. reflexivity. Qed.
    Lemma f_nonneg : (0 <= f)%R.
    Proof. rewrite f_eq. apply Rmult_le_pos; [apply IZR_le; auto|pose proof u_pos; lra]. Qed.
    Lemma sd_range : (0 < sd <= B)%R.
    Proof. unfold sd, side. pose proof B_ge_2. destruct (_ && _); fold B; lra. Qed.

    Lemma canonical_f : n <> 0 -> canonical base fexp (Float base n k).
    Proof.
      intros N0. unfold canonical, cexp; simpl Fexp. rewrite mag_F2R by auto. unfold FLT_exp.
      assert (mag base (IZR n) <= digits).
      { apply mag_le_bpow; [apply not_0_IZR; auto|]. rewrite <- abs_IZR, Z.abs_eq by auto.
        rewrite <- IZR_power by lia. apply IZR_lt; auto. }
      destruct full as [Hf| ->]; [|lia].
      assert (digits <= mag base (IZR n)); [|lia].
      apply mag_ge_bpow. rewrite <- abs_IZR, Z.abs_eq by auto. rewrite <- IZR_power by lia.
      apply IZR_le; auto.
    Qed.
    Lemma zero_or_not : f = 0%R \/ n <> 0.
    Proof. destruct (Z.eq_dec n 0) as [E|]; auto. left. rewrite f_eq, E. lra. Qed.
    Lemma format_f : format f.
    Proof. destruct zero_or_not as [->|]; [apply generic_format_0|apply generic_format_canonical, canonical_f;
      auto]. Qed.

    Lemma above_f g : format g -> (f < g)%R -> (f + u <= g)%R.
    Proof.
      intros Fg Lt. pose proof (succ_le_lt base fexp f g format_f Fg Lt) as S. pose proof f_nonneg as F0.
      rewrite succ_eq_pos in S by auto. pose proof u_pos.
      destruct (Req_dec f 0) as [Z0|Z0].
      - assert (k = lowest) as Ek. { destruct full as [Hf|]; auto. rewrite f_eq in Z0.
        apply Rmult_integral in Z0.
          destruct Z0 as [Z0|Z0]; [apply eq_IZR in Z0; pose proof (power_pos (digits - 1) ltac:(lia));
            lia|lra]. }
        rewrite Z0, (ulp_FLT_0 base lowest digits) in S. rewrite Z0. unfold u. rewrite Ek. auto.
      - assert (N0 : n <> 0) by (destruct zero_or_not; [contradiction|auto]).
        unfold f at 2 in S. rewrite ulp_canonical in S by auto using canonical_f. auto.
    Qed.

    Lemma mag_f : k <> lowest -> mag base f = (k + digits)%Z :> Z.
    Proof.
      intros Nk. destruct full as [Hf|]; [|contradiction]. pose proof u_pos as U.
      apply mag_unique_pos. replace (k + digits - 1) with (digits - 1 + k) by lia.
      rewrite (Z.add_comm k), !bpow_plus.
      rewrite <- (IZR_power (digits - 1)), <- (IZR_power digits) by lia. rewrite f_eq. fold u. split.
      - apply Rmult_le_compat_r; [lra|]. apply IZR_le; auto.
      - apply Rmult_lt_compat_r; [lra|]. apply IZR_lt; auto.
    Qed.

    Lemma below_f g : format g -> (g < f)%R -> (0 < f)%R -> (g <= f - sd / B * u)%R.
    Proof.
      intros Fg Lt F0. pose proof (pred_ge_gt base fexp g f Fg format_f Lt) as S. pose proof u_pos as U.
      pose proof B_ge_2 as B2.
      apply Rle_trans with (1 := S). rewrite pred_eq_pos by lra. unfold pred_pos.
      assert (N0 : n <> 0) by (intros E; rewrite f_eq, E in F0; lra).
      assert (Uf : ulp base fexp f = u) by (apply ulp_canonical; auto using canonical_f).
      assert (S1 : (sd / B <= 1)%R).
      { pose proof sd_range. apply Rmult_le_reg_r with B; [lra|]. unfold Rdiv.
        rewrite Rmult_assoc, Rinv_l; lra. }
      destruct (Z.eq_dec k lowest) as [Ek|Nk].
      - case Req_bool; [|rewrite Uf; nra].
        assert (u <= bpow base (fexp (mag base f - 1)))%R; [|nra].
        unfold u. rewrite Ek. apply bpow_le. unfold FLT_exp. lia.
      - rewrite mag_f by auto. replace (fexp (k + digits - 1)) with (k - 1) by (unfold FLT_exp; lia).
        unfold sd, side. rewrite (proj2 (Z.eqb_neq _ _) Nk).
        replace (k + digits - 1) with (digits - 1 + k) by lia.
        rewrite bpow_plus, <- (IZR_power (digits - 1)) by lia.
        fold u.
        destruct (Z.eqb_spec n (b ^ (digits - 1))) as [E|N]; cbn [andb negb].
        + rewrite Req_bool_true by (rewrite f_eq, E; reflexivity).
          assert (E2 : bpow base (k - 1) = (1 / B * u)%R).
          { unfold u. replace k with (k - 1 + 1) at 2 by lia. rewrite bpow_plus, bpow_1. fold B. field. lra. }
          rewrite E2. lra.
        + rewrite Req_bool_false; [rewrite Uf; fold B; unfold Rdiv; rewrite Rinv_r; lra|].
          intros K. rewrite f_eq in K. apply Rmult_eq_reg_r in K; [|lra]. apply eq_IZR in K. contradiction.
    Qed.

    Variable x : R.
    Hypothesis x_nonneg : (0 <= x)%R.
    Hypothesis x_above : (f - sd / (2 * B) * u < x \/ f - sd / (2 * B) * u = x /\ Z.even n = true)%R.
    Hypothesis x_below : (x < f + u / 2 \/ x = f + u / 2 /\ Z.even n = true)%R.

    Lemma nearest g : format g -> g <> f ->
      (Rabs (f - x) <= Rabs (g - x))%R /\ (Rabs (f - x) = Rabs (g - x) -> Z.even n = true).
    Proof.
      intros Fg Ng. pose proof u_pos as U. pose proof B_ge_2 as B2. pose proof sd_range as S.
      assert (P : (0 < sd / B * u)%R) by (apply Rmult_lt_0_compat; [apply Rdiv_lt_0_compat; lra|lra]).
      assert (E : (sd / (2 * B) * u = (sd / B * u) / 2)%R) by (field; lra).
      destruct (Rdichotomy _ _ Ng) as [Lt|Gt].
      - destruct (Req_dec f 0) as [F0|F0].
        + rewrite F0 in *. rewrite !Rabs_left1 by lra. split; [lra|intros; exfalso; lra].
        + pose proof (below_f g Fg Lt ltac:(pose proof f_nonneg; lra)) as D. rewrite E in x_above. clear E.
          set (y := (sd / B * u)%R) in *.
          unfold Rabs; destruct (Rcase_abs (f - x)), (Rcase_abs (g - x)); destruct x_above as [L|[L Ev]];
            split; intros;
            auto; try lra; exfalso; lra.
      - pose proof (above_f g Fg Gt) as D.
        unfold Rabs; destruct (Rcase_abs (f - x)), (Rcase_abs (g - x)); destruct x_below as [L|[L Ev]]; split;
          intros;
          auto; try lra; exfalso; lra.
    Qed.

    Lemma rounds_to_f : round base fexp ZnearestE x = f.
    Proof.
      assert (N : Rnd_N_pt format x f).
      { split; [apply format_f|]. intros g Fg. destruct (Req_dec g f) as [->|Ng]; [lra|].
        apply nearest; auto. }
      apply (round_unique (Rnd_NE_pt base fexp)) with x.
      - apply Rnd_NE_pt_monotone; [apply FLT_exp_valid, positive_digits|apply exists_NE_FLT; right; lia].
      - apply round_NE_pt; [apply FLT_exp_valid, positive_digits|apply exists_NE_FLT; right; lia].
      - split; auto. case_eq (Z.even n); intros Ev.
        + left. destruct zero_or_not as [F0|]; [|exists (Float base n k); auto using canonical_f].
          exists (Float base 0 (fexp (mag base 0))). rewrite F0, F2R_0.
          split; [auto|split; [apply canonical_0|auto]].
        + right. intros g [Fg Hg]. destruct (Req_dec g f) as [|Ng]; auto. specialize (Hg f format_f).
          destruct (nearest g Fg Ng) as [K1 K2]. specialize (K2 ltac:(lra)). congruence.
    Qed.
  End Candidate.

  Theorem rounds_ok t n k : regular t -> (0 <= time_value t)%R -> rounds t n k = true ->
    round base fexp ZnearestE (time_value t) = F2R (Float base n k).
  Proof.
    intros Ht Hx H. unfold rounds in H. rewrite !andb_true_iff, orb_true_iff, !Z.leb_le, Z.ltb_lt, Z.eqb_eq
      in H.
    destruct H as [[[[[Hn Hn'] Hk] Hc] Hlo] Hup].
    pose proof (order_ok t _ Ht (fraction_regular (2 * b * n - side n k) k)) as O1.
    pose proof (order_ok t _ Ht (fraction_regular (2 * b * n + b) k)) as O2.
    assert (B2 : (2 <= IZR b)%R) by apply B_ge_2.
    assert (V1 : time_value (fraction (2 * b * n - side n k) k) =
      (F2R (Float base n k) - IZR (side n k) / (2 * IZR b) * bpow base k)%R)
      by (rewrite fraction_value, minus_IZR, !mult_IZR; unfold F2R; cbn [Fnum Fexp]; field; lra).
    assert (V2 : time_value (fraction (2 * b * n + b) k) = (F2R (Float base n k) + bpow base k / 2)%R)
      by (rewrite fraction_value, plus_IZR, !mult_IZR; unfold F2R; cbn [Fnum Fexp]; field; lra).
    rewrite V1 in O1. rewrite V2 in O2. apply rounds_to_f; auto.
    - destruct (order t (fraction (2 * b * n - side n k) k)); try discriminate; simpl in O1;
        [right; split; auto|left]; lra.
    - destruct (order t (fraction (2 * b * n + b) k)); try discriminate; simpl in O2;
        [right; split; auto|left]; lra.
  Qed.
End Rounding.

(* ---- `time`, and "inf". *)
Definition rounds64 : time -> Z -> Z -> bool := rounds radix2 53 (-1074).
Lemma rounds64_ok t n k : regular t -> (0 <= time_value t)%R -> rounds64 t n k = true ->
  nearest64 (time_value t) = (IZR n * bpow radix2 k)%R.
Proof. intros. apply (rounds_ok radix2 53 (-1074)); auto. lia. Qed.

Definition beyond (t : time) : bool :=
  match order t (fraction radix2 (4 * 2 ^ 52 - 1) 972) with Lt => false | _ => true end.
Lemma beyond_ok t : regular t -> beyond t = true -> (bpow radix2 1024 <= nearest64 (time_value t))%R.
Proof.
  intros Ht H. set (t0 := fraction radix2 (4 * 2 ^ 52 - 1) 972).
  pose proof (fraction_regular radix2 (4 * 2 ^ 52 - 1) 972) as R0.
  assert (E : nearest64 (time_value t0) = bpow radix2 1024).
  { rewrite rounds64_ok with (n := 2 ^ 52) (k := 972); auto.
    - change (2 ^ 52) with (radix_val radix2 ^ 52). rewrite IZR_power, <- bpow_plus by lia. reflexivity.
    - unfold t0. rewrite fraction_value. apply Rmult_le_pos; [|apply bpow_ge_0].
      apply Rmult_le_pos; [apply IZR_le; lia|apply Rlt_le, Rinv_0_lt_compat; simpl; lra]. }
  rewrite <- E. apply round_le; [apply FLT_exp_valid; reflexivity|apply valid_rnd_N|].
  pose proof (order_ok t t0 Ht R0) as O. unfold beyond in H. fold t0 in H.
  destruct (order t t0); try discriminate; simpl in O; lra.
Qed.

(* ---- `time_decimal`: without a lowest exponent, which is as good as one far below. *)
Definition rounds40 (t : time) (n k : Z) : bool := (10 ^ 39 <=? n) && rounds radix10 40 (k - 2) t n k.
Lemma rounds40_ok t n k : regular t -> (0 <= time_value t)%R -> rounds40 t n k = true ->
  nearest40 (time_value t) = (IZR n * bpow radix10 k)%R.
Proof.
  intros Ht Hx H. unfold rounds40 in H. apply andb_true_iff in H. destruct H as [Hn H]. apply Z.leb_le in Hn.
  pose proof (rounds_ok radix10 40 (k - 2) ltac:(lia) t n k Ht Hx H) as E. set (x := time_value t) in *.
  set (least := bpow radix10 (k - 2 + 40 - 1)).
  assert (F : (least < F2R (Float radix10 n k))%R).
  { apply Rlt_le_trans with (bpow radix10 (39 + k)); [apply bpow_lt; lia|].
    rewrite bpow_plus, <- IZR_power by lia. apply Rmult_le_compat_r; [apply bpow_ge_0|apply IZR_le;
      exact Hn]. }
  unfold nearest40. rewrite <- (round_FLT_FLX radix10 (k - 2) 40); [exact E|].
  rewrite Rabs_pos_eq by auto. apply Rnot_lt_le. fold least. intros L.
  assert (R : (round radix10 (FLT_exp (k - 2) 40) ZnearestE x <= least)%R); [|rewrite E in R; lra].
  apply round_le_generic; [apply FLT_exp_valid; reflexivity|apply valid_rnd_N| |apply Rlt_le; exact L].
  apply generic_format_bpow. unfold FLT_exp. lia.
Qed.
