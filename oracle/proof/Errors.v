(* docs/bounds.md, "Radius", and what a direction has before any start is known. *)
From Coq Require Import ZArith Reals Lra Lia Psatz Bool.
From Flocq Require Import Core Plus_error Mult_error.
From Lorentz Require Import Spec Doubles Euclid Rows Model Certain Roundings.
Local Open Scope R_scope.

Ltac absolute x := pose proof (Rle_abs x); pose proof (Rle_abs (- x)); rewrite (Rabs_Ropp x) in *;
  pose proof (Rabs_pos x).
Ltac binary := repeat first [assumption | apply round_64].

Notation K := (bpow radix2 (-450)).  (* what is neither zero nor tiny is at least *)
Definition zero_or (x : R) : Prop := x = 0 \/ K <= Rabs x.
Lemma K_small : 0 < K <= / 1000000.
Proof.
  split; [apply bpow_gt_0|]. apply Rle_trans with (bpow radix2 (-20)); [apply bpow_le; lia|].
  change (bpow radix2 (-20)) with (/ 1048576). lra.
Qed.
Lemma product_zero_or x y : zero_or x -> zero_or y ->
  Rabs x * Rabs y = 0 \/ bpow radix2 (-960) <= Rabs x * Rabs y.
Proof.
  intros [->|Hx]; [left; rewrite Rabs_R0; ring|]. intros [->|Hy]; [left; rewrite Rabs_R0; ring|]. right.
  apply Rle_trans with (K * K); [rewrite <- bpow_plus; apply bpow_le; lia|].
  apply Rmult_le_compat; auto; apply bpow_ge_0.
Qed.
Lemma near_product x y : zero_or x -> zero_or y -> near (101 / 100) (nearest64 (x * y)) (x * y) (Rabs x * Rabs y).
Proof.
  intros Hx Hy. replace (101 / 100) with (0 + 0 + 101 / 100) by ring.
  apply near_times; auto using near_exact, product_zero_or; lra.
Qed.
(* The product and what it leaves are exact together. *)
Lemma exact_product x y : binary64 x -> binary64 y -> zero_or x -> zero_or y -> let p := nearest64 (x * y) in
  nearest64 (x * y - p) = x * y - p /\ Rabs (p - x * y) <= u * (Rabs x * Rabs y).
Proof.
  intros Fx Fy Hx Hy p. pose proof (product_zero_or x y Hx Hy) as Z.
  rewrite <- Rabs_mult in *. split.
  - apply rounded_is. replace (x * y - p) with (- (p - x * y)) by ring. apply generic_format_opp.
    apply mult_error_FLT; auto using digits_53. { apply valid_rnd_N. }
    intros N. destruct Z as [Z|Z]; [apply Rabs_eq_R0 in Z; contradiction|].
    apply Rle_trans with (2 := Z). apply bpow_le. lia.
  - destruct Z as [Z|Z].
    + assert (E : x * y = 0) by (apply Rabs_eq_R0, Z). unfold p. rewrite E, nearest64_0.
      rewrite Rminus_diag_eq by reflexivity. rewrite Rabs_R0. lra.
    + apply round_normal. apply Rle_trans with (2 := Z). apply bpow_le. lia.
Qed.
Lemma exact_sum x y : binary64 x -> binary64 y -> let p := nearest64 (x + y) in
  nearest64 (x + y - p) = x + y - p.
Proof.
  intros Fx Fy p. apply rounded_is. replace (x + y - p) with (- (p - (x + y))) by ring.
  apply generic_format_opp, plus_error; auto; [apply FLT_exp_valid, digits_53|apply FLT_exp_monotone].
Qed.

