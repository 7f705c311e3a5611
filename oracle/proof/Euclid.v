(* docs/reduction.md, "2D": "Euclid's algorithm on the two (the continued fraction of the slope) stops when D_L is
   certainly less than 2 rho". "On the unit square all heights are exact, because a remainder of two binary64
   numbers is a binary64 number." *)
From Coq Require Import ZArith Reals Lra Lia Psatz Bool.
From Flocq Require Import Core.
From Lorentz Require Import Spec Doubles.
Local Open Scope R_scope.

(* ---- A remainder is exact. *)
Lemma bpow_52 e : bpow radix2 (e + 53) = IZR (2 ^ 53) * bpow radix2 e.
Proof. rewrite Z.add_comm, bpow_plus. f_equal. Qed.

(* n 2^e is a binary64, if n has at most 53 digits, or is 2^53. *)
Lemma on_grid n e : (-1074 <= e)%Z -> (Z.abs n <= 2 ^ 53)%Z -> binary64 (IZR n * bpow radix2 e).
Proof.
  intros He Hn. destruct (Z.eq_dec (Z.abs n) (2 ^ 53)) as [E|N].
  - assert (B : binary64 (bpow radix2 (e + 53))) by (apply generic_format_bpow; unfold FLT_exp; lia).
    rewrite bpow_52 in B. destruct (Z.abs_eq_cases n (2 ^ 53) E) as [->| ->]; [exact B|].
    rewrite opp_IZR, <- Ropp_mult_distr_l. apply generic_format_opp. exact B.
  - apply generic_format_FLT. exists (Float radix2 n e); [reflexivity| |exact He].
    change (Zpower radix2 53) with (2 ^ 53)%Z. cbn [Fnum]. lia.
Qed.
Lemma exact_on_grid n e : (-1074 <= e)%Z -> (Z.abs n <= 2 ^ 53)%Z ->
  nearest64 (IZR n * bpow radix2 e) = IZR n * bpow radix2 e.
Proof. intros He Hn. apply round_generic; [apply valid_rnd_N|apply on_grid; auto]. Qed.
Lemma exact_integer n : (Z.abs n <= 2 ^ 53)%Z -> nearest64 (IZR n) = IZR n.
Proof. intros H. rewrite <- (Rmult_1_r (IZR n)). apply (exact_on_grid n 0); [lia|exact H]. Qed.

(* Whatever the quotient is: a - k b is exact if it is no larger than b, on a grid of b's. *)
Theorem remainder_on_grid na nb e k : (-1074 <= e)%Z -> (0 < nb <= 2 ^ 53)%Z -> (Z.abs (na - k * nb) <= nb)%Z ->
  let a := IZR na * bpow radix2 e in let b := IZR nb * bpow radix2 e in
  nearest64 (a - IZR k * b) = a - IZR k * b.
Proof.
  intros He Hb Hr a b. assert (E : a - IZR k * b = IZR (na - k * nb) * bpow radix2 e)
    by (unfold a, b; rewrite minus_IZR, mult_IZR; ring).
  rewrite E. apply exact_on_grid; [exact He|lia].
Qed.

(* Two numbers are on one grid, on which the smaller has 53 digits. *)
Lemma common_grid a b : binary64 a -> binary64 b -> 0 < b <= a ->
  exists na nb e, (-1074 <= e)%Z /\ (0 < nb <= 2 ^ 53)%Z /\ a = IZR na * bpow radix2 e /\
    b = IZR nb * bpow radix2 e.
Proof.
  intros Fa Fb [Hb Hab].
  pose proof (FLT_format_generic radix2 (-1074) 53 b Fb) as [fb Eb Mb Xb].
  set (e := cexp radix2 exponent_of b). set (ea := cexp radix2 exponent_of a).
  assert (Le : (e <= ea)%Z).
  { unfold e, ea, cexp. apply monotone_exp; [apply FLT_exp_monotone|].
    apply mag_le; auto. }
  exists (Ztrunc (scaled_mantissa radix2 exponent_of a) * 2 ^ (ea - e))%Z.
  exists (Ztrunc (scaled_mantissa radix2 exponent_of b)), e.
  assert (E : b = IZR (Ztrunc (scaled_mantissa radix2 exponent_of b)) * bpow radix2 e) by exact Fb.
  split; [unfold e, cexp, FLT_exp; lia|]. split; [split|split].
  - apply lt_IZR. apply Rmult_lt_reg_r with (bpow radix2 e); [apply bpow_gt_0|]. rewrite <- E. lra.
  - apply le_IZR. apply Rmult_le_reg_r with (bpow radix2 e); [apply bpow_gt_0|]. rewrite <- E.
    rewrite <- bpow_52. apply Rlt_le. apply Rlt_le_trans with (bpow radix2 (mag radix2 b)).
    + pose proof (bpow_mag_gt radix2 b) as K. rewrite Rabs_pos_eq in K by lra. exact K.
    + apply bpow_le. unfold e, cexp, FLT_exp. lia.
  - rewrite mult_IZR. change 2%Z with (radix_val radix2). rewrite IZR_Zpower by lia.
    rewrite Rmult_assoc, <- bpow_plus. replace (ea - e + e)%Z with ea by lia. exact Fa.
  - exact E.
Qed.

(* The quotient that is computed, a / b rounded and then cut off, may be one too large, when a / b lies just below
   an integer; and never anything else. *)
Lemma quotient_range a b : 0 < b -> 0 <= a < IZR (2 ^ 53) * b ->
  let k := Zfloor (nearest64 (a / b)) in (0 <= k)%Z /\ IZR (k - 1) * b <= a < IZR (k + 1) * b.
Proof.
  intros Hb [Ha Hab] k. set (q := Zfloor (a / b)).
  assert (D : a = a / b * b) by (field; lra).
  pose proof (Zfloor_lb (a / b)) as L. pose proof (Zfloor_ub (a / b)) as U. fold q in L, U.
  assert (Q0 : (0 <= q)%Z).
  { apply Zfloor_lub. apply Rmult_le_pos; [exact Ha|apply Rlt_le, Rinv_0_lt_compat, Hb]. }
  assert (Q1 : (q < 2 ^ 53)%Z).
  { apply lt_IZR. apply Rle_lt_trans with (1 := L). apply Rmult_lt_reg_r with b; [exact Hb|]. lra. }
  assert (K1 : IZR q <= nearest64 (a / b)).
  { rewrite <- (exact_integer q) by lia. apply round_le; [apply FLT_exp_valid, digits_53|apply valid_rnd_N|].
    exact L. }
  assert (K2 : nearest64 (a / b) <= IZR (q + 1)).
  { rewrite <- (exact_integer (q + 1)) by lia.
    apply round_le; [apply FLT_exp_valid, digits_53|apply valid_rnd_N|]. rewrite plus_IZR. lra. }
  assert (K : (q <= k <= q + 1)%Z).
  { split; [apply Zfloor_lub, K1|]. unfold k. rewrite <- (Zfloor_IZR (q + 1)). apply Zfloor_le, K2. }
  split; [lia|]. destruct K as [Ka Kb]. apply IZR_le in Ka, Kb. rewrite plus_IZR in Kb.
  rewrite minus_IZR, plus_IZR. split; rewrite D; apply Rmult_le_compat_r || apply Rmult_lt_compat_r; lra.
Qed.

(* docs/bounds.md, lemma 1. *)
Theorem remainder_exact a b : binary64 a -> binary64 b -> 0 < b <= a -> a < IZR (2 ^ 53) * b ->
  let k := Zfloor (nearest64 (a / b)) in let r := nearest64 (a - IZR k * b) in
  r = a - IZR k * b /\ (1 <= k)%Z /\ - b <= r < b.
Proof.
  intros Fa Fb Hb Ha k r. destruct (quotient_range a b) as [K0 K]; [lra|lra|]. fold k in K0, K.
  rewrite minus_IZR, plus_IZR in K.
  assert (E : r = a - IZR k * b).
  { destruct (common_grid a b Fa Fb Hb) as (na & nb & e & He & Hn & Ea & Eb). unfold r. rewrite Ea, Eb in *.
    apply remainder_on_grid; auto. pose proof (bpow_gt_0 radix2 e) as P.
    assert (H : IZR (- nb) <= IZR (na - k * nb) <= IZR nb).
    { rewrite opp_IZR, minus_IZR, mult_IZR.
      split; (apply Rmult_le_reg_r with (bpow radix2 e); [exact P|]); nra. }
    destruct H as [H1 H2]. apply le_IZR in H1, H2. lia. }
  split; [exact E|]. split; [|rewrite E; lra].
  assert (1 <= a / b) by (apply Rmult_le_reg_r with b; [lra|]; unfold Rdiv; rewrite Rmult_assoc, Rinv_l; lra).
  apply Zfloor_lub. rewrite <- (exact_integer 1) by (cbn; lia).
  apply round_le; [apply FLT_exp_valid, digits_53|apply valid_rnd_N|exact H].
Qed.
(* The quotient was not too large: this is what the engine looks at, after its last step. *)
Theorem remainder_right a b : binary64 a -> binary64 b -> 0 < b <= a -> a < IZR (2 ^ 53) * b ->
  0 <= nearest64 (a - IZR (Zfloor (nearest64 (a / b))) * b) ->
  Zfloor (nearest64 (a / b)) = Zfloor (a / b).
Proof.
  intros Fa Fb Hb Ha. destruct (remainder_exact a b Fa Fb Hb Ha) as (-> & _ & _ & K). intros H.
  symmetry. apply Zfloor_imp. set (k := Zfloor (nearest64 (a / b))) in *. rewrite plus_IZR.
  assert (D : a = a / b * b) by (field; lra). split.
  - apply Rmult_le_reg_r with b; lra.
  - apply Rmult_lt_reg_r with b; lra.
Qed.

(* ---- The algorithm, as the engine runs it on the unit square. R and L are the arms, two lattice vectors on
   either side of the line, and their heights. *)
Record arm := Arm { n0 : Z; n1 : Z; height : num }.
Definition subtract (a : arm) (k : Z) (b : arm) : arm :=
  Arm (n0 a + k * n0 b) (n1 a + k * n1 b) (remainder (height a) k (height b)).
Fixpoint euclid (steps : nat) (passable : num) (R L : arm) (flipped : bool) : option (arm * arm * bool) :=
  match steps with
  | O => None
  | S steps =>
    if at_most passable (height L)
    then euclid steps passable L (subtract R (floor (over (height R) (height L))) L) (negb flipped)
    else Some (R, L, flipped)
  end.

Definition sign_of (flipped : bool) : R := if flipped then -1 else 1.
Lemma sign_negb f : sign_of (negb f) = - sign_of f.
Proof. destruct f; cbn; lra. Qed.
Lemma sign_square f : sign_of f * sign_of f = 1.
Proof. destruct f; cbn; lra. Qed.

Section Heights.
  Variables (v0 v1 : R).
  (* Along the line, and across it. *)
  Definition along_of (a : arm) : R := v0 * IZR (n0 a) + v1 * IZR (n1 a).
  Definition across_of (a : arm) : R := v0 * IZR (n1 a) - v1 * IZR (n0 a).

  (* A basis of the unit square with the line in between. *)
  Definition basis (R L : arm) (flipped : bool) : Prop :=
    val (height R) = sign_of flipped * across_of R /\ val (height L) = - (sign_of flipped * across_of L) /\
    IZR (n0 L) * IZR (n1 R) - IZR (n1 L) * IZR (n0 R) = sign_of flipped.

  (* docs/reduction.md: S_R D_L + S_L D_R = A. *)
  Theorem area R L flipped : basis R L flipped ->
    along_of R * val (height L) + along_of L * val (height R) = v0 * v0 + v1 * v1.
  Proof.
    intros (-> & -> & D). pose proof (sign_square flipped) as S. unfold along_of, across_of.
    set (s := sign_of flipped) in *.
    replace (v0 * v0 + v1 * v1) with (s * s * (v0 * v0 + v1 * v1)) by (rewrite S; ring). rewrite <- D at 4.
    ring.
  Qed.
  (* Every lattice vector is n R + m L. *)
  Lemma basis_reaches R L flipped i j : basis R L flipped -> exists n m,
    i = (n * n0 R + m * n0 L)%Z /\ j = (n * n1 R + m * n1 L)%Z.
  Proof.
    intros (_ & _ & D). set (s := if flipped then (-1)%Z else 1%Z).
    assert (E : (n0 L * n1 R - n1 L * n0 R = s)%Z).
    { apply eq_IZR. rewrite minus_IZR, !mult_IZR, D. unfold s. destruct flipped; reflexivity. }
    assert (S : (s * s = 1)%Z) by (unfold s; destruct flipped; reflexivity).
    exists (s * (n0 L * j - n1 L * i))%Z, (s * (n1 R * i - n0 R * j))%Z. split.
    - replace i with (s * (n0 L * n1 R - n1 L * n0 R) * i)%Z at 1 by (rewrite E, S; ring). ring.
    - replace j with (s * (n0 L * n1 R - n1 L * n0 R) * j)%Z at 1 by (rewrite E, S; ring). ring.
  Qed.

  Definition forward (a : arm) : Prop := (0 <= n0 a)%Z /\ (0 <= n1 a)%Z.
  Variables (passable : num).
  Hypothesis v_order : 0 <= v1 <= v0.
  Hypothesis passable_positive : 0 < val passable.
  Hypothesis passable_wide : v0 < IZR (2 ^ 53) * val passable.
  (* What holds after each step. *)
  Definition holds (R L : arm) (flipped : bool) : Prop :=
    basis R L flipped /\ binary64 (val (height R)) /\ binary64 (val (height L)) /\
    forward R /\ forward L /\ along_of R <= along_of L /\ (n0 R <= n0 L)%Z /\ (1 <= n0 L)%Z /\
    0 < val (height R) <= v0 /\ val (height L) <= val (height R) /\
    (val passable <= val (height R) \/ val (height R) = v0).

  Lemma holds_on R L flipped : holds R L flipped -> val passable <= val (height L) ->
    let k := floor (over (height R) (height L)) in
    val (height (subtract R k L)) = val (height R) - IZR k * val (height L) /\ (1 <= k)%Z /\
    holds L (subtract R k L) (negb flipped).
  Proof.
    intros (B & FR & FL & PR & PL & SRL & NRL & NL & HR & HLR & HP) HL k.
    assert (Ek : k = Zfloor (nearest64 (val (height R) / val (height L)))).
    { unfold k. rewrite floor_ok, over_ok by lra. reflexivity. }
    destruct (remainder_exact (val (height R)) (val (height L))) as (E & K1 & K2); auto; [lra|nra|].
    rewrite <- Ek in *. rewrite E in K2.
    assert (D : val (height (subtract R k L)) = val (height R) - IZR k * val (height L)).
    { cbn [subtract height]. rewrite remainder_ok. exact E. }
    split; [exact D|]. split; [exact K1|]. pose proof (IZR_le _ _ K1) as K1'.
    destruct B as (B1 & B2 & B3). unfold holds, basis. rewrite sign_negb, D.
    assert (SL : along_of L <= along_of (subtract R k L)).
    { unfold along_of, subtract in *. cbn [n0 n1]. rewrite !plus_IZR, !mult_IZR. destruct PR as [P1 P2],
        PL as [P3 P4]. apply IZR_le in P1, P2, P3, P4.
      assert (0 <= v0 * IZR (n0 R) + v1 * IZR (n1 R)) by nra.
      assert (0 <= v0 * IZR (n0 L) + v1 * IZR (n1 L)) by nra. nra. }
    split; [split; [|split]|split; [exact FL|split; [|split; [exact PL|split; [|split;
      [exact SL|split; [|split; [|split; [|split]]]]]]]]].
    - lra.
    - rewrite B1, B2. unfold across_of, subtract. cbn [n0 n1]. rewrite !plus_IZR, !mult_IZR. ring.
    - unfold subtract. cbn [n0 n1]. rewrite !plus_IZR, !mult_IZR. rewrite <- B3. ring.
    - rewrite <- E. apply generic_format_round; [apply FLT_exp_valid, digits_53|apply valid_rnd_N].
    - unfold forward, subtract in *. cbn [n0 n1]. nia.
    - unfold forward, subtract in *. cbn [n0]. nia.
    - unfold forward, subtract in *. cbn [n0]. nia.
    - lra.
    - lra.
    - left. exact HL.
  Qed.

  Theorem euclid_ok steps : forall R L flipped R' L' flipped', holds R L flipped ->
    euclid steps passable R L flipped = Some (R', L', flipped') ->
    holds R' L' flipped' /\ val (height L') < val passable.
  Proof.
    induction steps as [|steps IH]; [discriminate|]. intros R L flipped R' L' flipped' H. cbn [euclid].
    destruct (at_most_ok passable (height L)) as [K|K].
    - intros E. apply IH in E; [exact E|]. apply holds_on; auto.
    - intros E. injection E as <- <- <-. split; [exact H|lra].
  Qed.
End Heights.

(* The first arms, of a velocity in the first octant: the axes. *)
Definition first_R (v0 : num) : arm := Arm 0 1 v0.
Definition first_L (v1 : num) : arm := Arm 1 0 v1.
Lemma holds_first v0 v1 passable : 0 <= val v1 <= val v0 -> 0 < val v0 -> binary64 (val v0) -> binary64 (val v1) ->
  holds (val v0) (val v1) passable (first_R v0) (first_L v1) false.
Proof.
  intros H P F0 F1. unfold holds, basis, forward, along_of, across_of. cbn. repeat split; try lra; try lia; auto.
Qed.
(* Coefficients are integers here, and binary64 there: the same below 2^53. *)
Lemma exact_coefficient n k m : (0 <= n)%Z -> (0 <= k)%Z -> (0 <= m)%Z -> (n + k * m <= 2 ^ 53)%Z ->
  nearest64 (IZR n + nearest64 (IZR k * IZR m)) = IZR (n + k * m).
Proof.
  intros Hn Hk Hm H. rewrite <- mult_IZR, (exact_integer (k * m)) by nia. rewrite <- plus_IZR.
  apply exact_integer. nia.
Qed.
