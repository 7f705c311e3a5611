(* docs/bounds.md, "Height in a row", "Position along the line", "Rows", "Radius": what Certain.v asks for. *)
From Coq Require Import ZArith Reals Lra Lia Psatz Bool.
From Flocq Require Import Core.
From Lorentz Require Import Spec Doubles Euclid Rows Model Certain Roundings Errors ErrorsStart.
Local Open Scope R_scope.

Section Known.
  Local Opaque plus minus times over root rounded below at_most floor euclid max_coefficient.
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
  Variable to : direction.
  Hypothesis direction_set : set_direction v0 v1 r = Some to.
  Notation here := (set_start (is_flipped to) v0 v1 d0 d1).
  Notation DR := (val (D_R to)).
  Notation DL := (val (D_L to)).
  Notation SR := (SR v0 v1 to).
  Notation SL := (SL v0 v1 to).
  Notation Y := (true_y v0 v1 d0 d1 (is_flipped to)).
  Notation S := (true_s v0 v1 d0 d1).
  Notation Rho := (Rho v0 v1 r).
  Notation V2 := (V2 v0 v1).
  Notation size := (offset_size d0 d1).
  Notation height_at := (height_at DR DL Y).
  Notation position_at := (position_at SR SL S).
  Notation F := (bpow radix2 (-390)).

  Lemma all_facts : facts v0 v1 r to.
  Proof. apply facts_hold; assumption. Qed.
  Lemma y_is : Rabs (val (y here) - Y) <= (1 - 4 * u) * val (y_error here) - F / 2 /\
    0 <= val (y_error here) <= 3 * u /\ binary64 (val (y here)) /\ binary64 (val (y_error here)) /\
    Rabs Y <= 2 /\ Rabs (val (y here)) <= 2001 / 1000.
  Proof. apply y_known; assumption. Qed.
  Lemma s_is : Rabs (val (s here) - S) <= 40001 / 10000 * u * size /\
    Rabs (val (s here)) <= 20001 / 10000 * size /\ Rabs S <= 2 * size /\
    binary64 (val (s here)) /\ binary64 (val (s_error here)) /\
    8 * u * (1 - 3 * u) * size <= val (s_error here) /\ (size = 0 \/ K <= size) /\
    size <= 1 /\ 0 <= val (s_error here).
  Proof. apply s_known; assumption. Qed.
  Lemma eight_is : val eight_roundoffs = 8 * u.
  Proof using. unfold eight_roundoffs. rewrite val_power. change (bpow radix2 (-50)) with (/ 1125899906842624). lra. Qed.
  Lemma six_is : val six_roundoffs = 6 * u.
  Proof using.
    unfold six_roundoffs, val, F2R. cbn [Fnum Fexp]. change (bpow radix2 (-52)) with (/ 4503599627370496). lra.
  Qed.
  Lemma abs_64 x : binary64 x -> binary64 (Rabs x).
  Proof using. apply generic_format_abs. Qed.

  (* ---- Heights. *)
  Lemma height_known n m :
    Rabs (val (height_in_row to here n m) - height_at n m) <= (1 - 2 * u) * val (height_error to here n m) /\
    0 <= val (height_error to here n m) /\ binary64 (val (height_in_row to here n m)) /\
    binary64 (val (height_error to here n m)).
  Proof.
    destruct y_is as (Ey & Ry & y_64 & ye_64 & _). destruct F_facts as [HF He]. pose proof eta_positive as Hp.
    unfold height_in_row, height_error. rewrite minus_ok, !plus_ok, !times_ok, !plus_ok, !val_size, !times_ok,
      !val_whole, eight_is.
    set (yv := val (y here)) in *. set (ye := val (y_error here)) in *.
    unfold Rows.height_at. set (a := IZR n * DR). set (b := IZR m * DL).
    pose proof (round_back a) as Ra. pose proof (round_back b) as Rb.
    assert (a_64 : binary64 (nearest64 a)) by apply round_64.
    assert (b_64 : binary64 (nearest64 b)) by apply round_64.
    set (a' := nearest64 a) in *. set (b' := nearest64 b) in *.
    pose proof (round_sum yv a' y_64 a_64) as Rc. assert (c_64 : binary64 (nearest64 (yv + a'))) by apply round_64.
    set (c := nearest64 (yv + a')) in *.
    pose proof (round_difference c b' c_64 b_64) as Rh. set (h := nearest64 (c - b')) in *.
    pose proof (Rabs_pos yv) as Py. pose proof (Rabs_pos a') as Pa. pose proof (Rabs_pos b') as Pb.
    pose proof (round_size_sum _ _ (abs_64 _ y_64) (abs_64 _ a_64) ltac:(lra)) as T1.
    assert (t1_64 : binary64 (nearest64 (Rabs yv + Rabs a'))) by apply round_64.
    set (t1 := nearest64 (Rabs yv + Rabs a')) in *.
    pose proof (round_size_sum _ _ t1_64 (abs_64 _ b_64) ltac:(lra)) as T2.
    set (t2 := nearest64 (t1 + Rabs b')) in *.
    pose proof (round_size (8 * u * t2) ltac:(lra)) as T3. pose proof (round_nonneg (8 * u * t2) ltac:(lra)) as P3.
    assert (t3_64 : binary64 (nearest64 (8 * u * t2))) by apply round_64. set (t3 := nearest64 (8 * u * t2)) in *.
    pose proof (round_size_sum _ _ t3_64 ye_64 ltac:(lra)) as T4.
    pose proof (round_nonneg (t3 + ye) ltac:(lra)) as P4. set (t4 := nearest64 (t3 + ye)) in *.
    assert (C1 : Rabs (yv + a') <= Rabs yv + Rabs a') by apply Rabs_triang.
    assert (C2 : Rabs (c - b') <= (1 + u) * (Rabs yv + Rabs a') + Rabs b').
    { replace (c - b') with ((yv + a') + ((c - (yv + a')) + - b')) by ring.
      apply Rle_trans with (1 := Rabs_triang _ _).
      pose proof (Rabs_triang (c - (yv + a')) (- b')) as K1. rewrite (Rabs_Ropp b') in K1. lra. }
    split; [|split; [exact P4|split; apply round_64]].
    replace (h - (Y + a - b)) with ((h - (c - b')) + ((c - (yv + a')) + ((yv - Y) + ((a' - a) + - (b' - b))))) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _).
    pose proof (Rabs_triang (c - (yv + a')) ((yv - Y) + ((a' - a) + - (b' - b)))) as K1.
    pose proof (Rabs_triang (yv - Y) ((a' - a) + - (b' - b))) as K2.
    pose proof (Rabs_triang (a' - a) (- (b' - b))) as K3. rewrite (Rabs_Ropp (b' - b)) in K3. lra.
  Qed.

  Lemma below_true a b : below a b = true -> val a < val b.
  Proof using. destruct (below_ok a b); intros E; [assumption|discriminate E]. Qed.
  Lemma below_false a b : below a b = false -> val b <= val a.
  Proof using. destruct (below_ok a b); intros E; [discriminate E|lra]. Qed.
  Lemma below_cases a b : (below a b = true /\ val a < val b) \/ (below a b = false /\ val b <= val a).
  Proof using. destruct (below_ok a b); [left|right]; split; auto; lra. Qed.
  Lemma rho_range : (1 - 5 * u) * Rho <= val (rho to) <= (1 + 5 * u) * Rho /\ binary64 (val (rho to)) /\
    / 65536 <= Rho < 3 / 2.
  Proof.
    rewrite (rho_is _ _ _ _ all_facts). split; [|split].
    - apply rho_of_range; assumption.
    - unfold rho_of. rewrite times_ok. apply round_64.
    - apply Rho_range; assumption.
  Qed.
  Lemma strip_holds : strip_known to here Y Rho.
  Proof.
    intros n m. destruct (height_known n m) as (H & He & h_64 & e_64).
    set (h := height_in_row to here n m) in *. set (e := height_error to here n m) in *.
    destruct rho_range as (Rr & rho_64 & RR). unfold is_below. set (rh := rho to) in *.
    destruct F_facts as [HF Hf]. pose proof eta_positive as Hp.
    set (spread := plus e (times six_roundoffs rh)).
    assert (Es : (1 - u) * (val e + (58 / 10 * u) * Rho) <= val spread /\ binary64 (val spread)).
    { unfold spread. rewrite plus_ok, times_ok, six_is.
      pose proof (round_size (6 * u * val rh) ltac:(lra)) as T. assert (t_64 : binary64 (nearest64 (6 * u * val rh)))
        by apply round_64.
      pose proof (round_nonneg (6 * u * val rh) ltac:(lra)) as P. set (t := nearest64 (6 * u * val rh)) in *.
      pose proof (round_size_sum _ _ e_64 t_64 ltac:(lra)) as T2. split; [|apply round_64].
      assert (58 / 10 * u * Rho <= t); [|lra]. lra. }
    destruct Es as [Es s_64]. absolute (val h). absolute (height_at n m). apply Rabs_le_inv in H.
    destruct (below_cases (plus (size_of h) spread) rh) as [[-> L]|[-> L]].
    - rewrite plus_ok, val_size in L.
      assert (L' : Rabs (val h) + val spread < val rh).
      { apply Rnot_le_lt. intros N. apply (round_above _ _ rho_64) in N. lra. }
      unfold Rows.in_strip. apply Rabs_def1; lra.
    - destruct (below_cases rh (minus (size_of h) spread)) as [[-> L2]|[-> _]]; [|exact I].
      rewrite minus_ok, val_size in L2.
      assert (L' : val rh < Rabs (val h) - val spread).
      { apply Rnot_le_lt. intros N. apply (round_below _ _ rho_64) in N. lra. }
      destruct (below_cases h (whole 0)) as [[-> L3]|[-> L3]]; rewrite val_whole in L3.
      + rewrite Rabs_left in L' by exact L3. lra.
      + rewrite Rabs_pos_eq in L' by exact L3. lra.
  Qed.

  (* ---- Positions. *)
  Lemma position_known n m : let x := nearest64 (IZR n * val (S_R to)) in let z := nearest64 (IZR m * val (S_L to)) in
    Rabs (x - IZR n * SR) <= 306 / 100 * u * Rabs x /\ Rabs (z - IZR m * SL) <= 306 / 100 * u * Rabs z /\
    (x = 0 \/ K / 2 <= Rabs x) /\ (m = 0%Z /\ z = 0 \/ 9 / 10 <= Rabs z) /\
    Rabs (val (sum_along to here n m) - position_at n m) <= 79 / 10 * u * size + 7 * u * (Rabs x + Rabs z) /\
    8 * u * (1 - 10 * u) * (size + Rabs x + Rabs z) <= val (along_error to here n m) /\
    binary64 (val (sum_along to here n m)).
  Proof.
    intros x z. pose proof all_facts as A. destruct s_is as (Es & Ts & TS & s_64 & se_64 & Ls & Zs & s1 & Ps).
    pose proof (SR_near _ _ _ _ A) as NR. pose proof (SL_near _ _ _ _ A) as NL.
    pose proof (SR_range _ _ _ _ A) as RR. pose proof (SL_range _ _ _ _ A) as RL.
    pose proof (SR_zero_or _ _ _ _ A) as ZR. pose proof K_small as KS. pose proof eta_positive as Hp.
    assert (KE : eta <= u * u * u * K).
    { replace (u * u * u * K) with (bpow radix2 (-53) * bpow radix2 (-53) * bpow radix2 (-53) * K)
        by (rewrite u_is; reflexivity). rewrite <- !bpow_plus. apply eta_below. lia. }
    assert (Term : forall (k : Z) (c t : R), near (202 / 100) c t t -> 0 <= t -> t = 0 \/ K <= t ->
      let w := nearest64 (IZR k * c) in Rabs (w - IZR k * t) <= 306 / 100 * u * Rabs w /\
      (k = 0%Z \/ t = 0 -> w = 0) /\ (k <> 0%Z -> (1 - 10 * u) * t <= Rabs w)).
    { intros k c t [_ N] Pt Zt w. apply Rabs_le_inv in N.
      assert (Z0 : k = 0%Z \/ t = 0 -> IZR k * c = 0 /\ IZR k * t = 0).
      { intros [->|Z0]; [split; ring|]. assert (c = 0) as -> by lra. rewrite Z0. split; ring. }
      destruct (Z.eq_dec k 0) as [Zk|Nk].
      { destruct (Z0 (or_introl Zk)) as [E1 E2]. unfold w. rewrite E1, E2, nearest64_0, Rminus_diag_eq, Rabs_R0 by reflexivity.
        split; [lra|]. split; [auto|]. intros []. exact Zk. }
      destruct Zt as [Zt|Zt].
      { destruct (Z0 (or_intror Zt)) as [E1 E2]. unfold w. rewrite E1, E2, nearest64_0, Rminus_diag_eq, Rabs_R0 by reflexivity.
        rewrite Zt. split; [lra|]. split; [auto|]. lra. }
      assert (Pk : 1 <= Rabs (IZR k)) by (rewrite <- abs_IZR; apply (IZR_le 1); lia).
      assert (C : (1 - 3 * u) * t <= c <= (1 + 3 * u) * t) by (split; nra).
      assert (B : t <= Rabs (IZR k) * t) by nra. set (g := Rabs (IZR k) * t) in *.
      assert (N' : Rabs (IZR k * c - IZR k * t) <= 202 / 100 * u * g).
      { rewrite <- Rmult_minus_distr_l, Rabs_mult.
        assert (Rabs (c - t) <= 202 / 100 * u * t) by (apply Rabs_le; lra). unfold g.
        pose proof (Rabs_pos (c - t)). nra. }
      assert (G : Rabs (IZR k * t) = g) by (rewrite Rabs_mult, (Rabs_pos_eq t) by exact Pt; reflexivity).
      assert (G2 : Rabs (IZR k * c) <= (1 + 3 * u) * g).
      { replace (IZR k * c) with (IZR k * t + (IZR k * c - IZR k * t)) by ring.
        apply Rle_trans with (1 := Rabs_triang _ _). lra. }
      pose proof (round_any (IZR k * c)) as Rw. fold w in Rw.
      assert (W : Rabs (w - IZR k * t) <= 303 / 100 * u * g).
      { replace (w - IZR k * t) with ((w - IZR k * c) + (IZR k * c - IZR k * t)) by ring.
        apply Rle_trans with (1 := Rabs_triang _ _). lra. }
      assert (g <= Rabs w + Rabs (w - IZR k * t)).
      { rewrite <- G. replace (IZR k * t) with (w - (w - IZR k * t)) at 1 by ring.
        apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra. }
      split; [lra|]. split; [intros [|]; [contradiction|lra]|]. intros _. lra. }
    assert (ZR' : SR = 0 \/ K <= SR) by (destruct ZR as [|ZR]; [left; auto|right; rewrite Rabs_pos_eq in ZR; lra]).
    destruct (Term n (val (S_R to)) SR NR ltac:(lra) ZR') as (X1 & X2 & X3).
    destruct (Term m (val (S_L to)) SL NL ltac:(lra) ltac:(right; lra)) as (Z1 & Z2 & Z3). fold x in X1, X2, X3.
    fold z in Z1, Z2, Z3. clear Term.
    assert (Xz : x = 0 \/ K / 2 <= Rabs x).
    { destruct (Z.eq_dec n 0); [left; auto|]. destruct ZR'; [left; auto|right]. specialize (X3 ltac:(assumption)). lra. }
    assert (Zz : m = 0%Z /\ z = 0 \/ 9 / 10 <= Rabs z).
    { destruct (Z.eq_dec m 0); [left; split; auto|right]. specialize (Z3 ltac:(assumption)). lra. }
    split; [exact X1|]. split; [exact Z1|]. split; [exact Xz|]. split; [exact Zz|].
    assert (x_64 : binary64 x) by apply round_64. assert (z_64 : binary64 z) by apply round_64.
    unfold sum_along, along_error. rewrite !plus_ok, !times_ok, !plus_ok, !val_size, !times_ok, !val_whole, eight_is.
    fold x z. set (sv := val (s here)) in *. set (se := val (s_error here)) in *.
    pose proof (round_sum sv x s_64 x_64) as Rc. assert (c_64 : binary64 (nearest64 (sv + x))) by apply round_64.
    set (c := nearest64 (sv + x)) in *. pose proof (round_sum c z c_64 z_64) as Rp.
    assert (Rp' : z = 0 -> nearest64 (c + z) = c + z).
    { intros ->. rewrite Rplus_0_r. apply rounded_is, c_64. }
    set (p := nearest64 (c + z)) in *.
    pose proof (Rabs_pos x) as Px. pose proof (Rabs_pos z) as Pz. pose proof (Rabs_pos sv) as Psv.
    assert (C1 : Rabs (sv + x) <= Rabs sv + Rabs x) by apply Rabs_triang.
    assert (C2 : Rabs (c + z) <= (1 + u) * (Rabs sv + Rabs x) + Rabs z).
    { replace (c + z) with ((sv + x) + ((c - (sv + x)) + z)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
      pose proof (Rabs_triang (c - (sv + x)) z) as K1. lra. }
    split; [|split; [|apply round_64]].
    - unfold Rows.position_at.
      replace (p - (S + IZR n * SR + IZR m * SL)) with
        ((p - (c + z)) + ((c - (sv + x)) + ((sv - S) + ((x - IZR n * SR) + (z - IZR m * SL))))) by ring.
      apply Rle_trans with (1 := Rabs_triang _ _).
      pose proof (Rabs_triang (c - (sv + x)) ((sv - S) + ((x - IZR n * SR) + (z - IZR m * SL)))) as K1.
      pose proof (Rabs_triang (sv - S) ((x - IZR n * SR) + (z - IZR m * SL))) as K2.
      pose proof (Rabs_triang (x - IZR n * SR) (z - IZR m * SL)) as K3.
      destruct Zz as [[_ Zz]|Zz]; [|lra].
      rewrite (Rp' Zz), (Rminus_diag_eq (c + z)), Rabs_R0 by reflexivity. lra.
    - pose proof (round_size_sum _ _ (abs_64 _ x_64) (abs_64 _ z_64) ltac:(lra)) as T1.
      set (t1 := nearest64 (Rabs x + Rabs z)) in *.
      pose proof (round_size (8 * u * t1) ltac:(lra)) as T2. pose proof (round_nonneg (8 * u * t1) ltac:(lra)) as P2.
      assert (t2_64 : binary64 (nearest64 (8 * u * t1))) by apply round_64. set (t2 := nearest64 (8 * u * t1)) in *.
      pose proof (round_size_sum _ _ se_64 t2_64 ltac:(lra)) as T3. set (t3 := nearest64 (se + t2)) in *.
      assert (size_pos : 0 <= size) by (destruct Zs; lra).
      assert (K4 : 8 * u * (1 - 5 * u) * (Rabs x + Rabs z) <= t2); [|lra].
      destruct (Rle_lt_dec (K / 2) (Rabs x + Rabs z)) as [L|L]; [lra|].
      destruct Xz as [Xz|Xz]; [|lra]. destruct Zz as [[_ Zz]|Zz]; [|lra]. rewrite Xz, Zz, Rabs_R0. lra.
  Qed.
  Lemma positions_hold : positions_known to here SR SL S.
  Proof.
    intros n m. destruct (position_known n m) as (_ & _ & _ & _ & H & E & _).
    set (x := nearest64 (IZR n * val (S_R to))) in *. set (z := nearest64 (IZR m * val (S_L to))) in *.
    pose proof (Rabs_pos x). pose proof (Rabs_pos z).
    destruct s_is as (_ & _ & _ & _ & _ & _ & Zs & _). pose proof K_small.
    assert (0 <= size) by (destruct Zs; lra). lra.
  Qed.

  (* ---- Rows come in order. *)
  Lemma order_holds : order_known to Rho.
  Proof.
    intros H. unfold are_in_order in H. apply below_true in H. rewrite !times_ok, val_whole in H.
    destruct rho_range as (Rr & _ & RR). pose proof eta_tiny as He.
    assert (E : val more_than_one = 1 + / 1073741824).
    { unfold val, more_than_one, F2R. cbn [Fnum Fexp]. change (bpow radix2 (-30)) with (/ 1073741824).
      change (IZR (2 ^ 30 + 1)) with 1073741825. lra. }
    rewrite E in H. pose proof (round_size (2 * val (rho to)) ltac:(lra)) as A.
    set (a := nearest64 (2 * val (rho to))) in *.
    pose proof (round_size (a * (1 + / 1073741824)) ltac:(lra)) as B. lra.
  Qed.
  (* ---- Rows. *)
  Notation Area := (area_of DR DL SR SL).
  Notation Beside := (beside DR DL SR SL Y S).
  Notation Reach := (reach DR DL SR SL Rho).
  Notation tiny_term := (bpow radix2 (-900)).
  Lemma area_V2 : Area = V2.
  Proof. exact (area_is _ _ _ _ all_facts). Qed.
  Lemma tiny_term_small : 0 < tiny_term <= / 1000000.
  Proof using.
    split; [apply bpow_gt_0|]. apply Rle_trans with (bpow radix2 (-20)); [apply bpow_le; lia|].
    change (bpow radix2 (-20)) with (/ 1048576). lra.
  Qed.
  (* Lengths and heights in units of the area. *)
  Lemma shares : SL * / V2 <= 65536 /\ 0 <= DL * / V2 <= 1 /\ SR * (DL * / V2) <= 1 /\ 0 < / V2 <= 1 /\
    0 < DR /\ / 8 <= / V2.
  Proof.
    pose proof all_facts as A. pose proof (V2_range v0 v1 v0_range v1_range) as RV.
    pose proof (DR_range _ _ _ _ A) as RD. pose proof (DL_range _ _ _ _ A) as RL.
    pose proof (SR_range _ _ _ _ A) as RS. pose proof (SL_range _ _ _ _ A) as RSL.
    pose proof (area_is _ _ _ _ A) as E.
    assert (P : 0 < / V2) by (apply Rinv_0_lt_compat; lra). assert (I : V2 * / V2 = 1) by (field; lra).
    assert (S1 : 0 <= SR * DL) by nra. assert (S2 : SL * / 65536 <= SL * DR) by nra.
    assert (S3 : DL <= SL * DR) by nra.
    set (i := / V2) in *. split; [|split; [split|split; [|split; [split|split]]]].
    - assert (SL <= 65536 * V2) by lra. nra.
    - nra.
    - assert (DL <= V2) by lra. nra.
    - assert (SR * DL <= V2) by nra. nra.
    - exact P.
    - nra.
    - lra.
    - nra.
  Qed.
  Lemma row_number_known : Rabs (val (row_beside_start to here) - Beside) <= 13 / 10000000000 / 9 /\
    Rabs Beside <= 131080 /\ binary64 (val (row_beside_start to here)).
  Proof.
    pose proof all_facts as A. destruct s_is as (Es & Ts & TS & s_64 & se_64 & Ls & Zs & s1 & Ps).
    destruct y_is as (Ey & Ry & y_64 & ye_64 & TY & _). destruct F_facts as [HF _].
    pose proof shares as (H1 & H2 & _ & H4 & _ & H8). pose proof tiny_term_small as Tt.
    pose proof (SL_range _ _ _ _ A) as RSL. pose proof (DL_range _ _ _ _ A) as RL.
    unfold row_beside_start. rewrite times_ok, val_neg, plus_ok, !times_ok.
    set (p1 := nearest64 (val (S_L to) * val (y here))). set (p2 := nearest64 (val (D_L to) * val (s here))).
    assert (Ny : near (3 / 2) (val (y here)) Y 2) by (split; lra).
    assert (Ns : near (3 / 2 + 2) (val (s here)) S 2) by (split; lra).
    pose proof (near_times _ _ _ _ _ _ _ _ (SL_near _ _ _ _ A) Ny ltac:(lra) ltac:(lra)) as N1. fold p1 in N1.
    pose proof (near_exact DL) as NL. rewrite Rabs_pos_eq in NL by lra.
    pose proof (near_times_any _ _ _ _ _ _ _ _ NL Ns ltac:(lra) ltac:(lra)) as N2. fold p2 in N2.
    assert (B960 : bpow radix2 (-960) <= / 8) by (apply (bpow_le radix2 (-960) (-3)); lia).
    specialize (N1 ltac:(right; lra)).
    apply near_weaken with (k' := 46 / 10) (T' := SL * 2) in N1; [|lra|lra].
    apply near_weaken with (k' := 46 / 10) (T' := DL * 2 + tiny_term) in N2; [|lra|lra].
    pose proof (near_plus _ _ _ _ _ _ _ N1 N2 ltac:(lra) (round_64 _) (round_64 _)) as N3.
    apply near_opp in N3.
    pose proof (near_times _ _ _ _ _ _ _ _ N3 (A_near _ _ _ _ A) ltac:(lra) ltac:(lra)) as N4.
    assert (G : (SL * 2 + (DL * 2 + tiny_term)) * / V2 <= 131075).
    { rewrite !Rmult_plus_distr_r. assert (tiny_term * / V2 <= 1) by nra. lra. }
    assert (G8 : / 8 <= (SL * 2 + (DL * 2 + tiny_term)) * / V2).
    { rewrite <- (Rmult_1_l (/ 8)). apply Rmult_le_compat; lra. }
    specialize (N4 ltac:(right; lra)).
    destruct N4 as [M1 M2]. set (t := (SL * 2 + (DL * 2 + tiny_term)) * / V2) in *.
    assert (E : - (SL * Y + DL * S) * / V2 = Beside).
    { unfold beside. rewrite area_V2. reflexivity. }
    rewrite E in *. split; [lra|]. split; [lra|apply round_64].
  Qed.
  Lemma row_slop_is : val row_slop = / 268435456.
  Proof using. unfold row_slop. rewrite val_power. reflexivity. Qed.
  Lemma reach_known : Reach + / 268435456 - / 6500000000 <= val (reach_of_rows to) <= 98310 /\
    0 <= Reach <= 98304 /\ binary64 (val (reach_of_rows to)).
  Proof.
    pose proof all_facts as A. pose proof shares as (H1 & H2 & _ & H4 & _ & H8).
    pose proof (SL_range _ _ _ _ A) as RSL. destruct rho_range as (Rr & rho_64 & RR).
    unfold reach_of_rows. rewrite plus_ok, !times_ok, row_slop_is.
    assert (Nr : near 5 (val (rho to)) Rho Rho).
    { split; [rewrite Rabs_pos_eq; lra|]. apply Rabs_le. lra. }
    assert (B960 : bpow radix2 (-960) <= / 1000000) by
      (apply Rle_trans with (bpow radix2 (-20)); [apply bpow_le; lia|change (bpow radix2 (-20)) with (/ 1048576); lra]).
    pose proof (near_times _ _ _ _ _ _ _ _ (SL_near _ _ _ _ A) Nr ltac:(lra) ltac:(lra)) as N1.
    specialize (N1 ltac:(right; nra)).
    pose proof (near_times _ _ _ _ _ _ _ _ N1 (A_near _ _ _ _ A) ltac:(lra) ltac:(lra)) as N2.
    specialize (N2 ltac:(right; assert (/ 65536 <= SL * Rho) by nra; nra)).
    assert (E : SL * Rho * / V2 = Reach) by (unfold reach; rewrite area_V2; reflexivity).
    rewrite E in N2. assert (RB : 0 <= Reach <= 98304).
    { rewrite <- E. assert (0 <= SL * / V2) by nra. split; [nra|].
      replace (SL * Rho * / V2) with (SL * / V2 * Rho) by ring. nra. }
    destruct N2 as [_ N2]. apply Rabs_le_inv in N2. set (g := nearest64 (nearest64 (val (S_L to) * val (rho to)) * val (inverse_A to))) in *.
    assert (g_64 : binary64 g) by apply round_64.
    assert (slop_64 : binary64 (/ 268435456)).
    { change (/ 268435456) with (bpow radix2 (-28)). apply generic_format_bpow. unfold FLT_exp. lia. }
    assert (g_range : - / 7500000000 <= g - Reach <= / 7500000000).
    { assert (121 / 10 * u * Reach <= / 7500000000) by lra. lra. }
    pose proof (round_size_sum _ _ slop_64 g_64 ltac:(lra)) as R. set (w := nearest64 (/ 268435456 + g)) in *.
    split; [lra|]. split; [exact RB|apply round_64].
  Qed.

  Lemma integer_64 n : (Z.abs n <= 2 ^ 53)%Z -> binary64 (IZR n).
  Proof using. intros H. rewrite <- (Rmult_1_r (IZR n)). apply (on_grid n 0); [lia|exact H]. Qed.
  Lemma ceiling_below a b n : Rabs (val a - val b) <= 9007199254740992 -> val a - val b <= IZR n ->
    (ceiling (minus a b) <= n)%Z.
  Proof using.
    intros B H. rewrite ceiling_ok, minus_ok. set (x := val a - val b) in *. apply Rabs_le_inv in B.
    assert (C : (Zceil x <= n)%Z) by (apply Zceil_glb, H). apply Z.le_trans with (2 := C).
    apply Zceil_glb. apply round_below; [|apply Zceil_ub]. apply integer_64.
    assert (U : (Zceil x <= 2 ^ 53)%Z) by (apply Zceil_glb; change (IZR (2 ^ 53)) with 9007199254740992; lra).
    assert (L : (- 2 ^ 53 <= Zceil x)%Z).
    { apply le_IZR. apply Rle_trans with x; [|apply Zceil_ub]. change (IZR (- 2 ^ 53)) with (-9007199254740992). lra. }
    lia.
  Qed.
  Notation first_n := (ceiling (minus (row_beside_start to here) (reach_of_rows to))).
  Lemma first_row_holds : first_row_known to here SR SL Y S Rho.
  Proof.
    intros n m H. destruct row_number_known as (E & B & _). destruct reach_known as (R & RB & _).
    pose proof all_facts as A. pose proof shares as (_ & _ & _ & _ & PR & _). destruct rho_range as (_ & _ & RR).
    pose proof (first_row DR DL SR SL Y S Rho PR (proj1 (DL_range _ _ _ _ A)) (proj1 (SR_range _ _ _ _ A))
      ltac:(pose proof (SL_range _ _ _ _ A); lra) ltac:(lra) n m H) as F.
    apply Rabs_le_inv in E, B. apply ceiling_below; [apply Rabs_le; lra|lra].
  Qed.
  Lemma first_n_range : -229400 <= IZR first_n <= 229400.
  Proof.
    destruct row_number_known as (E & B & nu_64). destruct reach_known as (R & RB & re_64).
    apply Rabs_le_inv in E, B. rewrite ceiling_ok, minus_ok.
    pose proof (round_difference _ _ nu_64 re_64) as D.
    set (a := val (row_beside_start to here)) in *. set (b := val (reach_of_rows to)) in *.
    assert (T : Rabs (a - b) <= 229391) by (apply Rabs_le; lra). apply Rabs_le_inv in D.
    pose proof (Rabs_le_inv _ _ T). pose proof (Zceil_ub (nearest64 (a - b))) as C1. pose proof (Zceil_lb (nearest64 (a - b))) as C2. lra.
  Qed.
  Lemma row_range n : (first_n <= n <= first_n + Z.of_nat max_rows)%Z -> Rabs (IZR n) <= 229464 /\ binary64 (IZR n).
  Proof.
    intros [L U]. pose proof first_n_range as F. apply IZR_le in L, U. rewrite plus_IZR in U.
    change (IZR (Z.of_nat max_rows)) with 64 in U.
    assert (B : -229464 <= IZR n <= 229464) by lra. split; [apply Rabs_le; exact B|].
    destruct B as [B1 B2]. apply le_IZR in B1, B2. apply integer_64. lia.
  Qed.
  Lemma last_row_holds : last_row_known to here SR SL Y S Rho.
  Proof.
    intros n Hn. destruct (row_range n Hn) as [Bn n_64].
    destruct row_number_known as (E & B & nu_64). destruct reach_known as (R & RB & re_64).
    pose proof all_facts as A. pose proof shares as (HSL & Hsig & HSR & H4 & PR & H8).
    pose proof (round_sum _ _ nu_64 re_64) as D.
    set (a := val (row_beside_start to here)) in *. set (b := val (reach_of_rows to)) in *.
    apply Rabs_le_inv in E, B.
    assert (T : Rabs (a + b) <= 229400) by (apply Rabs_le; lra). apply Rabs_le_inv in D.
    pose proof (Rabs_le_inv _ _ T). assert (D' : a + b - / 30000000000 <= nearest64 (a + b)).
    { assert (u * Rabs (a + b) <= / 30000000000); [|lra]. lra. }
    clear D. unfold is_beyond_last. split.
    - destruct (rises to); [intros X; discriminate X|]. intros X. apply below_true in X.
      rewrite plus_ok, val_whole in X. fold a b in X. lra.
    - intros n' m' Hn' Ah. destruct (row_range n' Hn') as [Bn' _]. rewrite (rises_is _ _ _ _ A).
      cbn [found_s]. destruct (below_cases (whole 0) (D_L to)) as [[-> PL]|[-> PL]]; rewrite val_whole in PL.
      2: { intros X. apply below_true in X. rewrite plus_ok, val_whole in X. fold a b in X.
        assert (DL0 : DL = 0) by (pose proof (DL_range _ _ _ _ A); lra). rewrite DL0 at 3. unfold Rdiv.
        rewrite Rmult_0_l, Rmult_0_r. lra. }
      intros X. apply below_true in X. rewrite plus_ok, times_ok, plus_ok, val_whole in X. fold a b in X.
      assert (X' : nearest64 (a + b) + nearest64 (val (sum_along to here n' m') * val (slope_of_rows to)) < IZR n).
      { apply Rnot_le_lt. intros N. apply (round_above _ _ n_64) in N. lra. }
      clear X. rewrite area_V2. set (P := position_at n' m') in *.
      assert (Pp : 0 < P) by apply Ah.
      set (sg := DL * / V2) in *. change (DL / V2) with sg.
      destruct (position_known n' m') as (Ex & Ez & _ & _ & EP & _ & P_64). fold P in EP.
      set (x := nearest64 (IZR n' * val (S_R to))) in *. set (z := nearest64 (IZR m' * val (S_L to))) in *.
      set (Pc := val (sum_along to here n' m')) in *.
      (* the slope *)
      pose proof (near_exact DL) as NL. rewrite Rabs_pos_eq in NL by lra.
      pose proof (near_times _ _ _ _ _ _ _ _ NL (A_near _ _ _ _ A) ltac:(lra) ltac:(lra)) as NS.
      assert (L502 : bpow radix2 (-502) <= DL).
      { destruct (level_or_not v0 v1 r v0_64 v1_64 v0_range v1_range v1_zero_or r_range to direction_set); lra. }
      assert (B960 : bpow radix2 (-960) <= DL * / V2).
      { apply Rle_trans with (bpow radix2 (-502) * bpow radix2 (-3)).
        - rewrite <- bpow_plus. apply bpow_le. lia.
        - apply Rmult_le_compat; try apply bpow_ge_0; [exact L502|]. exact H8. }
      specialize (NS ltac:(right; exact B960)). fold sg in NS.
      assert (Esl : val (slope_of_rows to) = nearest64 (DL * val (inverse_A to)))
        by (unfold slope_of_rows; rewrite times_ok; reflexivity).
      rewrite <- Esl in NS. destruct NS as [_ NS]. set (sl := val (slope_of_rows to)) in *.
      (* in units of rows *)
      assert (sgp : 0 < sg) by (unfold sg; apply Rmult_lt_0_compat; lra).
      pose proof (Rabs_pos x) as Px. pose proof (Rabs_pos z) as Pz. pose proof (SR_range _ _ _ _ A) as RSR.
      pose proof (SL_range _ _ _ _ A) as RSL. destruct rho_range as (_ & _ & RR).
      destruct s_is as (_ & _ & TS & _ & _ & _ & Zs & s1 & _).
      assert (size_pos : 0 <= size) by (pose proof K_small; destruct Zs; lra).
      assert (PsgB : P * sg <= 460000).
      { pose proof (row_of DR DL SR SL Y S PR (proj1 (DL_range _ _ _ _ A)) (proj1 RSR) ltac:(lra) n' m') as RO.
        rewrite area_V2 in RO. fold P in RO. destruct Ah as [Hs _]. unfold Rows.in_strip in Hs. apply Rabs_def2 in Hs.
        assert (ES : SL * Rho * / V2 = Reach) by (unfold reach; rewrite area_V2; reflexivity).
        assert (HB : - Reach <= SL * height_at n' m' * / V2).
        { rewrite <- ES. assert (Q : 0 <= SL * / V2) by (apply Rmult_le_pos; lra).
          replace (SL * height_at n' m' * / V2) with (SL * / V2 * height_at n' m') by ring.
          replace (- (SL * Rho * / V2)) with (SL * / V2 * - Rho) by ring. apply Rmult_le_compat_l; lra. }
        apply Rabs_le_inv in Bn'. unfold Rdiv in RO. rewrite Rmult_plus_distr_r in RO.
        replace (P * sg) with (DL * P * / V2) by (unfold sg; ring). lra. }
      assert (XB : Rabs x * sg <= 230000).
      { assert (X1 : Rabs x <= 1001 / 1000 * (Rabs (IZR n') * SR)).
        { assert (HX : Rabs x <= Rabs (IZR n' * SR) + Rabs (x - IZR n' * SR)).
          { replace x with (IZR n' * SR + (x - IZR n' * SR)) at 1 by ring. apply Rabs_triang. }
          rewrite (Rabs_mult (IZR n')), (Rabs_pos_eq SR) in HX by lra. lra. }
        pose proof (Rabs_pos (IZR n')). apply Rmult_le_compat_r with (r := sg) in X1; [|lra].
        replace (1001 / 1000 * (Rabs (IZR n') * SR) * sg) with (1001 / 1000 * Rabs (IZR n') * (SR * sg)) in X1 by ring.
        assert (0 <= SR * sg) by nra. nra. }
      assert (ZB : Rabs z * sg <= 700000).
      { assert (Z1 : Rabs z <= 1001 / 1000 * (P + 2 + Rabs (IZR n') * SR)).
        { assert (Rabs z <= Rabs (IZR m' * SL) + Rabs (z - IZR m' * SL)).
          { replace z with (IZR m' * SL + (z - IZR m' * SL)) at 1 by ring. apply Rabs_triang. }
          assert (Rabs (IZR m' * SL) <= P + 2 + Rabs (IZR n') * SR); [|lra].
          replace (IZR m' * SL) with (P + (- S + - (IZR n' * SR))) by (unfold P, Rows.position_at; ring).
          apply Rle_trans with (1 := Rabs_triang _ _). rewrite (Rabs_pos_eq P) by lra.
          pose proof (Rabs_triang (- S) (- (IZR n' * SR))) as K1. rewrite !Rabs_Ropp in K1.
          rewrite (Rabs_mult (IZR n')), (Rabs_pos_eq SR) in K1 by lra. lra. }
        pose proof (Rabs_pos (IZR n')). apply Rmult_le_compat_r with (r := sg) in Z1; [|lra].
        replace (1001 / 1000 * (P + 2 + Rabs (IZR n') * SR) * sg) with
          (1001 / 1000 * (P * sg + 2 * sg + Rabs (IZR n') * (SR * sg))) in Z1 by ring.
        assert (0 <= SR * sg) by nra. assert (Rabs (IZR n') * (SR * sg) <= 229464) by nra. lra. }
      (* the product errs by little *)
      assert (DP : Rabs (Pc - P) * sg <= / 1000000000 * 8 / 10).
      { apply Rmult_le_compat_r with (r := sg) in EP; [|lra].
        replace ((79 / 10 * u * size + 7 * u * (Rabs x + Rabs z)) * sg) with
          (79 / 10 * u * (size * sg) + 7 * u * (Rabs x * sg + Rabs z * sg)) in EP by ring.
        assert (size * sg <= 1) by (rewrite <- (Rmult_1_l 1); apply Rmult_le_compat; lra). lra. }
      assert (Slr : 0 <= sl <= 2 * sg) by (apply Rabs_le_inv in NS; split; lra).
      assert (PsgP : 0 <= P * sg) by (apply Rmult_le_pos; lra).
      assert (DQ : Rabs (Pc * sl - P * sg) <= / 1000000000 * 83 / 100 + / 1000000000 * 21 / 100).
      { replace (Pc * sl - P * sg) with ((Pc - P) * sg + ((Pc - P) * (sl - sg) + P * (sl - sg))) by ring.
        apply Rle_trans with (1 := Rabs_triang _ _).
        pose proof (Rabs_triang ((Pc - P) * (sl - sg)) (P * (sl - sg))) as K1. rewrite !Rabs_mult in *.
        rewrite (Rabs_pos_eq P) in K1 by lra. rewrite (Rabs_pos_eq sg) by lra.
        assert (N1 : Rabs (Pc - P) * Rabs (sl - sg) <= / 1000000 * (Rabs (Pc - P) * sg)).
        { pose proof (Rabs_pos (Pc - P)).
          apply Rle_trans with (Rabs (Pc - P) * ((0 + 303 / 100 + 101 / 100) * u * sg));
            [apply Rmult_le_compat_l; auto|].
          assert (0 <= Rabs (Pc - P) * sg) by (apply Rmult_le_pos; lra).
          replace (Rabs (Pc - P) * ((0 + 303 / 100 + 101 / 100) * u * sg)) with
            (404 / 100 * u * (Rabs (Pc - P) * sg)) by lra. lra. }
        assert (N2 : P * Rabs (sl - sg) <= 405 / 100 * u * (P * sg)).
        { apply Rle_trans with (P * ((0 + 303 / 100 + 101 / 100) * u * sg)); [apply Rmult_le_compat_l; lra|].
          replace (P * ((0 + 303 / 100 + 101 / 100) * u * sg)) with (404 / 100 * u * (P * sg)) by lra. lra. }
        lra. }
      pose proof (round_any (Pc * sl)) as RQ. pose proof eta_tiny as He.
      assert (QB : Rabs (Pc * sl) <= 460001).
      { replace (Pc * sl) with (P * sg + (Pc * sl - P * sg)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
        rewrite (Rabs_pos_eq (P * sg)) by exact PsgP. lra. }
      apply Rabs_le_inv in DQ, RQ. lra.
  Qed.
  (* ---- Where a row starts. *)
  Lemma slop_is : val slop = / 1073741824.
  Proof using. unfold slop. rewrite val_power. reflexivity. Qed.
  Lemma row_entry_is : val row_entry = 16 * u.
  Proof using. unfold row_entry. rewrite val_power. change (bpow radix2 (-49)) with (/ 562949953421312). lra. Qed.
  Lemma passing_known n : Rabs (IZR n) <= 229464 ->
    Rabs (val (passing_of_row to here n) - - (S + IZR n * SR) * / SL) <= / 4000000000 /\
    Rabs (val (passing_of_row to here n)) <= 230000.
  Proof.
    intros Bn. pose proof all_facts as A. destruct s_is as (Es & Ts & TS & s_64 & se_64 & Ls & Zs & s1 & Ps).
    pose proof (SR_range _ _ _ _ A) as RSR. pose proof (SL_range _ _ _ _ A) as RSL.
    pose proof (SR_zero_or _ _ _ _ A) as ZR. pose proof K_small as KS. pose proof (Rabs_pos (IZR n)) as Pn.
    assert (size_pos : 0 <= size) by (destruct Zs; lra).
    unfold passing_of_row. rewrite times_ok, val_neg, plus_ok, times_ok, val_whole.
    assert (Ns : near (303 / 100) (val (s here)) S 2) by (split; lra).
    pose proof (near_times _ _ _ _ _ _ _ _ (near_exact (IZR n)) (SR_near _ _ _ _ A) ltac:(lra) ltac:(lra)) as Nx.
    assert (Zx : Rabs (IZR n) * SR = 0 \/ bpow radix2 (-960) <= Rabs (IZR n) * SR).
    { destruct (Z.eq_dec n 0) as [->|N]; [left; rewrite Rabs_R0; ring|].
      destruct ZR as [->|ZR]; [left; ring|right]. rewrite Rabs_pos_eq in ZR by lra.
      assert (1 <= Rabs (IZR n)) by (rewrite <- abs_IZR; apply (IZR_le 1); lia).
      apply Rle_trans with K; [apply bpow_le; lia|]. rewrite <- (Rmult_1_l K). apply Rmult_le_compat; lra. }
    specialize (Nx Zx). apply near_weaken with (k' := 303 / 100) (T' := Rabs (IZR n) * SR) in Nx; [|lra|lra].
    pose proof (near_plus _ _ _ _ _ _ _ Ns Nx ltac:(lra) s_64 (round_64 _)) as Nc. apply near_opp in Nc.
    pose proof (near_times _ _ _ _ _ _ _ _ Nc (inverse_S_near _ _ _ _ A) ltac:(lra) ltac:(lra)) as Np.
    assert (iSL : 0 < / SL <= 1).
    { split; [apply Rinv_0_lt_compat; lra|]. rewrite <- Rinv_1. apply Rinv_le; lra. }
    assert (SRi : 0 <= SR * / SL <= 1).
    { assert (SL * / SL = 1) by (field; lra). split; [apply Rmult_le_pos; lra|].
      apply Rle_trans with (SL * / SL); [apply Rmult_le_compat_r; lra|lra]. }
    assert (TB : 0 <= (2 + Rabs (IZR n) * SR) * / SL <= 229466).
    { replace ((2 + Rabs (IZR n) * SR) * / SL) with (2 * / SL + Rabs (IZR n) * (SR * / SL)) by ring.
      assert (0 <= Rabs (IZR n) * (SR * / SL)) by (apply Rmult_le_pos; lra).
      assert (Rabs (IZR n) * (SR * / SL) <= 229464 * 1) by (apply Rmult_le_compat; lra). lra. }
    assert (iS8 : bpow radix2 (-20) <= / SL).
    { destruct shares as (H1 & _ & _ & H4 & _ & H8). apply Rmult_le_compat_r with (r := V2) in H1;
        [|pose proof (V2_range v0 v1 v0_range v1_range); lra].
      pose proof (V2_range v0 v1 v0_range v1_range) as RV.
      replace (SL * / V2 * V2) with SL in H1 by (field; lra).
      apply Rle_trans with (/ 524288); [change (bpow radix2 (-20)) with (/ 1048576); lra|]. apply Rinv_le; lra. }
    specialize (Np ltac:(right; apply Rle_trans with (bpow radix2 (-20)); [apply bpow_le; lia|];
      apply Rle_trans with (1 * / SL); [lra|]; apply Rmult_le_compat_r; [lra|];
      assert (0 <= Rabs (IZR n) * SR) by (apply Rmult_le_pos; lra); lra)).
    destruct Np as [M1 M2]. set (t := (2 + Rabs (IZR n) * SR) * / SL) in *.
    assert (E : Rabs (nearest64 (- nearest64 (val (s here) + nearest64 (IZR n * val (S_R to))) * val (inverse_S_L to)) -
      - (S + IZR n * SR) * / SL) <= / 4000000000) by lra.
    split; [exact E|]. set (w := nearest64 (- nearest64 _ * _)) in *. set (w0 := - (S + IZR n * SR) * / SL) in *.
    replace w with (w0 + (w - w0)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra.
  Qed.
  (* What the number at which a row enters the strip may be too large by is allowed for. *)
  Lemma entry_known n : 0 < DL -> let nD := times (whole n) (D_R to) in let y_n := plus (y here) nD in
    let terms := plus (plus (size_of y_n) (size_of nD)) (rho to) in
    let more := times (plus (times row_entry terms) (y_error here)) (inverse_D_L to) in
    let entry := times (minus y_n (rho to)) (inverse_D_L to) in
    val entry - val more <= (Y + IZR n * DR - Rho) / DL + / 1000000000000 /\ 0 <= val more /\ binary64 (val more) /\
    (val more <= 1 -> Rabs (val entry) <= 2251799813685248).
  Proof.
    intros PL nD y_n terms more entry. pose proof all_facts as A.
    destruct y_is as (Ey & Ry & y_64 & ye_64 & TY & _). destruct rho_range as (Rr & rho_64 & RR).
    destruct F_facts as [HF HFe]. pose proof eta_tiny as He.
    unfold entry, more, terms, y_n, nD. rewrite !times_ok, minus_ok, !plus_ok, !times_ok, !plus_ok, !val_size,
      !plus_ok, !times_ok, val_whole, row_entry_is.
    pose proof (round_back (IZR n * DR)) as Ra. set (b := IZR n * DR) in *.
    assert (a_64 : binary64 (nearest64 b)) by apply round_64. set (a := nearest64 b) in *.
    set (yv := val (y here)) in *. set (ye := val (y_error here)) in *. set (rh := val (rho to)) in *.
    pose proof (round_sum yv a y_64 a_64) as Rc. assert (c_64 : binary64 (nearest64 (yv + a))) by apply round_64.
    set (c := nearest64 (yv + a)) in *.
    pose proof (round_difference c rh c_64 rho_64) as Rg. set (g := nearest64 (c - rh)) in *.
    pose proof (Rabs_pos a) as Pa. pose proof (Rabs_pos c) as Pc.
    pose proof (round_size_sum _ _ (abs_64 _ c_64) (abs_64 _ a_64) ltac:(lra)) as T1.
    assert (t1_64 : binary64 (nearest64 (Rabs c + Rabs a))) by apply round_64.
    set (t1 := nearest64 (Rabs c + Rabs a)) in *.
    pose proof (round_size_sum _ _ t1_64 rho_64 ltac:(lra)) as T2. set (t2 := nearest64 (t1 + rh)) in *.
    pose proof (round_size (16 * u * t2) ltac:(lra)) as T3.
    assert (t3_64 : binary64 (nearest64 (16 * u * t2))) by apply round_64.
    pose proof (round_nonneg (16 * u * t2) ltac:(lra)) as P3. set (t3 := nearest64 (16 * u * t2)) in *.
    pose proof (round_size_sum _ _ t3_64 ye_64 ltac:(lra)) as T4. set (t4 := nearest64 (t3 + ye)) in *.
    set (T := Rabs c + Rabs a + rh).
    assert (Yc : Rabs (yv + a) <= (1 + 2 * u) * Rabs c).
    { assert (Rabs (yv + a) <= Rabs c + Rabs (c - (yv + a))); [|lra].
      replace (yv + a) with (c - (c - (yv + a))) at 1 by ring. apply Rle_trans with (1 := Rabs_triang _ _).
      rewrite Rabs_Ropp. lra. }
    assert (Cr : Rabs (c - rh) <= Rabs c + rh).
    { apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp, (Rabs_pos_eq rh) by lra. lra. }
    assert (Gs : Rabs g <= (1 + u) * T).
    { replace g with ((c - rh) + (g - (c - rh))) by ring. apply Rle_trans with (1 := Rabs_triang _ _). unfold T. lra. }
    assert (G : g <= Y + b - Rho + ye + 63 / 10 * u * T).
    { apply Rabs_le_inv in Rg, Rc, Ra, Ey. unfold T. lra. }
    destruct (inverse_L_near _ _ _ _ A PL) as [_ NI].
    pose proof (Rinv_0_lt_compat _ PL) as Pi. set (j := val (inverse_D_L to)) in *. set (i := / DL) in *.
    apply Rabs_le_inv in NI.
    assert (J : (1 - 102 / 100 * u) * i <= j <= (1 + 102 / 100 * u) * i) by (split; lra).
    assert (Pj : 0 <= j) by lra.
    assert (PT : 0 <= T) by (unfold T; lra).
    (* the product with the inverse *)
    assert (GJ : Rabs (g * j - g * i) <= 103 / 100 * u * (T * i)).
    { rewrite <- Rmult_minus_distr_l, Rabs_mult. assert (Rabs (j - i) <= 102 / 100 * u * i) by (apply Rabs_le; lra).
      apply Rle_trans with ((1 + u) * T * (102 / 100 * u * i)).
      - apply Rmult_le_compat; auto using Rabs_pos.
      - assert (0 <= T * i) by (apply Rmult_le_pos; lra).
        replace ((1 + u) * T * (102 / 100 * u * i)) with ((1 + u) * (102 / 100 * u) * (T * i)) by ring. lra. }
    assert (Ti : 0 <= T * i) by (apply Rmult_le_pos; lra).
    assert (GI : Rabs (g * i) <= (1 + u) * (T * i)).
    { rewrite Rabs_mult, (Rabs_pos_eq i) by lra. rewrite <- Rmult_assoc. apply Rmult_le_compat_r; lra. }
    assert (GJs : Rabs (g * j) <= 1001 / 1000 * (T * i)).
    { replace (g * j) with (g * i + (g * j - g * i)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
    pose proof (round_any (g * j)) as Re. set (e := nearest64 (g * j)) in *.
    assert (Gi : g * i <= (Y + b - Rho) * i + ye * i + 63 / 10 * u * (T * i)).
    { replace ((Y + b - Rho) * i + ye * i + 63 / 10 * u * (T * i)) with
        ((Y + b - Rho + ye + 63 / 10 * u * T) * i) by ring. apply Rmult_le_compat_r; lra. }
    assert (P4 : 0 <= t4) by (apply round_nonneg; lra).
    pose proof (round_size (t4 * j) ltac:(apply Rmult_le_pos; lra)) as Rm.
    pose proof (round_nonneg (t4 * j) ltac:(apply Rmult_le_pos; lra)) as Pm. set (w := nearest64 (t4 * j)) in *.
    assert (M4 : (1 - 5 * u) * (16 * u * T + ye) - 2 * eta <= t4) by (unfold T; lra).
    assert (M5 : (1 - 5 * u) * (16 * u * T + ye) - 2 * eta <= t4 /\ 15 * u * T + ye <= t4) by (unfold T in *; split; lra).
    destruct M5 as [_ M5].
    assert (W : (1 - 4 * u) * (15 * u * (T * i) + ye * i) <= t4 * j).
    { apply Rle_trans with ((15 * u * T + ye) * ((1 - 102 / 100 * u) * i)).
      - assert (0 <= ye * i) by (apply Rmult_le_pos; lra).
        replace ((15 * u * T + ye) * ((1 - 102 / 100 * u) * i)) with
          ((1 - 102 / 100 * u) * (15 * u * (T * i) + ye * i)) by ring. lra.
      - apply Rmult_le_compat; lra. }
    assert (Yi : 0 <= ye * i <= / 10 * (T * i)).
    { split; [apply Rmult_le_pos; lra|]. rewrite <- Rmult_assoc. apply Rmult_le_compat_r; unfold T; lra. }
    apply Rabs_le_inv in GJ as GJ'. split; [|split; [exact Pm|split; [apply round_64|]]].
    - unfold Rdiv. fold i. apply Rabs_le_inv in Re.
      assert (u * Rabs (g * j) <= 1001 / 1000 * u * (T * i)) by lra.
      assert (Y6 : 6 * u * (ye * i) <= / 10 * u * (T * i) * 6) by lra. lra.
    - intros M1. assert (TB : T * i <= 14 / 10 * 9007199254740992 / 14) by lra.
      replace e with (g * j + (e - g * j)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra.
  Qed.
  Lemma starts_hold : starts_known to here SR SL Y S Rho.
  Proof.
    intros n m Hn Ah. destruct (row_range n Hn) as [Bn n_64]. pose proof all_facts as A.
    destruct (passing_known n Bn) as [Ep Bp]. pose proof (SL_range _ _ _ _ A) as RSL.
    pose proof (where_row_starts SR SL S ltac:(lra) n m (proj2 Ah)) as Mp. unfold Rdiv in Mp.
    apply Rabs_le_inv in Ep. unfold start_of_row. rewrite (rises_is _ _ _ _ A).
    destruct (below_cases (whole 0) (D_L to)) as [[-> PL]|[-> PL]]; rewrite val_whole in PL.
    - destruct (entry_known n PL) as (E1 & E2 & E3 & E4). cbv zeta in E1, E2, E3, E4. intros X.
      apply below_false in X.
      pose proof (where_row_enters DR DL Y Rho n m PL (proj1 Ah)) as Me.
      set (more := times (plus (times row_entry _) _) _) in *. set (entry := times (minus _ _) (inverse_D_L to)) in *.
      rewrite plus_ok, slop_is in X.
      assert (slop_64 : binary64 (/ 1073741824)).
      { change (/ 1073741824) with (bpow radix2 (-30)). apply generic_format_bpow. unfold FLT_exp. lia. }
      pose proof (round_size_sum _ _ slop_64 E3 ltac:(lra)) as R.
      assert (X' : val max_unsure = / 4) by (unfold max_unsure; rewrite val_power; reflexivity). rewrite X' in X.
      specialize (E4 ltac:(lra)). apply Rabs_le_inv in E4, Bp.
      apply ceiling_below; rewrite plus_ok, slop_is, val_larger; set (q := nearest64 (/ 1073741824 + val more)) in *.
      + apply Rabs_le. unfold Rmax. destruct (Rle_dec _ _); lra.
      + unfold Rmax. destruct (Rle_dec _ _); lra.
    - intros _. apply Rabs_le_inv in Bp. apply ceiling_below; rewrite slop_is; [apply Rabs_le; lra|lra].
  Qed.
End Known.
