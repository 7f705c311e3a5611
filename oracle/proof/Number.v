(* docs/formats.md, "Numbers": "It denotes the nearest binary64 (ties to even)". Every binary64 is an integer
   of units of 2^-1074. *)
From Coq Require Import ZArith Reals Lra Lia Bool.
From Flocq Require Import Core.
From Lorentz Require Import Spec Time Rounding.
Local Open Scope Z_scope.

Definition smallest : R := bpow radix2 (-1074).
Arguments smallest : simpl never.  (* 2^1074 is not to be written out *)

(* The number nearest to the fraction a / b > 0. How the candidates are found need not be proved:
   `rounds64` decides. *)
Definition nearest_of (a b : Z) : option Z :=
  let t := Time a 0 b in
  let k := Z.max (-1074) (Z.log2 a - Z.log2 b - 53) in
  let q := Z.shiftl a (Z.max 0 (- k)) / Z.shiftl b (Z.max 0 k) in
  let (q, k) := if q <? 2 ^ 53 then (q, k) else (q / 2, k + 1) in
  let candidate n := let (n, k) := if n =? 2 ^ 53 then (2 ^ 52, k + 1) else (n, k) in
    if rounds64 t n k && (k <=? 971) then Some (Z.shiftl n (k + 1074)) else None in
  match candidate q with None => candidate (q + 1) | found => found end.

(* The number nearest to m base^e, for m > 0 and base >= 2^growth. What is below 2^-1076 is 0; what could
   take long is refused. *)
Definition positive_number (base growth m e : Z) : option Z :=
  if 1100 <? e then None
  else if Z.log2 m + 1 + growth * e <=? -1076 then Some 0
  else nearest_of (m * base ^ Z.max e 0) (base ^ Z.max (- e) 0).
Definition signed_number (base growth m e : Z) : option Z :=
  match m with
  | 0 => Some 0
  | Zpos _ => positive_number base growth m e
  | Zneg _ => option_map Z.opp (positive_number base growth (- m) e)
  end.
Definition number (x : numeral) : option Z :=
  match x with Decimal m e => signed_number 10 3 m e | Hexadecimal m e => signed_number 2 1 m e end.

Lemma nearest_of_ok a b n : 0 < a -> 0 < b -> nearest_of a b = Some n ->
  nearest64 (IZR a / IZR b) = (IZR n * smallest)%R /\ 0 <= n < 2 ^ (1024 + 1074).