(* ---- The direction. *)
Section Direction.
  Local Opaque plus minus times over root rounded below at_most floor euclid max_coefficient.
  Variables (v0 v1 r : num).
  Notation V0 := (val v0).
  Notation V1 := (val v1).
  Hypothesis v0_64 : binary64 V0.
  Hypothesis v1_64 : binary64 V1.
  Hypothesis r_64 : binary64 (val r).
  Hypothesis v0_range : 1 <= V0 < 2.
  Hypothesis v1_range : 0 <= V1 <= V0.
  Hypothesis v1_zero_or : zero_or V1.
  Hypothesis r_range : / 65536 <= val r <= / 2.

  Definition V2 : R := V0 * V0 + V1 * V1.
  Definition Rho : R := val r * sqrt V2.
  Lemma V2_range : 1 <= V2 < 8.
  Proof. unfold V2. split; nra. Qed.
  Lemma speed_range : 1 <= sqrt V2 < 3.
  Proof.
    pose proof V2_range. split.
    - rewrite <- sqrt_1. apply sqrt_le_1_alt. lra.
    - replace 3 with (sqrt (3 * 3)) by (apply sqrt_square; lra). apply sqrt_lt_1_alt. lra.
  Qed.
  Lemma Rho_range : / 65536 <= Rho < 3 / 2.
  Proof. pose proof speed_range. unfold Rho. split; nra. Qed.
  Lemma v0_zero_or : zero_or V0.
  Proof. right. pose proof K_small. rewrite Rabs_pos_eq by lra. lra. Qed.

  Notation v2 := (sum_of_products v0 v0 v1 v1).
  Lemma val_sum_of_products a b c d : val (sum_of_products a b c d) =
    nearest64 (nearest64 (val a * val b) + nearest64 (val c * val d)).
  Proof using. unfold sum_of_products. rewrite plus_ok, !times_ok. reflexivity. Qed.
  Lemma v2_near : near (202 / 100) (val v2) V2 V2.
  Proof.
    rewrite val_sum_of_products. unfold V2.
    pose proof (near_product V0 V0 v0_zero_or v0_zero_or) as A.
    pose proof (near_product V1 V1 v1_zero_or v1_zero_or) as B.
    rewrite (Rabs_pos_eq V0) in A by lra. rewrite (Rabs_pos_eq V1) in B by lra.
    replace (202 / 100) with (101 / 100 + 101 / 100) by lra. apply near_plus; binary; lra.
  Qed.
  Definition rho_of : num := times r (root v2).
  Lemma rho_near : near (404 / 100) (val rho_of) Rho Rho.
  Proof.
    unfold rho_of, Rho. pose proof V2_range as HV. pose proof speed_range as HS. rewrite times_ok.
    rewrite root_ok.
    - pose proof (near_root (202 / 100) (val v2) V2 v2_near ltac:(lra) ltac:(lra)) as A.
      pose proof (near_exact (val r)) as B. rewrite (Rabs_pos_eq (val r)) in B by lra.
      replace (404 / 100) with (0 + (202 / 100 + 101 / 100) + 101 / 100) by lra.
      apply near_times; auto; try lra. right. apply Rle_trans with (/ 65536).
      + apply (bpow_le radix2 (-960) (-16)). lia.
      + nra.
    - destruct v2_near as [_ A]. apply Rabs_le_inv in A. lra.
  Qed.
  Definition passable_of : num := times (times (whole 2) rho_of) less_than_one.
  Lemma rho_of_range : (1 - 5 * u) * Rho <= val rho_of <= (1 + 5 * u) * Rho.
  Proof. destruct rho_near as [_ A]. pose proof Rho_range. apply Rabs_le_inv in A. split; nra. Qed.
  Lemma eta_tiny : 0 < eta <= / 1000000000000 * u.
  Proof.
    split; [apply eta_positive|]. apply Rle_trans with (bpow radix2 (-93)); [apply eta_below; lia|].
    rewrite <- u_is. replace (-93)%Z with (-40 + -53)%Z by lia. rewrite bpow_plus.
    apply Rmult_le_compat_r; [apply bpow_ge_0|]. change (bpow radix2 (-40)) with (/ 1099511627776). lra.
  Qed.
  Lemma passable_range : 199 / 100 * Rho <= val passable_of.
  Proof.
    unfold passable_of. rewrite !times_ok, val_whole. pose proof rho_of_range as A. pose proof Rho_range as B.
    assert (E : val less_than_one = 1 - / 1073741824).
    { unfold val, less_than_one, F2R. cbn [Fnum Fexp]. change (bpow radix2 (-30)) with (/ 1073741824).
      change (IZR (2 ^ 30 - 1)) with 1073741823. lra. }
    rewrite E. pose proof eta_tiny. pose proof (round_size (2 * val rho_of) ltac:(nra)) as C.
    set (a := nearest64 (2 * val rho_of)) in *.
    pose proof (round_size (a * (1 - / 1073741824)) ltac:(nra)) as D. lra.
  Qed.

  Variable to : direction.
  Hypothesis direction_set : set_direction v0 v1 r = Some to.
  Notation DR := (val (D_R to)).
  Notation DL := (val (D_L to)).
  Definition SR : R := along_of V0 V1 (arm_R to).
  Definition SL : R := along_of V0 V1 (arm_L to).

  Lemma set_is : exists R L f, arm_R to = R /\ arm_L to = L /\ is_flipped to = f /\
    holds V0 V1 passable_of R L f /\ 0 <= val (height L) < val passable_of /\
    rho to = rho_of /\ rises to = below (whole 0) (D_L to) /\
    S_R to = along_arm v0 v1 R /\ S_L to = along_arm v0 v1 L /\ inverse_A to = over (whole 1) v2 /\
    inverse_D_L to = over (whole 1) (height L) /\ inverse_S_L to = over (whole 1) (along_arm v0 v1 L).
  Proof.
    pose proof direction_set as E. unfold set_direction in E. cbv zeta in E.
    destruct (euclid _ _ _ _ _) as [[[R L] f]|] eqn:EE;
      [|discriminate E].
    destruct (_ && _) eqn:EC; [|discriminate E].
    injection E as <-. cbn [arm_R arm_L is_flipped rho rises S_R S_L inverse_A inverse_D_L inverse_S_L].
    apply andb_true_iff in EC. destruct EC as [_ EC].
    pose proof passable_range as P. pose proof Rho_range as PR.
    assert (W : V0 < IZR (2 ^ 53) * val passable_of) by (change (IZR (2 ^ 53)) with 9007199254740992; lra).
    destruct (euclid_ok V0 V1 passable_of v1_range ltac:(lra) W max_steps _ _ _ R L f
      (holds_first v0 v1 passable_of v1_range ltac:(lra) v0_64 v1_64) EE) as [H1 H2].
    exists R, L, f. repeat (split; [reflexivity|]). split; [exact H1|].
    destruct (at_most_ok (whole 0) (height L)) as [Le|]; [|discriminate EC]. rewrite val_whole in Le.
    repeat split; auto.
  Qed.

  Record facts : Prop := Facts {
    R_64 : binary64 DR; L_64 : binary64 DL;
    DR_range : / 65536 <= DR < 2; DL_range : 0 <= DL <= DR;
    SR_range : 0 <= SR <= SL; SR_zero_or : zero_or SR; SL_range : 1 <= SL;
    area_is : SR * DL + SL * DR = V2;
    rho_is : rho to = rho_of; rises_is : rises to = below (whole 0) (D_L to);
    SR_near : near (202 / 100) (val (S_R to)) SR SR; SL_near : near (202 / 100) (val (S_L to)) SL SL;
    SR_64 : binary64 (val (S_R to)); SL_64 : binary64 (val (S_L to));
    A_near : near (303 / 100) (val (inverse_A to)) (/ V2) (/ V2);
    inverse_L_near : 0 < DL -> near (101 / 100) (val (inverse_D_L to)) (/ DL) (/ DL);
    inverse_S_near : near (303 / 100) (val (inverse_S_L to)) (/ SL) (/ SL);
    heights_are : basis V0 V1 (arm_R to) (arm_L to) (is_flipped to) }.

  Lemma along_near a : forward a -> near (202 / 100) (val (along_arm v0 v1 a)) (along_of V0 V1 a) (along_of V0 V1 a).
  Proof.
    intros [P0 P1]. unfold along_arm, along_of. rewrite val_sum_of_products, !val_whole.
    apply IZR_le in P0 as Q0. apply IZR_le in P1 as Q1.
    assert (Z : forall n : Z, (0 <= n)%Z -> zero_or (IZR n)).
    { intros n Hn. destruct (Z.eq_dec n 0) as [->|N]; [left; reflexivity|right]. pose proof K_small.
      assert (1 <= IZR n) by (apply (IZR_le 1); lia). rewrite Rabs_pos_eq; lra. }
    pose proof (near_product (IZR (n0 a)) V0 (Z _ P0) v0_zero_or) as A.
    pose proof (near_product (IZR (n1 a)) V1 (Z _ P1) v1_zero_or) as B.
    rewrite (Rabs_pos_eq (IZR (n0 a))), (Rabs_pos_eq V0) in A by lra.
    rewrite (Rabs_pos_eq (IZR (n1 a))), (Rabs_pos_eq V1) in B by lra.
    rewrite (Rmult_comm V0), (Rmult_comm V1).
    replace (202 / 100) with (101 / 100 + 101 / 100) by lra. apply near_plus; binary; lra.
  Qed.
  Lemma large_inverse y : 0 < y <= bpow radix2 960 -> bpow radix2 (-960) <= / y.
  Proof using.
    intros [P H]. replace (bpow radix2 (-960)) with (/ bpow radix2 960) by (rewrite <- bpow_opp; reflexivity).
    apply Rinv_le; assumption.
  Qed.
  Lemma facts_hold : facts.
  Proof.
    destruct set_is as (R & L & f & ER & EL & EF & H & HL & Erho & Erises & ESR & ESL & EA & ED & ES).
    destruct H as (B & FR & FL & PR & PL & SRL & NRL & NL & HR & HLR & HP).
    pose proof passable_range as PP. pose proof Rho_range as RR. pose proof V2_range as RV.
    assert (QL : 1 <= along_of V0 V1 L).
    { unfold along_of. destruct PL as [P0 P1]. apply IZR_le in P1, NL. nra. }
    assert (QR : 0 <= along_of V0 V1 R).
    { unfold along_of. destruct PR as [P0 P1]. apply IZR_le in P0, P1. nra. }
    assert (AR : along_of V0 V1 R * val (height L) + along_of V0 V1 L * val (height R) = V2)
      by (apply (area V0 V1 R L f B)).
    assert (DRl : / 65536 <= val (height R)).
    { destruct HP as [HP|HP]; lra. }
    assert (B960 : 524288 <= bpow radix2 960).
    { change 524288 with (bpow radix2 19). apply bpow_le. lia. }
    rewrite EL in Erises. split; rewrite ?ER, ?EL, ?EF; unfold SR, SL; rewrite ?ER, ?EL; auto; try lra.
    - (* S_R *)
      destruct PR as [P0 P1]. unfold along_of. destruct (Z.eq_dec (n0 R) 0) as [Z0|N0].
      + destruct (Z.eq_dec (n1 R) 0) as [Z1|N1]; [left; rewrite Z0, Z1; ring|].
        destruct v1_zero_or as [Zv|Nv]; [left; rewrite Z0, Zv; ring|right]. rewrite Z0.
        assert (1 <= IZR (n1 R)) by (apply (IZR_le 1); lia). rewrite (Rabs_pos_eq V1) in Nv by lra.
        rewrite Rabs_pos_eq by nra. pose proof K_small. nra.
      + right. assert (1 <= IZR (n0 R)) by (apply (IZR_le 1); lia). apply IZR_le in P1. pose proof K_small.
        rewrite Rabs_pos_eq by nra. nra.
    - rewrite ESR. apply along_near, PR.
    - rewrite ESL. apply along_near, PL.
    - rewrite ESR. unfold along_arm. rewrite val_sum_of_products. binary.
    - rewrite ESL. unfold along_arm. rewrite val_sum_of_products. binary.
    - rewrite EA. destruct (near_over (202 / 100) (val v2) V2 v2_near) as [Pv Nv]; try lra.
      { apply large_inverse. lra. }
      rewrite over_ok by exact Pv. rewrite val_whole. replace (303 / 100) with (202 / 100 + 101 / 100) by lra.
      exact Nv.
    - intros DLp. rewrite ED. pose proof (near_exact (val (height L))) as NE. rewrite Rabs_pos_eq in NE by lra.
      destruct (near_over 0 (val (height L)) (val (height L)) NE) as [Pv Nv]; try lra.
      { apply large_inverse. lra. }
      rewrite over_ok by exact Pv. rewrite val_whole. replace (101 / 100) with (0 + 101 / 100) by lra. exact Nv.
    - rewrite ES. destruct (near_over (202 / 100) (val (along_arm v0 v1 L)) (along_of V0 V1 L)) as [Pv Nv]; try lra.
      { apply along_near, PL. }
      { apply large_inverse. split; [lra|]. nra. }
      rewrite over_ok by exact Pv. rewrite val_whole. replace (303 / 100) with (202 / 100 + 101 / 100) by lra.
      exact Nv.
  Qed.
  (* Heights are multiples of 2^-502, as velocities are. *)
  Lemma grid_502 x : binary64 x -> zero_or x -> exists k : Z, x = IZR k * bpow radix2 (-502).
  Proof using.
    intros B [->|H]; [exists 0%Z; ring|]. pose proof B as E. unfold generic_format in E. unfold F2R in E.
    cbn [Fnum Fexp] in E. set (e := cexp radix2 exponent_of x) in *.
    assert (He : (-502 <= e)%Z).
    { assert (M : (-449 <= mag radix2 x)%Z) by (apply mag_ge_bpow; exact H). unfold e, cexp, FLT_exp. lia. }
    exists (Ztrunc (scaled_mantissa radix2 exponent_of x) * 2 ^ (e + 502))%Z. rewrite mult_IZR.
    change 2%Z with (radix_val radix2). rewrite IZR_Zpower by lia. rewrite Rmult_assoc, <- bpow_plus.
    replace (e + 502 + -502)%Z with e by lia. exact E.
  Qed.
  Lemma level_or_not : val (D_L to) = 0 \/ bpow radix2 (-502) <= val (D_L to).
  Proof.
    destruct (grid_502 V0 v0_64 v0_zero_or) as [a Ea].
    destruct (grid_502 V1 v1_64 v1_zero_or) as [b Eb].
    destruct facts_hold as [_ _ _ Pos _ _ _ _ _ _ _ _ _ _ _ _ _ (_ & E & _)].
    set (g := bpow radix2 (-502)) in *. assert (Pg : 0 < g) by apply bpow_gt_0.
    assert (exists j : Z, val (D_L to) = IZR j * g) as [j Ej].
    { rewrite E. unfold across_of, sign_of. rewrite Ea, Eb.
      destruct (is_flipped to); [exists (a * n1 (arm_L to) - b * n0 (arm_L to))%Z|
        exists (- (a * n1 (arm_L to) - b * n0 (arm_L to)))%Z; rewrite opp_IZR]; rewrite minus_IZR, !mult_IZR; ring. }
    rewrite Ej in *. destruct (Z_le_gt_dec 1 j) as [L|L].
    - right. apply IZR_le in L. nra.
    - left. assert (IZR j <= 0) by (apply (IZR_le _ 0); lia). nra.
  Qed.
End Direction.
