(* The theorem: what the model of the engine says among discs on the unit square is right. *)
From Coq Require Import ZArith Reals Lra Lia Psatz List Bool.
From Flocq Require Import Core.
From Lorentz Require Import Spec Doubles Euclid Rows Discs Model Certain Roundings Errors ErrorsStart ErrorsRows.
Import ListNotations.
Local Open Scope R_scope.

(* ---- A search in the first octant. *)
Section Octant.
  Local Opaque plus minus times over root rounded below at_most floor euclid max_coefficient max_rows.
  Variables (v0 v1 d0 d1 r : num).
  Notation V0 := (val v0).
  Notation V1 := (val v1).
  Notation D0 := (val d0).
  Notation D1 := (val d1).
  Hypothesis v0_64 : binary64 V0.
  Hypothesis v1_64 : binary64 V1.
  Hypothesis d0_64 : binary64 D0.
  Hypothesis d1_64 : binary64 D1.
  Hypothesis r_64 : binary64 (val r).
  Hypothesis v0_range : 1 <= V0 < 2.
  Hypothesis v1_range : 0 <= V1 <= V0.
  Hypothesis d0_range : Rabs D0 <= / 2.
  Hypothesis d1_range : Rabs D1 <= / 2.
  Hypothesis v1_zero_or : zero_or V1.
  Hypothesis d0_zero_or : zero_or D0.
  Hypothesis d1_zero_or : zero_or D1.
  Hypothesis r_range : / 65536 <= val r <= / 2.
  Variables (to : direction) (from : option (Z * Z)).
  Hypothesis direction_set : set_direction v0 v1 r = Some to.
  Notation here := (set_start (is_flipped to) v0 v1 d0 d1).

  Definition along_cell (c : Z * Z) : R := V0 * (D0 + IZR (fst c)) + V1 * (D1 + IZR (snd c)).
  Definition across_cell (c : Z * Z) : R := V0 * (D1 + IZR (snd c)) - V1 * (D0 + IZR (fst c)).
  Definition in_the_way (c : Z * Z) : Prop := is_cell from c = false /\
    across_cell c * across_cell c < val r * val r * (V0 * V0 + V1 * V1) /\ 0 < along_cell c.

  Lemma position_of_cell n m : position_at (SR v0 v1 to) (SL v0 v1 to) (true_s v0 v1 d0 d1) n m =
    along_cell (cell_at to n m).
  Proof.
    unfold position_at, SR, SL, along_of, true_s, along_cell, cell_at. cbn [fst snd].
    rewrite !plus_IZR, !mult_IZR. ring.
  Qed.
  Lemma height_of_cell n m : height_at (val (D_R to)) (val (D_L to)) (true_y v0 v1 d0 d1 (is_flipped to)) n m =
    sign_of (is_flipped to) * across_cell (cell_at to n m).
  Proof.
    pose proof (all_facts v0 v1 r v0_64 v1_64 v0_range v1_range v1_zero_or r_range to direction_set) as A.
    destruct (heights_are _ _ _ _ A) as (ER & EL & _). unfold height_at. rewrite ER, EL.
    unfold true_y, across_of, across_cell, cell_at. cbn [fst snd]. rewrite !plus_IZR, !mult_IZR. ring.
  Qed.
  Lemma met_or_not c h : Rabs h = Rabs (across_cell c) -> Rabs h < Rho v0 v1 r <->
    across_cell c * across_cell c < val r * val r * (V0 * V0 + V1 * V1).
  Proof.
    intros E. rewrite E. pose proof (speed_range v0 v1 v0_range v1_range) as HS.
    pose proof (V2_range v0 v1 v0_range v1_range) as HV. unfold Rho, V2 in *. set (w := V0 * V0 + V1 * V1) in *.
    pose proof (sqrt_sqrt w ltac:(lra)) as W. set (q := sqrt w) in *. rewrite <- W.
    set (a := Rabs (across_cell c)). assert (Ea : across_cell c * across_cell c = a * a).
    { unfold a. destruct (Rle_lt_dec 0 (across_cell c)); [rewrite Rabs_pos_eq by assumption|
        rewrite Rabs_left by assumption]; ring. }
    rewrite Ea. pose proof (Rabs_pos (across_cell c)). fold a in H.
    replace (val r * val r * (q * q)) with ((val r * q) * (val r * q)) by ring.
    assert (0 < val r * q) by (apply Rmult_lt_0_compat; lra). set (p := val r * q) in *. split; intros; nra.
  Qed.
  Lemma candidate_is n m : candidate to from (SR v0 v1 to) (SL v0 v1 to)
    (true_y v0 v1 d0 d1 (is_flipped to)) (true_s v0 v1 d0 d1) (Rho v0 v1 r) n m <-> in_the_way (cell_at to n m).
  Proof.
    unfold candidate, ahead, in_the_way, in_strip. rewrite position_of_cell, height_of_cell.
    rewrite (met_or_not (cell_at to n m)) by apply abs_signed. tauto.
  Qed.
  Lemma cell_reached c : exists n m, c = cell_at to n m.
  Proof.
    pose proof (all_facts v0 v1 r v0_64 v1_64 v0_range v1_range v1_zero_or r_range to direction_set) as A.
    destruct c as [i j]. destruct (basis_reaches V0 V1 _ _ _ i j (heights_are _ _ _ _ A)) as (n & m & E0 & E1).
    exists n, m. unfold cell_at. rewrite <- E0, <- E1. reflexivity.
  Qed.

  Theorem search_in_octant b : search to here from = Some b ->
    match b with
    | Some f => let c := cell_at to (at_n f) (at_m f) in in_the_way c /\
        forall c', in_the_way c' -> c' = c \/ along_cell c < along_cell c'
    | None => forall c, ~ in_the_way c
    end.
  Proof.
    intros E. pose proof (all_facts v0 v1 r v0_64 v1_64 v0_range v1_range v1_zero_or r_range to direction_set) as A.
    pose proof (DR_range _ _ _ _ A) as RD. pose proof (SR_range _ _ _ _ A) as RS.
    pose proof (SL_range _ _ _ _ A) as RL. pose proof (DL_range _ _ _ _ A) as RDL.
    destruct (rho_range v0 v1 r v0_64 v1_64 v0_range v1_range v1_zero_or r_range to direction_set) as (_ & _ & RR).
    pose proof (search_certain to here from (SR v0 v1 to) (SL v0 v1 to) (true_y v0 v1 d0 d1 (is_flipped to))
      (true_s v0 v1 d0 d1) (Rho v0 v1 r) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)
      (rises_is _ _ _ _ A)) as C.
    assert (C' := C ltac:(apply (strip_holds v0 v1 d0 d1 r); assumption)
      ltac:(apply (positions_hold v0 v1 d0 d1 r); assumption)
      ltac:(apply (first_row_holds v0 v1 d0 d1 r); assumption)
      ltac:(apply (last_row_holds v0 v1 d0 d1 r); assumption)
      ltac:(apply (starts_hold v0 v1 d0 d1 r); assumption)
      ltac:(apply (order_holds v0 v1 r); assumption) b E). clear C.
    destruct b as [f|].
    - destruct C' as ((Met & _ & _) & _ & First). cbv zeta. split; [apply candidate_is, Met|].
      intros c' Hc. destruct (cell_reached c') as (n & m & ->). apply candidate_is in Hc.
      destruct (First n m I Hc) as [K|K]; [injection K as -> ->; left; reflexivity|right].
      rewrite !position_of_cell in K. exact K.
    - intros c Hc. destruct (cell_reached c) as (n & m & ->). apply candidate_is in Hc. exact (C' n m I Hc).
  Qed.
End Octant.

(* ---- The home cell. *)
Lemma below_half_is : val below_half = / 2 - / 18014398509481984.
Proof.
  unfold val, below_half, F2R. cbn [Fnum Fexp]. change (bpow radix2 (-54)) with (/ 18014398509481984).
  change (IZR (2 ^ 53 - 1)) with 9007199254740991. lra.
Qed.
Lemma small_integer_64 n : Rabs (IZR n) <= 9007199254740992 -> binary64 (IZR n).
Proof.
  intros H. apply (integer_64 n). rewrite <- abs_IZR in H. apply (le_IZR _ 9007199254740992) in H. exact H.
Qed.
Lemma grid_of a : binary64 a -> / 2 <= Rabs a < 2251799813685248 -> exists (i k : Z), (0 <= k <= 51)%Z /\
  a = IZR i * bpow radix2 (k - 53) /\ (Z.abs i < 2 ^ 53)%Z.
Proof.
  intros B [L U]. set (e := cexp radix2 exponent_of a).
  assert (M1 : (0 <= mag radix2 a)%Z) by (apply mag_ge_bpow; exact L).
  assert (M2 : (mag radix2 a <= 51)%Z).
  { apply mag_le_bpow; [intros ->; rewrite Rabs_R0 in L; lra|]. exact U. }
  assert (Ee : e = (mag radix2 a - 53)%Z) by (unfold e, cexp, FLT_exp; lia).
  exists (Ztrunc (scaled_mantissa radix2 exponent_of a)), (mag radix2 a). split; [lia|].
  assert (E : a = IZR (Ztrunc (scaled_mantissa radix2 exponent_of a)) * bpow radix2 (mag radix2 a - 53)).
  { rewrite <- Ee. exact B. }
  split; [exact E|]. apply lt_IZR. rewrite abs_IZR. apply Rmult_lt_reg_r with (bpow radix2 (mag radix2 a - 53));
    [apply bpow_gt_0|].
  change (IZR (2 ^ 53)) with (bpow radix2 53). rewrite <- bpow_plus. replace (53 + (mag radix2 a - 53))%Z with
    (mag radix2 a : Z) by lia.
  rewrite <- (Rabs_pos_eq (bpow radix2 (mag radix2 a - 53))) by apply bpow_ge_0. rewrite <- Rabs_mult, <- E.
  apply bpow_mag_gt.
Qed.
Lemma below_one_half a : binary64 a -> a < / 2 -> a <= / 2 - / 18014398509481984.
Proof.
  intros B H. apply Rnot_lt_le. intros K.
  assert (M : mag radix2 a = (-1)%Z :> Z).
  { apply mag_unique_pos. change (bpow radix2 (-1 - 1)) with (/ 4). change (bpow radix2 (-1)) with (/ 2). lra. }
  assert (E : a = IZR (Ztrunc (scaled_mantissa radix2 exponent_of a)) * bpow radix2 (-54)).
  { replace (-54)%Z with (cexp radix2 exponent_of a) by (unfold cexp, FLT_exp; rewrite M; reflexivity). exact B. }
  change (bpow radix2 (-54)) with (/ 18014398509481984) in E. set (m := Ztrunc _) in *.
  assert (9007199254740991 < IZR m < 9007199254740992) as [L U] by lra. apply lt_IZR in L, U. lia.
Qed.
Theorem home_ok x : binary64 (val x) -> Rabs (val x) < 2251799813685248 ->
  val (offset_of x) = IZR (home_of x) - val x /\ Rabs (IZR (home_of x) - val x) <= / 2 /\
  binary64 (val (offset_of x)).
Proof.
  intros B U. assert (K : binary64 (IZR (home_of x) - val x) /\ Rabs (IZR (home_of x) - val x) <= / 2).
  2: { destruct K as [K1 K2]. unfold offset_of. rewrite minus_ok, val_whole.
       split; [apply rounded_is, K1|]. split; [exact K2|apply round_64]. }
  unfold home_of. rewrite floor_ok, plus_ok, below_half_is. set (a := val x) in *.
  set (c := / 2 - / 18014398509481984). set (t := nearest64 (a + c)).
  destruct (Rlt_le_dec (Rabs a) (/ 2)) as [S|L].
  - (* near 0 *)
    apply Rabs_def2 in S. destruct S as [S1 S2].
    pose proof (below_one_half a B S1) as A1.
    pose proof (below_one_half (- a) (generic_format_opp _ _ _ B) ltac:(lra)) as A2. fold c in A1, A2.
    assert (T0 : 0 <= t) by (apply round_nonneg; lra).
    assert (T1 : t <= 1 - / 9007199254740992).
    { apply round_below; [|unfold c in *; lra].
      replace (1 - / 9007199254740992) with (IZR (2 ^ 53 - 1) * bpow radix2 (-53))
        by (rewrite u_is; change (IZR (2 ^ 53 - 1)) with 9007199254740991; lra).
      apply on_grid; lia. }
    assert (Z0 : Zfloor t = 0%Z) by (apply Zfloor_imp; cbn [Z.add]; lra). rewrite Z0. split.
    + replace (0 - a) with (- a) by ring. apply generic_format_opp, B.
    + apply Rabs_le. unfold c in *. lra.
  - destruct (grid_of a B (conj L U)) as (i & k & Hk & Ea & Hi). set (g := bpow radix2 (k - 53)) in *.
    assert (Pg : / 9007199254740992 <= g <= / 4).
    { unfold g. split; [rewrite <- u_is; apply bpow_le; lia|apply (bpow_le radix2 _ (-2)); lia]. }
    (* integers, and halves, are on the grid *)
    assert (G1 : IZR (2 ^ (53 - k)) * g = 1).
    { change 2%Z with (radix_val radix2). rewrite IZR_Zpower by lia. unfold g. rewrite <- bpow_plus.
      replace (53 - k + (k - 53))%Z with 0%Z by lia. reflexivity. }
    assert (G2 : IZR (2 ^ (52 - k)) * g = / 2).
    { change 2%Z with (radix_val radix2). rewrite IZR_Zpower by lia. unfold g. rewrite <- bpow_plus.
      replace (52 - k + (k - 53))%Z with (-1)%Z by lia. reflexivity. }
    assert (G3 : IZR (2 ^ 53) * g = IZR (2 ^ k)).
    { change 2%Z with (radix_val radix2). rewrite !IZR_Zpower by lia. unfold g. rewrite <- bpow_plus. f_equal. lia. }
    set (one := (2 ^ (53 - k))%Z) in *. set (half := (2 ^ (52 - k))%Z) in *.
    assert (Step : forall j : Z, 0 < IZR j * g -> g <= IZR j * g).
    { intros j H. assert (1 <= IZR j); [|nra]. apply (IZR_le 1). assert (0 < IZR j) by nra. apply lt_IZR in H0. lia. }
    assert (Ai : Rabs a <= 9007199254740991 * g).
    { rewrite Ea, Rabs_mult, (Rabs_pos_eq g) by lra. apply Rmult_le_compat_r; [lra|]. rewrite <- abs_IZR.
      apply (IZR_le _ 9007199254740991). lia. }
    assert (c_64 : binary64 c).
    { unfold c. rewrite <- below_half_is. unfold below_half, val, F2R. cbn [Fnum Fexp]. apply on_grid; lia. }
    pose proof (round_sum a c B c_64) as Rt. fold t in Rt.
    assert (Tc : Rabs (a + c) <= Rabs a + / 2).
    { apply Rle_trans with (1 := Rabs_triang _ _). rewrite (Rabs_pos_eq c) by (unfold c; lra). unfold c. lra. }
    apply Rabs_le_inv in Rt. set (h := Zfloor t). pose proof (Zfloor_lb t) as F1. pose proof (Zfloor_ub t) as F2.
    fold h in F1, F2.
    assert (Ta : t <= a + 1 /\ a <= t) by (unfold c in *; lra).
    pose proof (Rabs_le_inv a _ Ai) as Ai'.
    assert (Up : IZR h <= a + / 2).
    { apply Rnot_lt_le. intros K.
      assert (K2 : g <= IZR (h * one - half - i) * g).
      { apply Step. rewrite !minus_IZR, mult_IZR, !Rmult_minus_distr_r, G2, <- Ea, Rmult_assoc, G1. lra. }
      rewrite !minus_IZR, mult_IZR, !Rmult_minus_distr_r, G2, <- Ea, Rmult_assoc, G1 in K2.
      assert (N : t <= IZR (h * one - 1) * g).
      { apply round_below.
        - apply on_grid; [lia|].
          assert (Hk1 : (h <= 2 ^ k)%Z).
          { apply Z.lt_succ_r. apply lt_IZR. rewrite succ_IZR, <- G3. change (IZR (2 ^ 53)) with 9007199254740992. lra. }
          assert (O : 0 < IZR one) by (unfold one; apply IZR_lt, Z.pow_pos_nonneg; lia).
          assert (IZR (h * one - 1) <= 9007199254740991 /\ -9007199254740992 <= IZR (h * one - 1)) as [X1 X2].
          { rewrite minus_IZR, mult_IZR. apply IZR_le in Hk1. rewrite <- G3 in Hk1.
            change (IZR (2 ^ 53)) with 9007199254740992 in Hk1.
            assert (Y1 : IZR h * IZR one * g <= 9007199254740992 * g) by (rewrite Rmult_assoc, G1; lra).
            assert (Y2 : -9007199254740991 * g <= IZR h * IZR one * g) by (rewrite Rmult_assoc, G1; lra).
            split; (apply Rmult_le_reg_r with g; [lra|]); lra. }
          apply le_IZR in X1. apply le_IZR in X2. lia.
        - rewrite minus_IZR, mult_IZR, Rmult_minus_distr_r, Rmult_assoc, G1. unfold c. lra. }
      rewrite minus_IZR, mult_IZR, Rmult_minus_distr_r, Rmult_assoc, G1 in N. lra. }
    assert (Low : a - / 2 <= IZR h).
    { apply Rnot_lt_le. intros K.
      assert (K2 : g <= IZR (i - half - h * one) * g).
      { apply Step. rewrite !minus_IZR, mult_IZR, !Rmult_minus_distr_r, G2, <- Ea, Rmult_assoc, G1. lra. }
      rewrite !minus_IZR, mult_IZR, !Rmult_minus_distr_r, G2, <- Ea, Rmult_assoc, G1 in K2.
      assert (N : IZR (h + 1) <= t).
      { apply round_above; [|rewrite plus_IZR; unfold c; lra]. apply small_integer_64. apply Rabs_le.
        rewrite plus_IZR. apply Rabs_def2 in U. lra. }
      rewrite plus_IZR in N. lra. }
    split; [|apply Rabs_le; lra].
    assert (E : IZR h - a = IZR (h * one - i) * g)
      by (rewrite minus_IZR, mult_IZR, Rmult_minus_distr_r, Rmult_assoc, G1, <- Ea; ring).
    rewrite E. apply on_grid; [lia|].
    assert (IZR (h * one - i) <= 9007199254740992 /\ -9007199254740992 <= IZR (h * one - i)) as [X1 X2].
    { split; (apply Rmult_le_reg_r with g; [lra|]); rewrite <- E; lra. }
    apply le_IZR in X1. apply le_IZR in X2. lia.
Qed.

(* ---- Does x lie in the disc of its home cell? *)
Lemma inside_ok d0 d1 r : binary64 (val d0) -> binary64 (val d1) -> zero_or (val d0) -> zero_or (val d1) ->
  / 65536 <= val r <= / 2 -> let gap := val r * val r - (val d0 * val d0 + val d1 * val d1) in
  match is_inside d0 d1 r with Yes => 0 < gap | No => gap < 0 | Doubtful => True end.
Proof.
  intros F0 F1 Z0 Z1 Hr gap. unfold is_inside. cbv zeta.
  assert (Zr : zero_or (val r)) by (right; pose proof K_small; rewrite Rabs_pos_eq by lra; lra).
  destruct (near_product _ _ Zr Zr) as [_ Nr]. rewrite (Rabs_pos_eq (val r)) in Nr by lra.
  assert (Q : near (202 / 100) (val (sum_of_products d0 d0 d1 d1)) (val d0 * val d0 + val d1 * val d1)
    (Rabs (val d0) * Rabs (val d0) + Rabs (val d1) * Rabs (val d1))).
  { rewrite val_sum_of_products. replace (202 / 100) with (101 / 100 + 101 / 100) by lra.
    apply near_plus; try apply near_product; auto; try apply round_64; lra. }
  assert (Sq : forall a, Rabs a * Rabs a = a * a).
  { intros a. rewrite <- Rabs_mult. apply Rabs_pos_eq. apply Rle_0_sqr. }
  rewrite !Sq in Q. destruct Q as [_ Q].
  assert (q_64 : binary64 (val (sum_of_products d0 d0 d1 d1))) by (rewrite val_sum_of_products; apply round_64).
  set (square := val (sum_of_products d0 d0 d1 d1)) in *.
  set (sq := val d0 * val d0 + val d1 * val d1) in *.
  assert (Psq : 0 <= sq) by (unfold sq; pose proof (Rle_0_sqr (val d0)); pose proof (Rle_0_sqr (val d1));
    unfold Rsqr in *; lra).
  assert (El : val (times r r) = nearest64 (val r * val r)) by apply times_ok.
  set (limit := val (times r r)) in *. rewrite <- El in Nr.
  assert (l_64 : binary64 limit) by (unfold limit; rewrite times_ok; apply round_64).
  assert (R2 : / 65536 * / 65536 <= val r * val r) by (apply Rmult_le_compat; lra).
  set (r2 := val r * val r) in *. apply Rabs_le_inv in Nr, Q.
  pose proof (round_size_sum square limit q_64 l_64 ltac:(lra)) as S1.
  assert (Es : val (times six_roundoffs (plus (sum_of_products d0 d0 d1 d1) (times r r))) =
    nearest64 (6 * u * nearest64 (square + limit))) by (rewrite times_ok, six_is, plus_ok; reflexivity).
  assert (Eg : val (minus (times r r) (sum_of_products d0 d0 d1 d1)) = nearest64 (limit - square)) by apply minus_ok.
  set (t := nearest64 (square + limit)) in *.
  pose proof (round_size (6 * u * t) ltac:(lra)) as S2. pose proof eta_tiny as He.
  assert (s_64 : binary64 (nearest64 (6 * u * t))) by apply round_64.
  set (spread := nearest64 (6 * u * t)) in *.
  destruct (below_cases (times six_roundoffs (plus (sum_of_products d0 d0 d1 d1) (times r r)))
    (minus (times r r) (sum_of_products d0 d0 d1 d1))) as [[-> L]|[-> _]].
  - rewrite Es, Eg in L. assert (L' : spread < limit - square).
    { apply Rnot_le_lt. intros N. apply (round_below _ _ s_64) in N. lra. }
    unfold gap. assert (eta <= / 1000000000 * u * r2) by (unfold smallest_half;
      apply Rle_trans with (/ 1000000000 * u * (/ 65536 * / 65536)); [|apply Rmult_le_compat_l; lra];
      apply Rle_trans with (bpow radix2 (-30) * bpow radix2 (-53) * bpow radix2 (-32) * / 4);
      [change (/ 4) with (bpow radix2 (-2)); rewrite <- !bpow_plus; apply bpow_le; lia|];
      rewrite u_is; change (bpow radix2 (-30)) with (/ 1073741824); change (bpow radix2 (-32)) with (/ 4294967296); lra).
    lra.
  - destruct (below_cases (minus (times r r) (sum_of_products d0 d0 d1 d1))
      (neg (times six_roundoffs (plus (sum_of_products d0 d0 d1 d1) (times r r))))) as [[-> L]|[-> _]]; [|exact I].
    rewrite val_neg, Es, Eg in L. assert (L' : limit - square < - spread).
    { apply Rnot_le_lt. intros N. apply (round_above _ _ (generic_format_opp _ _ _ s_64)) in N. lra. }
    unfold gap. assert (eta <= / 1000000000 * u * r2) by (unfold smallest_half;
      apply Rle_trans with (/ 1000000000 * u * (/ 65536 * / 65536)); [|apply Rmult_le_compat_l; lra];
      apply Rle_trans with (bpow radix2 (-30) * bpow radix2 (-53) * bpow radix2 (-32) * / 4);
      [change (/ 4) with (bpow radix2 (-2)); rewrite <- !bpow_plus; apply bpow_le; lia|];
      rewrite u_is; change (bpow radix2 (-30)) with (/ 1073741824); change (bpow radix2 (-32)) with (/ 4294967296); lra).
    lra.
Qed.

(* ---- The whole flight. *)
Definition numeral_of (a : num) : numeral := Hexadecimal (Fnum a) (Fexp a).
Lemma value_of a : binary64 (val a) -> value (numeral_of a) = val a.
Proof. apply rounded_is. Qed.
Definition obstacle_of (c : Z * Z) : obstacle := disc (fst c) (snd c).
Definition flight (x0 x1 v0 v1 : num) (from : option (Z * Z)) : query :=
  Query [numeral_of x0; numeral_of x1] [numeral_of v0; numeral_of v1] (option_map obstacle_of from).

Lemma not_tiny_ok a : not_tiny a = true -> zero_or (val a).
Proof.
  unfold not_tiny, tiny. intros H. apply orb_true_iff in H. destruct H as [H|H].
  - left. apply Z.eqb_eq in H. unfold val, F2R. rewrite H. ring.
  - right. destruct (at_most_ok (power (-450)) (size_of a)) as [L|]; [|discriminate H].
    rewrite val_power, val_size in L. exact L.
Qed.
Lemma turn_sign_ok a : (turn_sign a * turn_sign a = 1)%Z /\ Rabs (val a) = IZR (turn_sign a) * val a.
Proof.
  unfold turn_sign. rewrite negative_ok. destruct (Rlt_bool_spec (val a) 0) as [L|L]; split; try reflexivity.
  - rewrite Rabs_left by exact L. ring.
  - rewrite Rabs_pos_eq by exact L. ring.
Qed.
Lemma turn_sign_cases a : turn_sign a = 1%Z \/ turn_sign a = (-1)%Z.
Proof. unfold turn_sign. destruct (Fnum a <? 0)%Z; auto. Qed.
Lemma val_turned a b : val (turned (turn_sign a) b) = IZR (turn_sign a) * val b.
Proof.
  unfold turned, turn_sign. destruct (Fnum a <? 0)%Z; cbn [Z.ltb Z.compare]; [rewrite val_neg|]; ring.
Qed.

Section Fly.
  Variables (x0 x1 v0 v1 r : num) (from : option (Z * Z)).
  Hypothesis x0_64 : binary64 (val x0).
  Hypothesis x1_64 : binary64 (val x1).
  Hypothesis v0_64 : binary64 (val v0).
  Hypothesis v1_64 : binary64 (val v1).
  Hypothesis r_64 : binary64 (val r).
  Notation X0 := (val x0).
  Notation X1 := (val x1).
  Notation V0 := (val v0).
  Notation V1 := (val v1).
  Notation h0 := (home_of x0).
  Notation h1 := (home_of x1).
  Notation s0 := (turn_sign v0).
  Notation s1 := (turn_sign v1).
  Notation within := (lies_in (unit_square (numeral_of r)) (flight x0 x1 v0 v1 from)).
  Notation from_disc := (option_map obstacle_of from).
  Hypothesis r_range : / 65536 <= val r <= / 2.

  Lemma within_is o t : within o t <-> exists i j, o = disc i j /\
    (X0 + t * V0 - IZR i) * (X0 + t * V0 - IZR i) + (X1 + t * V1 - IZR j) * (X1 + t * V1 - IZR j) <
    val r * val r.
  Proof.
    unfold lies_in, flight. cbn [start velocity point map along combine fst snd].
    rewrite !value_of by assumption. rewrite disc_is; rewrite value_of by assumption; [reflexivity|lra].
  Qed.
  Lemma from_is c : is_cell from c = false <-> from_disc <> Some (obstacle_of c).
  Proof.
    unfold is_cell. destruct from as [[a b]|]; cbn [option_map fst snd]; [|split; [discriminate|reflexivity]].
    destruct c as [i j]. cbn [fst snd]. split.
    - intros H E. injection E as -> ->. rewrite !Z.eqb_refl in H. discriminate H.
    - intros H. destruct (Z.eqb_spec a i) as [->|]; [|reflexivity]. destruct (Z.eqb_spec b j) as [->|]; [|reflexivity].
      contradiction H. reflexivity.
  Qed.

  (* The symmetry. *)
  Variable steep : bool.
  Definition there {A} (a b : A) : A * A := if steep then (b, a) else (a, b).
  Definition actual (c : Z * Z) : Z * Z :=
    let w := there (fst c) (snd c) in ((h0 + s0 * fst w)%Z, (h1 + s1 * snd w)%Z).
  Definition turned_cell (c : Z * Z) : Z * Z := there (s0 * (fst c - h0))%Z (s1 * (snd c - h1))%Z.
  Lemma actual_turned c : actual (turned_cell c) = c.
  Proof.
    unfold actual, turned_cell, there. destruct c as [i j].
    destruct (turn_sign_cases v0) as [-> | ->], (turn_sign_cases v1) as [-> | ->], steep; cbn [fst snd];
      f_equal; lia.
  Qed.
  Definition leaving_there : option (Z * Z) := option_map turned_cell from.
  Lemma leaving_is c : is_cell leaving_there c = is_cell from (actual c).
  Proof.
    unfold is_cell, leaving_there. destruct from as [[a b]|]; [|reflexivity]. cbn [option_map].
    unfold turned_cell, actual, there. destruct c as [i j].
    destruct (turn_sign_cases v0) as [-> | ->], (turn_sign_cases v1) as [-> | ->], steep; cbn [fst snd];
      apply eq_true_iff_eq; rewrite !andb_true_iff, !Z.eqb_eq; lia.
  Qed.
  (* The velocity and the home cell's disc there. *)
  Definition w0 : num := fst (there (size_of v0) (size_of v1)).
  Definition w1 : num := snd (there (size_of v0) (size_of v1)).
  Definition e0 : num := fst (there (turned s0 (offset_of x0)) (turned s1 (offset_of x1))).
  Definition e1 : num := snd (there (turned s0 (offset_of x0)) (turned s1 (offset_of x1))).
  Hypothesis home0 : val (offset_of x0) = IZR h0 - X0.
  Hypothesis home1 : val (offset_of x1) = IZR h1 - X1.
  Lemma along_actual c : along_line X0 X1 V0 V1 (fst (actual c)) (snd (actual c)) = along_cell w0 w1 e0 e1 c.
  Proof.
    unfold along_line, along_cell, actual, w0, w1, e0, e1, there.
    destruct (turn_sign_ok v0) as [E0 A0]. destruct (turn_sign_ok v1) as [E1 A1].
    apply (f_equal IZR) in E0, E1. rewrite mult_IZR in E0, E1.
    destruct steep; cbn [fst snd]; rewrite !val_turned, !val_size, A0, A1, home0, home1, !plus_IZR, !mult_IZR;
      set (a := IZR s0) in *; set (b := IZR s1) in *.
    - replace (a * V0 * (a * (IZR h0 - X0) + IZR (snd c))) with ((a * a) * (V0 * (IZR h0 - X0)) + a * V0 * IZR (snd c)) by ring.
      replace (b * V1 * (b * (IZR h1 - X1) + IZR (fst c))) with ((b * b) * (V1 * (IZR h1 - X1)) + b * V1 * IZR (fst c)) by ring.
      rewrite E0, E1. ring.
    - replace (a * V0 * (a * (IZR h0 - X0) + IZR (fst c))) with ((a * a) * (V0 * (IZR h0 - X0)) + a * V0 * IZR (fst c)) by ring.
      replace (b * V1 * (b * (IZR h1 - X1) + IZR (snd c))) with ((b * b) * (V1 * (IZR h1 - X1)) + b * V1 * IZR (snd c)) by ring.
      rewrite E0, E1. ring.
  Qed.
  Lemma across_actual c : let a := across_line X0 X1 V0 V1 (fst (actual c)) (snd (actual c)) in
    let b := across_cell w0 w1 e0 e1 c in a * a = b * b.
  Proof.
    unfold across_line, across_cell, actual, w0, w1, e0, e1, there.
    destruct (turn_sign_ok v0) as [E0 A0]. destruct (turn_sign_ok v1) as [E1 A1].
    apply (f_equal IZR) in E0, E1. rewrite mult_IZR in E0, E1.
    destruct steep; cbn [fst snd]; rewrite !val_turned, !val_size, A0, A1, home0, home1, !plus_IZR, !mult_IZR;
      set (a := IZR s0) in *; set (b := IZR s1) in *; cbv zeta.
    - set (p := V0 * (IZR h1 + b * IZR (fst c) - X1) - V1 * (IZR h0 + a * IZR (snd c) - X0)).
      assert (E : b * V1 * (a * (IZR h0 - X0) + IZR (snd c)) - a * V0 * (b * (IZR h1 - X1) + IZR (fst c)) = - (a * b) * p).
      { unfold p.
        replace (b * V1 * (a * (IZR h0 - X0) + IZR (snd c)) - a * V0 * (b * (IZR h1 - X1) + IZR (fst c))) with
          (a * b * (V1 * (IZR h0 - X0) - V0 * (IZR h1 - X1)) + (a * a) * b * V1 * IZR (snd c) - (b * b) * a * V0 * IZR (fst c))
          by (rewrite E0, E1; ring). ring. }
      rewrite E. replace (- (a * b) * p * (- (a * b) * p)) with ((a * a) * (b * b) * (p * p)) by ring.
      rewrite E0, E1. ring.
    - set (p := V0 * (IZR h1 + b * IZR (snd c) - X1) - V1 * (IZR h0 + a * IZR (fst c) - X0)).
      assert (E : a * V0 * (b * (IZR h1 - X1) + IZR (snd c)) - b * V1 * (a * (IZR h0 - X0) + IZR (fst c)) = (a * b) * p).
      { unfold p.
        replace (a * V0 * (b * (IZR h1 - X1) + IZR (snd c)) - b * V1 * (a * (IZR h0 - X0) + IZR (fst c))) with
          (a * b * (V0 * (IZR h1 - X1) - V1 * (IZR h0 - X0)) + (b * b) * a * V0 * IZR (snd c) - (a * a) * b * V1 * IZR (fst c))
          by (rewrite E0, E1; ring). ring. }
      rewrite E. replace (a * b * p * (a * b * p)) with ((a * a) * (b * b) * (p * p)) by ring.
      rewrite E0, E1. ring.
  Qed.
  Lemma speed_actual : val w0 * val w0 + val w1 * val w1 = V0 * V0 + V1 * V1.
  Proof.
    assert (Sq : forall a, Rabs a * Rabs a = a * a) by (intros a; rewrite <- Rabs_mult; apply Rabs_pos_eq, Rle_0_sqr).
    unfold w0, w1, there. destruct steep; cbn [fst snd]; rewrite !val_size, !Sq; ring.
  Qed.
  Lemma way_actual c : in_the_way w0 w1 e0 e1 r leaving_there c <-> from_disc <> Some (obstacle_of (actual c)) /\
    meets X0 X1 V0 V1 (val r) (fst (actual c)) (snd (actual c)) /\
    0 < along_line X0 X1 V0 V1 (fst (actual c)) (snd (actual c)).
  Proof.
    unfold in_the_way, meets. rewrite leaving_is, from_is, along_actual, across_actual, speed_actual. reflexivity.
  Qed.
End Fly.

Theorem fly_right x0 x1 v0 v1 r from : binary64 (val x0) -> binary64 (val x1) -> binary64 (val v0) ->
  binary64 (val v1) -> binary64 (val r) ->
  let within := lies_in (unit_square (numeral_of r)) (flight x0 x1 v0 v1 from) in
  let from_disc := option_map obstacle_of from in
  match fly x0 x1 v0 v1 r from with
  | HitAt i j => exists t, first_hit within from_disc (disc i j) t
  | InsideAt i j => first_inside within from_disc (disc i j)
  | NeverHit => nothing within from_disc
  | Undecided => True
  end.
Proof.
  intros x0_64 x1_64 v0_64 v1_64 r_64 within from_disc. unfold fly. cbv zeta.
  destruct (_ && _ && _ && _ && _ && _ && _ && _ && _ && _) eqn:C; [|exact I].
  rewrite !andb_true_iff in C. destruct C as (((((((((C1 & C2) & C3) & C4) & C5) & C6) & C7) & C8) & C9) & C10).
  apply below_true in C1, C2, C8. rewrite !val_size, !val_power in C1, C2. rewrite val_larger, !val_size, val_whole in C8.
  destruct (at_most_ok (whole 1) (larger (size_of v0) (size_of v1))) as [C7'|]; [clear C7|discriminate C7].
  rewrite val_larger, !val_size, val_whole in C7'.
  destruct (at_most_ok smallest_radius r) as [C9'|]; [clear C9|discriminate C9].
  destruct (at_most_ok r (power (-1))) as [C10'|]; [clear C10|discriminate C10].
  unfold smallest_radius in C9'. rewrite val_power in C9', C10'.
  change (bpow radix2 (-16)) with (/ 65536) in C9'. change (bpow radix2 (-1)) with (/ 2) in C10'.
  change (bpow radix2 51) with 2251799813685248 in C1, C2.
  apply not_tiny_ok in C3, C4, C5, C6.
  destruct (home_ok x0 x0_64 C1) as (H0 & B0 & O0). destruct (home_ok x1 x1_64 C2) as (H1 & B1 & O1).
  assert (Hr : / 65536 <= val r <= / 2) by lra.
  pose proof (within_is x0 x1 v0 v1 r from x0_64 x1_64 v0_64 v1_64 r_64 Hr) as W. fold within in W.
  pose proof (from_is from) as FI. fold from_disc in FI.
  assert (Moves : 0 < val v0 * val v0 + val v1 * val v1).
  { assert (Sq : forall a, Rabs a * Rabs a = a * a) by (intros a; rewrite <- Rabs_mult; apply Rabs_pos_eq, Rle_0_sqr).
    rewrite <- (Sq (val v0)), <- (Sq (val v1)). pose proof (Rabs_pos (val v0)). pose proof (Rabs_pos (val v1)). unfold Rmax in C7'.
    destruct (Rle_dec _ _); nra. }
  (* inside *)
  assert (Home : forall i j, within (disc i j) 0 -> i = home_of x0 /\ j = home_of x1).
  { intros i j. apply (home_only (val x0) (val x1) (val v0) (val v1) (val r)); try lra; try exact W;
      rewrite Rabs_minus_sym; lra. }
  assert (HomeIn : within (disc (home_of x0) (home_of x1)) 0 <->
    0 < val r * val r - (val (offset_of x0) * val (offset_of x0) + val (offset_of x1) * val (offset_of x1))).
  { rewrite W, H0, H1. split.
    - intros (i & j & E & K). apply disc_injective in E. destruct E as [<- <-]. lra.
    - intros K. exists (home_of x0), (home_of x1). split; [reflexivity|]. lra. }
  pose proof (inside_ok (offset_of x0) (offset_of x1) r O0 O1 C5 C6 Hr) as In. cbv zeta in In.
  assert (Leave : is_cell (relative (home_of x0, home_of x1) from) (0%Z, 0%Z) =
    is_cell from (home_of x0, home_of x1)).
  { unfold is_cell, relative. destruct from as [[a b]|]; [|reflexivity]. cbn [fst snd]. apply eq_true_iff_eq.
    rewrite !andb_true_iff, !Z.eqb_eq. lia. }
  rewrite Leave. clear Leave. cbn [fst snd].
  assert (Out : (if is_cell from (home_of x0, home_of x1) then No else is_inside (offset_of x0) (offset_of x1) r) = No ->
    forall i j, from_disc <> Some (disc i j) -> ~ within (disc i j) 0).
  { intros E i j F K. destruct (Home i j K) as [-> ->].
    change (disc (home_of x0) (home_of x1)) with (obstacle_of (home_of x0, home_of x1)) in F.
    apply FI in F. rewrite F in E. rewrite E in In. apply HomeIn in K. lra. }
  destruct (if is_cell from (home_of x0, home_of x1) then No else is_inside (offset_of x0) (offset_of x1) r) eqn:E.
  - (* inside *)
    destruct (is_cell from (home_of x0, home_of x1)) eqn:EL; [discriminate E|]. rewrite E in In.
    split; [apply (FI (home_of x0, home_of x1)), EL|]. split; [apply HomeIn, In|].
    intros o' _ K. destruct (within_is_disc (val x0) (val x1) (val v0) (val v1) (val r) within W o' 0 K) as (i & j & ->).
    destruct (Home i j K) as [-> ->]. left. reflexivity.
  - (* outside *)
    specialize (Out eq_refl). clear E In HomeIn Home. unfold fly_outside. cbv zeta.
    set (steep := below (size_of v0) (size_of v1)).
    change (if steep then (size_of v1, size_of v0) else (size_of v0, size_of v1)) with
      (there steep (size_of v0) (size_of v1)).
    fold (w0 v0 v1 steep) (w1 v0 v1 steep).
    change (if steep then (turned (turn_sign v1) (offset_of x1), turned (turn_sign v0) (offset_of x0))
      else (turned (turn_sign v0) (offset_of x0), turned (turn_sign v1) (offset_of x1))) with
      (there steep (turned (turn_sign v0) (offset_of x0)) (turned (turn_sign v1) (offset_of x1))).
    fold (e0 x0 x1 v0 v1 steep) (e1 x0 x1 v0 v1 steep).
    assert (EF : match relative (home_of x0, home_of x1) from with
      | Some f => Some (if steep then ((turn_sign v1 * snd f)%Z, (turn_sign v0 * fst f)%Z)
          else ((turn_sign v0 * fst f)%Z, (turn_sign v1 * snd f)%Z))
      | None => None end = leaving_there x0 x1 v0 v1 from steep) by (destruct from; reflexivity).
    rewrite EF. clear EF.
    destruct (set_direction (w0 v0 v1 steep) (w1 v0 v1 steep) r) as [to|] eqn:ED; [|exact I].
    destruct (search to _ _) as [b|] eqn:ES; [|exact I].
    assert (Order : 1 <= val (w0 v0 v1 steep) < 2 /\ 0 <= val (w1 v0 v1 steep) <= val (w0 v0 v1 steep)).
    { unfold w0, w1, there, steep. pose proof (Rabs_pos (val v0)). pose proof (Rabs_pos (val v1)).
      destruct (below_cases (size_of v0) (size_of v1)) as [[-> Le]|[-> Le]]; rewrite !val_size in Le; cbn [fst snd];
        rewrite !val_size; unfold Rmax in *; destruct (Rle_dec _ _); lra. }
    assert (Parts : binary64 (val (w0 v0 v1 steep)) /\ binary64 (val (w1 v0 v1 steep)) /\
      binary64 (val (e0 x0 x1 v0 v1 steep)) /\ binary64 (val (e1 x0 x1 v0 v1 steep)) /\
      Rabs (val (e0 x0 x1 v0 v1 steep)) <= / 2 /\ Rabs (val (e1 x0 x1 v0 v1 steep)) <= / 2 /\
      zero_or (val (w1 v0 v1 steep)) /\ zero_or (val (e0 x0 x1 v0 v1 steep)) /\
      zero_or (val (e1 x0 x1 v0 v1 steep))).
    { assert (Tb : forall a b, binary64 (val b) -> binary64 (val (turned (turn_sign a) b))).
      { intros a b' Hb. unfold turned. destruct (turn_sign a <? 0)%Z; [rewrite val_neg; apply generic_format_opp|]; exact Hb. }
      assert (Tr : forall a b, Rabs (val b) <= / 2 -> Rabs (val (turned (turn_sign a) b)) <= / 2).
      { intros a b' Hb. unfold turned. destruct (turn_sign a <? 0)%Z; [rewrite val_neg, Rabs_Ropp|]; exact Hb. }
      assert (Tz : forall a b, zero_or (val b) -> zero_or (val (turned (turn_sign a) b))).
      { intros a b' Hb. unfold turned. destruct (turn_sign a <? 0)%Z; [rewrite val_neg; apply zero_or_opp|]; exact Hb. }
      assert (Ts : forall a, zero_or (val a) -> zero_or (val (size_of a))).
      { intros a [Ha|Ha]; [left; rewrite val_size, Ha; apply Rabs_R0|right; rewrite val_size, Rabs_Rabsolu; exact Ha]. }
      rewrite <- H0 in B0. rewrite <- H1 in B1.
      unfold w0, w1, e0, e1, there. destruct steep; cbn [fst snd]; repeat split; auto;
        rewrite val_size; apply abs_64; assumption. }
    destruct Parts as (P1 & P2 & P3 & P4 & P5 & P6 & P7 & P8 & P9). destruct Order as [Q1 Q2].
    pose proof (search_in_octant (w0 v0 v1 steep) (w1 v0 v1 steep) (e0 x0 x1 v0 v1 steep) (e1 x0 x1 v0 v1 steep) r
      P1 P2 P3 P4 Q1 Q2 P5 P6 P7 P8 P9 Hr to (leaving_there x0 x1 v0 v1 from steep) ED b ES) as Found.
    pose proof (way_actual x0 x1 v0 v1 r from steep H0 H1) as Way. fold from_disc in Way.
    destruct b as [f|].
    + cbv zeta in Found. set (c := cell_at to (at_n f) (at_m f)) in *. destruct Found as [Met First].
      change (exists t, first_hit within from_disc (obstacle_of (actual x0 x1 v0 v1 steep c)) t).
      set (g := actual x0 x1 v0 v1 steep c) in *.
      apply Way in Met. destruct Met as (M1 & M2 & M3). fold g in M1, M2, M3.
      exists (entry (val x0) (val x1) (val v0) (val v1) (val r) (fst g) (snd g)).
      apply (first_by_position (val x0) (val x1) (val v0) (val v1) (val r)); try assumption; try lra.
      intros i' j' F' M' A'. pose proof (actual_turned x0 x1 v0 v1 steep (i', j')) as Ec.
      set (c' := turned_cell x0 x1 v0 v1 steep (i', j')) in *.
      assert (Met' : in_the_way (w0 v0 v1 steep) (w1 v0 v1 steep) (e0 x0 x1 v0 v1 steep) (e1 x0 x1 v0 v1 steep) r
        (leaving_there x0 x1 v0 v1 from steep) c') by (apply Way; rewrite Ec; cbn [fst snd]; auto).
      destruct (First c' Met') as [Eq|L].
      * left. rewrite <- Ec, Eq. fold g. destruct g; reflexivity.
      * right. rewrite <- !(along_actual x0 x1 v0 v1 steep H0 H1), Ec in L. fold g in L. cbn [fst snd] in L. exact L.
    + apply (nothing_by_position (val x0) (val x1) (val v0) (val v1) (val r)); try assumption; try lra.
      intros i j F' M' A'. pose proof (actual_turned x0 x1 v0 v1 steep (i, j)) as Ec.
      apply (Found (turned_cell x0 x1 v0 v1 steep (i, j))). apply Way. rewrite Ec. cbn [fst snd]. auto.
  - cbv iota. match goal with |- True => exact I end.  (* `exact I` alone would compute a search *)
Qed.