Proof.
  intros Ha Hb. unfold nearest_of. cbv zeta. set (t := Time a 0 b).
  assert (V : time_value t = (IZR a / IZR b)%R) by (unfold time_value, t; cbn [ts td tq]; rewrite sqrt_0;
    unfold Rdiv; ring).
  assert (P : (0 <= IZR a / IZR b)%R).
  { apply Rmult_le_pos; [apply IZR_le; lia|]. apply Rlt_le, Rinv_0_lt_compat, IZR_lt. auto. }
  assert (C : forall q k n, (if rounds64 t q k && (k <=? 971) then Some (Z.shiftl q (k + 1074)) else None) =
    Some n ->
    nearest64 (IZR a / IZR b) = (IZR n * smallest)%R /\ 0 <= n < 2 ^ (1024 + 1074)).
  { clear n. intros q k n. destruct (rounds64 t q k) eqn:E; [|discriminate].
    destruct (Z.leb_spec k 971); [|discriminate].
    cbn [andb]. intros I; injection I as <-. rewrite <- V in *.
    rewrite (rounds64_ok t q k); auto; [|split; cbn; lia].
    unfold rounds64, rounds in E. rewrite !andb_true_iff, !Z.leb_le, Z.ltb_lt in E.
    destruct E as [[[[[Hn Hn'] Hk] _] _] _].
    change (radix_val radix2) with 2 in Hn'. rewrite Z.shiftl_mul_pow2 by lia. split.
    - rewrite mult_IZR. change 2 with (radix_val radix2). rewrite IZR_power by lia.
      unfold smallest. rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. lia.
    - assert (0 < 2 ^ (k + 1074)) by (apply Z.pow_pos_nonneg; lia). split; [lia|].
      apply Z.lt_le_trans with (2 ^ 53 * 2 ^ (k + 1074)); [apply Z.mul_lt_mono_pos_r; auto|].
      rewrite <- Z.pow_add_r by lia. apply Z.pow_le_mono_r; lia. }
  generalize (Z.max (-1074) (Z.log2 a - Z.log2 b - 53)). intros k0.
  set (q0 := Z.shiftl a (Z.max 0 (- k0)) / Z.shiftl b (Z.max 0 k0)). clearbody q0.
  destruct (if q0 <? 2 ^ 53 then (q0, k0) else (q0 / 2, k0 + 1)) as [q k]. clear q0 k0.
  destruct (if q =? 2 ^ 53 then (2 ^ 52, k + 1) else (q, k)) as [q1 k1].
  destruct (if rounds64 t q1 k1 && (k1 <=? 971) then _ else None) eqn:E1.
  - intros I. injection I as ->. apply (C q1 k1). exact E1.
  - destruct (if q + 1 =? 2 ^ 53 then (2 ^ 52, k + 1) else (q + 1, k)) as [q2 k2]. apply C.
Qed.

Lemma nearest64_tiny x : (0 <= x <= bpow radix2 (-1076))%R -> nearest64 x = 0%R.
Proof.
  intros [H0 H]. set (t := Time 1 0 (2 ^ 1076)).
  assert (V : time_value t = bpow radix2 (-1076)).
  { unfold time_value, t; cbn [ts td tq]. rewrite sqrt_0. change 2 with (radix_val radix2).
    rewrite IZR_power by lia.
    change (-1076) with (- (1076)). rewrite bpow_opp. unfold Rdiv. ring. }
  assert (E : nearest64 (time_value t) = 0%R).
  { rewrite (rounds64_ok t 0 (-1074)); [lra|split; cbn [td tq t]; [lia|apply Z.pow_pos_nonneg;
      lia]| |vm_compute; reflexivity].
    rewrite V. apply bpow_ge_0. }
  assert (M : forall y z, (y <= z)%R -> (nearest64 y <= nearest64 z)%R)
    by (intros; apply round_le; [apply FLT_exp_valid; reflexivity|apply valid_rnd_N|auto]).
  assert (nearest64 0 = 0)%R by (apply round_0, valid_rnd_N).
  apply M in H0, H. rewrite <- V, E in H. lra.
Qed.

Section Base.
  Variables (base : radix) (growth : Z).
  Hypothesis growth_pos : 0 < growth.
  Hypothesis grows : 2 ^ growth <= radix_val base.

  Lemma power_small e : e <= 0 -> (bpow base e <= bpow radix2 (growth * e))%R.
  Proof.
    intros He. assert (exists p, e = - p /\ 0 <= p) as (p & -> & Hp) by (exists (- e); lia).
    rewrite Z.mul_opp_r, !bpow_opp. apply Rinv_le; [apply bpow_gt_0|]. rewrite <- !IZR_power by nia.
    apply IZR_le.
    rewrite Z.pow_mul_r by lia. apply Z.pow_le_mono_l. split; [|exact grows].
    apply Z.pow_nonneg. discriminate.
  Qed.

  Lemma positive_number_ok m e n : 0 < m -> positive_number (radix_val base) growth m e = Some n ->
    nearest64 (IZR m * bpow base e) = (IZR n * smallest)%R /\ 0 <= n < 2 ^ (1024 + 1074).
  Proof.
    intros Hm. unfold positive_number. destruct (1100 <? e); [discriminate|].
    destruct (Z.leb_spec (Z.log2 m + 1 + growth * e) (-1076)) as [L|_].
    - intros I; injection I as <-. split; [|split; [lia|reflexivity]]. rewrite Rmult_0_l.
      apply nearest64_tiny.
      pose proof (Z.log2_nonneg m) as L0. pose proof (Z.log2_spec m Hm) as [_ L1].
      assert (e <= 0) by nia. split.
      + apply Rmult_le_pos; [apply IZR_le; lia|apply bpow_ge_0].
      + apply Rle_trans with (bpow radix2 (Z.log2 m + 1) * bpow radix2 (growth * e))%R.
        * apply Rmult_le_compat; [apply IZR_le; lia|apply bpow_ge_0| |apply power_small; auto].
          rewrite <- IZR_power by lia. apply IZR_le. apply Z.lt_le_incl. exact L1.
        * rewrite <- bpow_plus. apply bpow_le. exact L.
    - intros E. pose proof (power_pos base (Z.max e 0) ltac:(lia)).
      pose proof (power_pos base (Z.max (- e) 0) ltac:(lia)).
      apply nearest_of_ok in E; [|apply Z.mul_pos_pos; auto|auto].
      replace (IZR m * bpow base e)%R with (IZR (m * radix_val base ^ Z.max e 0) / IZR
        (radix_val base ^ Z.max (- e) 0))%R; [exact E|].
      rewrite mult_IZR, !IZR_power by lia.
      assert (Ee : bpow base (Z.max e 0) = (bpow base e * bpow base (Z.max (- e) 0))%R) by
        (rewrite <- bpow_plus; f_equal; lia).
      rewrite Ee. pose proof (bpow_gt_0 base (Z.max (- e) 0)). field. lra.
  Qed.

  Lemma signed_number_ok m e n : signed_number (radix_val base) growth m e = Some n ->
    nearest64 (IZR m * bpow base e) = (IZR n * smallest)%R /\ Z.abs n < 2 ^ (1024 + 1074).
  Proof.
    unfold signed_number. destruct m as [|p|p]; intros E.
    - injection E as <-. split; [|reflexivity]. rewrite !Rmult_0_l. apply round_0, valid_rnd_N.
    - apply positive_number_ok in E; [|lia]. destruct E as [E B]. split; [exact E|lia].
    - destruct (positive_number (radix_val base) growth (- Zneg p) e) as [n'|] eqn:E'; [|discriminate].
      injection E as <-.
      apply positive_number_ok in E'; [|lia]. destruct E' as [E' B]. split; [|lia].
      replace (IZR (Zneg p) * bpow base e)%R with (- (IZR (- Zneg p) * bpow base e))%R by (rewrite opp_IZR;
        ring).
      unfold nearest64 in *. rewrite round_NE_opp, E', opp_IZR. ring.
  Qed.
End Base.

Theorem number_ok x n : number x = Some n -> value x = (IZR n * smallest)%R /\ finite x.
Proof.
  intros E.
  assert (K : value x = (IZR n * smallest)%R /\ Z.abs n < 2 ^ (1024 + 1074)).
  { destruct x as [m e|m e]; unfold number in E.
    - apply (signed_number_ok radix10 3); [lia|discriminate|exact E].
    - apply (signed_number_ok radix2 1); [lia|discriminate|exact E]. }
  destruct K as [K B]. split; [exact K|]. unfold finite.
  rewrite K, Rabs_mult, (Rabs_pos_eq smallest) by apply bpow_ge_0.
  rewrite <- abs_IZR. apply IZR_lt in B. change 2 with (radix_val radix2) in B. rewrite IZR_power in B by lia.
  apply Rlt_le_trans with (bpow radix2 (1024 + 1074) * smallest)%R.
  - apply Rmult_lt_compat_r; [apply bpow_gt_0|exact B].
  - unfold smallest. rewrite <- bpow_plus. apply bpow_le. lia.
Qed.
