(* docs/bounds.md, "Height in a row" and "Position along the line": the home cell's disc as the start sees it. *)
From Coq Require Import ZArith Reals Lra Lia Psatz Bool.
From Flocq Require Import Core Plus_error Mult_error.
From Lorentz Require Import Spec Doubles Euclid Rows Model Certain Roundings Errors.
Local Open Scope R_scope.

Section Start.
  Local Opaque plus minus times over root rounded below at_most floor euclid max_coefficient.
  Variables (v0 v1 d0 d1 : num).
  Notation V0 := (val v0).
  Notation V1 := (val v1).
  Notation D0 := (val d0).
  Notation D1 := (val d1).
  Hypothesis v0_64 : binary64 V0.
  Hypothesis v1_64 : binary64 V1.
  Hypothesis d0_64 : binary64 D0.
  Hypothesis d1_64 : binary64 D1.
  Hypothesis v0_range : 1 <= V0 < 2.
  Hypothesis v1_range : 0 <= V1 <= V0.
  Hypothesis d0_range : Rabs D0 <= / 2.
  Hypothesis d1_range : Rabs D1 <= / 2.
  Hypothesis v1_zero_or : zero_or V1.
  Hypothesis d0_zero_or : zero_or D0.
  Hypothesis d1_zero_or : zero_or D1.
  Variable flipped : bool.
  Notation here := (set_start flipped v0 v1 d0 d1).
  Definition true_y : R := sign_of flipped * (V0 * D1 - V1 * D0).
  Definition true_s : R := V0 * D0 + V1 * D1.
  Definition offset_size : R := Rabs D0 + Rabs D1.
  Notation F := (bpow radix2 (-390)).

  Lemma F_facts : 0 < F <= / 1000000000000000000000000000000 /\ 1000000 * eta <= F.
  Proof using.
    split; [split; [apply bpow_gt_0|]|].
    - apply Rle_trans with (bpow radix2 (-100)); [apply bpow_le; lia|].
      change (bpow radix2 (-100)) with (/ 1267650600228229401496703205376). lra.
    - apply Rle_trans with (bpow radix2 20 * eta).
      + apply Rmult_le_compat_r; [apply Rlt_le, eta_positive|]. change (bpow radix2 20) with 1048576. lra.
      + unfold smallest_half. rewrite <- bpow_plus. apply bpow_le. lia.
  Qed.
  Lemma val_signed a : val (signed flipped a) = sign_of flipped * val a.
  Proof using. unfold signed, sign_of. destruct flipped; rewrite ?val_neg; ring. Qed.
  Lemma abs_signed x : Rabs (sign_of flipped * x) = Rabs x.
  Proof using. unfold sign_of. 
    destruct flipped; [replace (-1 * x) with (- x) by ring; apply Rabs_Ropp|rewrite Rmult_1_l; reflexivity].
  Qed.
  Lemma zero_or_opp x : zero_or x -> zero_or (- x).
  Proof using. intros [->|H]; [left; ring|right; rewrite Rabs_Ropp; exact H]. Qed.

  (* The height of the home cell's disc. *)
  Lemma y_known : Rabs (val (y here) - true_y) <= (1 - 4 * u) * val (y_error here) - F / 2 /\
    0 <= val (y_error here) <= 3 * u /\ binary64 (val (y here)) /\ binary64 (val (y_error here)) /\
    Rabs true_y <= 2 /\ Rabs (val (y here)) <= 2001 / 1000.
  Proof.
    pose proof F_facts as [HF He]. pose proof eta_positive as Hp.
    pose proof (v0_zero_or v0 v0_range) as v0_zero_or.
    unfold set_start. cbv zeta. cbn [y y_error].
    destruct (exact_product D1 V0 d1_64 v0_64 d1_zero_or v0_zero_or) as [Ep Bp].
    assert (nv1_64 : binary64 (- V1)) by (apply generic_format_opp, v1_64).
    destruct (exact_product D0 (- V1) d0_64 nv1_64 d0_zero_or (zero_or_opp _ v1_zero_or)) as [Eq Bq].
    set (p := nearest64 (D1 * V0)) in *. set (q := nearest64 (D0 * - V1)) in *.
    assert (p_64 : binary64 p) by apply round_64. assert (q_64 : binary64 q) by apply round_64.
    pose proof (exact_sum p q p_64 q_64) as Eh. set (h := nearest64 (p + q)) in *.
    assert (h_64 : binary64 h) by apply round_64.
    assert (p'_64 : binary64 (D1 * V0 - p)) by (rewrite <- Ep; apply round_64).
    assert (q'_64 : binary64 (D0 * - V1 - q)) by (rewrite <- Eq; apply round_64).
    assert (h'_64 : binary64 (p + q - h)) by (rewrite <- Eh; apply round_64).
    pose proof (round_sum p q p_64 q_64) as Rh. fold h in Rh.
    pose proof (round_sum _ _ p'_64 q'_64) as Ra. set (a := nearest64 (D1 * V0 - p + (D0 * - V1 - q))) in *.
    assert (a_64 : binary64 a) by apply round_64.
    pose proof (round_sum _ _ h'_64 a_64) as Rb. set (b := nearest64 (p + q - h + a)) in *.
    assert (b_64 : binary64 b) by apply round_64.
    pose proof (round_sum _ _ h_64 b_64) as Rz. set (z := nearest64 (h + b)) in *.
    assert (Ez : val (plus (plus (times d1 v0) (times d0 (neg v1)))
      (plus (rest_of_sum (times d1 v0) (times d0 (neg v1)) (plus (times d1 v0) (times d0 (neg v1))))
        (plus (rest_of_product d1 v0 (times d1 v0)) (rest_of_product d0 (neg v1) (times d0 (neg v1)))))) = z).
    { rewrite !plus_ok, rest_of_sum_ok, !rest_of_product_ok, plus_ok, !times_ok, val_neg.
      fold p q. rewrite Ep, Eq. fold h. rewrite Eh. fold a b z. reflexivity. }
    rewrite val_signed, Ez, !plus_ok, !times_ok, !val_size, val_signed, abs_signed, Ez, plus_ok, !val_size.
    unfold roundoff, anchor_terms, flushed. rewrite !val_power, u_is.
    change (bpow radix2 (-100)) with (/ 1267650600228229401496703205376).
    assert (P1 : Rabs D1 * Rabs V0 <= 2 * Rabs D1).
    { rewrite (Rabs_pos_eq V0) by lra. pose proof (Rabs_pos D1). nra. }
    assert (P0 : Rabs D0 * Rabs (- V1) <= 2 * Rabs D0).
    { rewrite Rabs_Ropp, (Rabs_pos_eq V1) by lra. pose proof (Rabs_pos D0). nra. }
    assert (Q1 : Rabs (D1 * V0) <= Rabs D1 * Rabs V0) by (rewrite Rabs_mult; lra).
    assert (Q0 : Rabs (D0 * - V1) <= Rabs D0 * Rabs (- V1)) by (rewrite Rabs_mult; lra).
    set (x1 := Rabs D1 * Rabs V0) in *. set (x0 := Rabs D0 * Rabs (- V1)) in *.
    assert (size_64 : forall c, binary64 (val c) -> binary64 (Rabs (val c))) by (intros; apply generic_format_abs; auto).
    pose proof (round_size_sum _ _ (size_64 _ d0_64) (size_64 _ d1_64)
      ltac:(pose proof (Rabs_pos D0); pose proof (Rabs_pos D1); lra)) as Rs.
    set (sz := nearest64 (Rabs D0 + Rabs D1)) in *.
    pose proof (Rabs_pos D0) as PD0. pose proof (Rabs_pos D1) as PD1.
    pose proof (Rabs_pos z) as Pz.
    pose proof (round_size (u * Rabs z) ltac:(lra)) as R1. set (e1 := nearest64 (u * Rabs z)) in *.
    pose proof (round_size (/ 1267650600228229401496703205376 * sz) ltac:(lra)) as R2.
    set (e2 := nearest64 (/ 1267650600228229401496703205376 * sz)) in *.
    assert (e1_64 : binary64 e1) by apply round_64. assert (e2_64 : binary64 e2) by apply round_64.
    assert (e1_pos : 0 <= e1) by (apply round_nonneg; lra). assert (e2_pos : 0 <= e2) by (apply round_nonneg; lra).
    pose proof (round_size_sum e1 e2 e1_64 e2_64 ltac:(lra)) as R3. set (e3 := nearest64 (e1 + e2)) in *.
    assert (e3_64 : binary64 e3) by apply round_64.
    assert (F_64 : binary64 F) by (apply generic_format_bpow; unfold FLT_exp; lia).
    pose proof (round_size_sum e3 F e3_64 F_64 ltac:(lra)) as R4. set (e4 := nearest64 (e3 + F)) in *.
    (* sizes, and errors *)
    assert (Tp : Rabs (p + q) <= 2001 / 1000 * (Rabs D0 + Rabs D1)).
    { apply Rle_trans with (1 := Rabs_triang _ _).
      assert (Rabs p <= (1 + u) * x1).
      { replace p with (D1 * V0 + (p - D1 * V0)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
      assert (Rabs q <= (1 + u) * x0).
      { replace q with (D0 * - V1 + (q - D0 * - V1)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
      lra. }
    assert (Th : Rabs (p + q - h) <= u * Rabs (p + q)) by (rewrite Rabs_minus_sym; exact Rh).
    assert (Ta : Rabs (D1 * V0 - p + (D0 * - V1 - q)) <= 2 * u * (Rabs D0 + Rabs D1)).
    { apply Rle_trans with (1 := Rabs_triang _ _). rewrite (Rabs_minus_sym (D1 * V0)), (Rabs_minus_sym (D0 * - V1)).
      lra. }
    assert (Tb : Rabs (p + q - h + a) <= 6 * u * (Rabs D0 + Rabs D1)).
    { apply Rle_trans with (1 := Rabs_triang _ _).
      assert (Rabs a <= 3 * u * (Rabs D0 + Rabs D1)); [|lra].
      replace a with ((D1 * V0 - p + (D0 * - V1 - q)) + (a - (D1 * V0 - p + (D0 * - V1 - q)))) by ring.
      apply Rle_trans with (1 := Rabs_triang _ _). lra. }
    assert (Tz : Rabs (h + b) <= (1 + 2 * u) * Rabs z).
    { assert (Rabs (h + b) <= Rabs z + Rabs (z - (h + b))); [|lra].
      replace (h + b) with (z - (z - (h + b))) at 1 by ring. apply Rle_trans with (1 := Rabs_triang _ _).
      rewrite Rabs_Ropp. lra. }
    assert (Y : Rabs (z - (V0 * D1 - V1 * D0)) <= u * (1 + 2 * u) * Rabs z + 8 * u * u * (Rabs D0 + Rabs D1)).
    { replace (z - (V0 * D1 - V1 * D0)) with ((z - (h + b)) + ((b - (p + q - h + a)) +
        (a - (D1 * V0 - p + (D0 * - V1 - q))))) by ring.
      apply Rle_trans with (1 := Rabs_triang _ _).
      apply Rle_trans with (Rabs (z - (h + b)) + (Rabs (b - (p + q - h + a)) +
        Rabs (a - (D1 * V0 - p + (D0 * - V1 - q))))); [apply Rplus_le_compat_l, Rabs_triang|]. lra. }
    assert (TY : Rabs (V0 * D1 - V1 * D0) <= 2 * (Rabs D0 + Rabs D1)).
    { apply Rle_trans with (Rabs (D1 * V0) + Rabs (D0 * - V1)); [|lra].
      replace (V0 * D1 - V1 * D0) with (D1 * V0 + D0 * - V1) by ring. apply Rabs_triang. }
    assert (Zs : Rabs z <= 20001 / 10000 * (Rabs D0 + Rabs D1)).
    { assert (Rabs z <= Rabs (V0 * D1 - V1 * D0) + Rabs (z - (V0 * D1 - V1 * D0))); [|lra].
      replace z with ((V0 * D1 - V1 * D0) + (z - (V0 * D1 - V1 * D0))) at 1 by ring. apply Rabs_triang. }
    unfold true_y. replace (sign_of flipped * z - sign_of flipped * (V0 * D1 - V1 * D0)) with
      (sign_of flipped * (z - (V0 * D1 - V1 * D0))) by ring.
    rewrite !abs_signed. split; [lra|]. split; [lra|]. split; [|split; [apply round_64|split; lra]].
    destruct flipped; cbn [sign_of];
      [replace (-1 * z) with (- z) by ring; apply generic_format_opp, round_64|rewrite Rmult_1_l; apply round_64].
  Qed.

  (* And its position. *)
  Lemma s_known : Rabs (val (s here) - true_s) <= 40001 / 10000 * u * offset_size /\
    Rabs (val (s here)) <= 20001 / 10000 * offset_size /\ Rabs true_s <= 2 * offset_size /\
    binary64 (val (s here)) /\ binary64 (val (s_error here)) /\
    8 * u * (1 - 3 * u) * offset_size <= val (s_error here) /\ (offset_size = 0 \/ K <= offset_size) /\
    offset_size <= 1 /\ 0 <= val (s_error here).
  Proof.
    pose proof K_small as KS. pose proof eta_positive as Hp.
    pose proof (v0_zero_or v0 v0_range) as v0_zero_or.
    unfold set_start. cbv zeta. cbn [s s_error]. rewrite val_sum_of_products, !times_ok, plus_ok, !val_size.
    unfold eight_roundoffs. rewrite val_power. change (bpow radix2 (-50)) with (8 * / 9007199254740992) || idtac.
    assert (E50 : bpow radix2 (-50) = 8 * u) by (change (bpow radix2 (-50)) with (/ 1125899906842624); lra).
    rewrite ?E50. unfold offset_size, true_s.
    destruct (exact_product V0 D0 v0_64 d0_64 v0_zero_or d0_zero_or) as [_ B0].
    destruct (exact_product V1 D1 v1_64 d1_64 v1_zero_or d1_zero_or) as [_ B1].
    set (p := nearest64 (V0 * D0)) in *. set (q := nearest64 (V1 * D1)) in *.
    assert (p_64 : binary64 p) by apply round_64. assert (q_64 : binary64 q) by apply round_64.
    pose proof (round_sum p q p_64 q_64) as Rs. set (z := nearest64 (p + q)) in *.
    pose proof (Rabs_pos D0) as PD0. pose proof (Rabs_pos D1) as PD1.
    assert (P0 : Rabs V0 * Rabs D0 <= 2 * Rabs D0) by (rewrite (Rabs_pos_eq V0) by lra; nra).
    assert (P1 : Rabs V1 * Rabs D1 <= 2 * Rabs D1) by (rewrite (Rabs_pos_eq V1) by lra; nra).
    assert (Q0 : Rabs (V0 * D0) <= Rabs V0 * Rabs D0) by (rewrite Rabs_mult; lra).
    assert (Q1 : Rabs (V1 * D1) <= Rabs V1 * Rabs D1) by (rewrite Rabs_mult; lra).
    set (x0 := Rabs V0 * Rabs D0) in *. set (x1 := Rabs V1 * Rabs D1) in *.
    assert (size_64 : forall c, binary64 (val c) -> binary64 (Rabs (val c))) by (intros; apply generic_format_abs; auto).
    pose proof (round_size_sum _ _ (size_64 _ d0_64) (size_64 _ d1_64) ltac:(lra)) as Rz.
    set (sz := nearest64 (Rabs D0 + Rabs D1)) in *.
    pose proof (round_size (8 * u * sz) ltac:(lra)) as Re.
    assert (T : Rabs (p + q - (V0 * D0 + V1 * D1)) <= 2 * u * (Rabs D0 + Rabs D1)).
    { replace (p + q - (V0 * D0 + V1 * D1)) with ((p - V0 * D0) + (q - V1 * D1)) by ring.
      apply Rle_trans with (1 := Rabs_triang _ _). lra. }
    assert (TS : Rabs (V0 * D0 + V1 * D1) <= 2 * (Rabs D0 + Rabs D1)).
    { apply Rle_trans with (1 := Rabs_triang _ _). lra. }
    assert (TP : Rabs (p + q) <= (2 + 2 * u) * (Rabs D0 + Rabs D1)).
    { replace (p + q) with ((V0 * D0 + V1 * D1) + (p + q - (V0 * D0 + V1 * D1))) by ring.
      apply Rle_trans with (1 := Rabs_triang _ _). lra. }
    assert (Z : Rabs (z - (V0 * D0 + V1 * D1)) <= 40001 / 10000 * u * (Rabs D0 + Rabs D1)).
    { replace (z - (V0 * D0 + V1 * D1)) with ((z - (p + q)) + (p + q - (V0 * D0 + V1 * D1))) by ring.
      apply Rle_trans with (1 := Rabs_triang _ _). lra. }
    assert (Zs : Rabs z <= 20001 / 10000 * (Rabs D0 + Rabs D1)).
    { replace z with ((V0 * D0 + V1 * D1) + (z - (V0 * D0 + V1 * D1))) by ring.
      apply Rle_trans with (1 := Rabs_triang _ _). lra. }
    assert (SZ : Rabs D0 + Rabs D1 = 0 \/ K <= Rabs D0 + Rabs D1).
    { destruct d0_zero_or as [Z0|Z0]; [|right; lra]. destruct d1_zero_or as [Z1|Z1]; [|right; lra].
      left. rewrite Z0, Z1, Rabs_R0. ring. }
    assert (KE : eta <= u * u * u * K).
    { replace (u * u * u * K) with (bpow radix2 (-53) * bpow radix2 (-53) * bpow radix2 (-53) * K)
        by (rewrite u_is; reflexivity). rewrite <- !bpow_plus. apply eta_below. lia. }
    split; [exact Z|]. split; [exact Zs|]. split; [exact TS|]. split; [apply round_64|].
    split; [apply round_64|]. split; [|split; [exact SZ|split; [lra|apply round_nonneg; lra]]].
    destruct SZ as [SZ|SZ]; [|lra]. rewrite SZ in *. pose proof (round_nonneg (8 * u * sz) ltac:(lra)). lra.
  Qed.
End Start.
