(* What a rounded operation errs by, and sums and products of such numbers: docs/bounds.md, "u = 2^-53. Every
   operation is rounded to nearest". *)
From Coq Require Import ZArith Reals Lra Lia Psatz.
From Flocq Require Import Core Plus_error Mult_error Relative.
From Lorentz Require Import Spec Doubles Euclid.
Local Open Scope R_scope.

Notation u := (/ 9007199254740992).  (* 2^-53 *)
Definition smallest_half : R := bpow radix2 (-1075).  (* what a rounding errs by among the smallest numbers *)
Notation eta := smallest_half.

Lemma u_is : bpow radix2 (-53) = u.
Proof. reflexivity. Qed.
Lemma half_u : / 2 * bpow radix2 (-53 + 1) = u.
Proof. change (bpow radix2 (-53 + 1)) with (/ 4503599627370496). lra. Qed.
Lemma eta_positive : 0 < eta.
Proof. apply bpow_gt_0. Qed.
Lemma eta_below e : (-1075 <= e)%Z -> eta <= bpow radix2 e.
Proof. apply bpow_le. Qed.

Lemma round_64 x : binary64 (nearest64 x).
Proof. apply generic_format_round; [apply FLT_exp_valid, digits_53|apply valid_rnd_N]. Qed.
Lemma rounded_is x : binary64 x -> nearest64 x = x.
Proof. apply round_generic, valid_rnd_N. Qed.
Lemma nearest64_opp x : nearest64 (- x) = - nearest64 x.
Proof. apply round_NE_opp. Qed.

Lemma round_normal x : bpow radix2 (-1022) <= Rabs x -> Rabs (nearest64 x - x) <= u * Rabs x.
Proof. intros H. rewrite <- half_u. exact (relative_error_N_FLT radix2 (-1074) 53 eq_refl _ x H). Qed.
Lemma round_any x : Rabs (nearest64 x - x) <= u * Rabs x + eta.
Proof.
  destruct (error_N_FLT radix2 (-1074) 53 eq_refl (fun n => negb (Z.even n)) x) as (d & e & Hd & He & _ & E).
  unfold nearest64. rewrite E. replace (x * (1 + d) + e - x) with (x * d + e) by ring.
  assert (A : / 2 * bpow radix2 (-1074) = eta).
  { unfold eta. replace (-1074)%Z with (1 + -1075)%Z by lia. rewrite bpow_plus, bpow_1.
    change (IZR radix2) with 2. lra. }
  assert (Hd' : Rabs d <= u) by (rewrite <- half_u; exact Hd). rewrite A in He. apply Rle_trans with (1 := Rabs_triang _ _).
  rewrite Rabs_mult. pose proof (Rabs_pos x). nra.
Qed.
(* Sums err so little even among the smallest numbers. *)
Lemma round_sum a b : binary64 a -> binary64 b -> Rabs (nearest64 (a + b) - (a + b)) <= u * Rabs (a + b).
Proof.
  intros Ha Hb. destruct (Rle_lt_dec (bpow radix2 (-1022)) (Rabs (a + b))) as [L|L].
  - apply round_normal, L.
  - rewrite rounded_is.
    + rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. pose proof (Rabs_pos (a + b)). lra.
    + apply FLT_format_plus_small; auto using digits_53. apply Rlt_le, Rlt_le_trans with (1 := L).
      apply bpow_le. lia.
Qed.
Lemma round_difference a b : binary64 a -> binary64 b -> Rabs (nearest64 (a - b) - (a - b)) <= u * Rabs (a - b).
Proof. intros Ha Hb. apply round_sum; [exact Ha|apply generic_format_opp, Hb]. Qed.

(* Seen from the rounded number. *)
Lemma round_back x : Rabs (nearest64 x - x) <= 1001 / 1000 * u * Rabs (nearest64 x) + 2 * eta.
Proof.
  pose proof (round_any x) as K. pose proof eta_positive. pose proof (Rabs_pos (nearest64 x)).
  assert (T : Rabs x <= Rabs (nearest64 x) + Rabs (nearest64 x - x)).
  { replace x with (nearest64 x - (nearest64 x - x)) at 1 by ring. apply Rle_trans with (1 := Rabs_triang _ _).
    rewrite Rabs_Ropp. lra. }
  lra.
Qed.
Lemma round_nonneg x : 0 <= x -> 0 <= nearest64 x.
Proof.
  intros H. rewrite <- (rounded_is 0) by apply generic_format_0.
  apply round_le; [apply FLT_exp_valid, digits_53|apply valid_rnd_N|exact H].
Qed.
(* For x >= 0: bounds from below and above. *)
Lemma round_size x : 0 <= x -> (1 - u) * x - eta <= nearest64 x <= (1 + u) * x + eta.
Proof.
  intros H. pose proof (round_any x) as K. rewrite (Rabs_pos_eq x H) in K. apply Rabs_le_inv in K. lra.
Qed.
Lemma round_size_sum a b : binary64 a -> binary64 b -> 0 <= a + b ->
  (1 - u) * (a + b) <= nearest64 (a + b) <= (1 + u) * (a + b).
Proof.
  intros Ha Hb H. pose proof (round_sum a b Ha Hb) as K. rewrite (Rabs_pos_eq _ H) in K. apply Rabs_le_inv in K. lra.
Qed.
(* An integer that is a binary64 is not passed. *)
Lemma round_below x y : binary64 y -> x <= y -> nearest64 x <= y.
Proof.
  intros B H. rewrite <- (rounded_is y B). apply round_le; [apply FLT_exp_valid, digits_53|apply valid_rnd_N|exact H].
Qed.
Lemma round_above x y : binary64 y -> y <= x -> y <= nearest64 x.
Proof.
  intros B H. rewrite <- (rounded_is y B). apply round_le; [apply FLT_exp_valid, digits_53|apply valid_rnd_N|exact H].
Qed.

(* ---- a is computed for x, which is at most T: to k roundoffs of T. *)
Definition near (k a x T : R) : Prop := Rabs x <= T /\ Rabs (a - x) <= k * u * T.

Lemma near_size k a x T : near k a x T -> 0 <= T.
Proof. intros [H _]. pose proof (Rabs_pos x). lra. Qed.
Lemma near_exact x : near 0 x x (Rabs x).
Proof. split; [lra|]. rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. lra. Qed.
Lemma near_weaken k a x T k' T' : near k a x T -> 0 <= k <= k' -> T <= T' -> near k' a x T'.
Proof.
  intros N Hk HT. pose proof (near_size _ _ _ _ N) as P. destruct N as [H1 H2]. split; [lra|].
  apply Rle_trans with (1 := H2). nra.
Qed.
Lemma near_abs k a x T : near k a x T -> 0 <= k <= 64 -> Rabs a <= (1 + / 1000000) * T.
Proof.
  intros N Hk. pose proof (near_size _ _ _ _ N) as P. destruct N as [H1 H2].
  replace a with (x + (a - x)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). nra.
Qed.
Lemma near_opp k a x T : near k a x T -> near k (- a) (- x) T.
Proof.
  intros [H1 H2]. split; [rewrite Rabs_Ropp; exact H1|]. replace (- a - - x) with (- (a - x)) by ring.
  rewrite Rabs_Ropp. exact H2.
Qed.
Lemma near_plus k a x T b y S : near k a x T -> near k b y S -> 0 <= k <= 64 -> binary64 a -> binary64 b ->
  near (k + 101 / 100) (nearest64 (a + b)) (x + y) (T + S).
Proof.
  intros Na Nb Hk Fa Fb. pose proof (near_size _ _ _ _ Na) as PT. pose proof (near_size _ _ _ _ Nb) as PS.
  destruct Na as [X1 X2], Nb as [Y1 Y2]. pose proof (round_sum a b Fa Fb) as E.
  assert (D : Rabs (a + b - (x + y)) <= k * u * (T + S)).
  { replace (a + b - (x + y)) with ((a - x) + (b - y)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  assert (XY : Rabs (x + y) <= T + S) by (apply Rle_trans with (1 := Rabs_triang _ _); lra).
  split; [exact XY|].
  assert (AB : Rabs (a + b) <= 101 / 100 * (T + S)).
  { replace (a + b) with ((x + y) + (a + b - (x + y))) by ring. apply Rle_trans with (1 := Rabs_triang _ _). nra. }
  replace (nearest64 (a + b) - (x + y)) with ((nearest64 (a + b) - (a + b)) + (a + b - (x + y))) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.
Lemma near_times k a x T l b y S : near k a x T -> near l b y S -> 0 <= k <= 64 -> 0 <= l <= 64 ->
  T * S = 0 \/ bpow radix2 (-960) <= T * S -> near (k + l + 101 / 100) (nearest64 (a * b)) (x * y) (T * S).
Proof.
  intros Na Nb Hk Hl Hz. pose proof (near_size _ _ _ _ Na) as PT. pose proof (near_size _ _ _ _ Nb) as PS.
  pose proof (near_abs _ _ _ _ Na Hk) as A. pose proof (near_abs _ _ _ _ Nb Hl) as B.
  destruct Na as [X1 X2], Nb as [Y1 Y2].
  pose proof (Rabs_pos x) as Px. pose proof (Rabs_pos y) as Py. pose proof (Rabs_pos a) as Pa.
  pose proof (Rabs_pos b) as Pb.
  assert (XY : Rabs (x * y) <= T * S) by (rewrite Rabs_mult; apply Rmult_le_compat; auto).
  split; [exact XY|]. pose proof (round_any (a * b)) as E. rewrite Rabs_mult in E.
  assert (AB : Rabs a * Rabs b <= (1 + / 1000000) * T * ((1 + / 1000000) * S)) by (apply Rmult_le_compat; auto).
  assert (D : Rabs (a * b - x * y) <= k * u * T * ((1 + / 1000000) * S) + T * (l * u * S)).
  { replace (a * b - x * y) with ((a - x) * b + x * (b - y)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
    rewrite !Rabs_mult. apply Rplus_le_compat; apply Rmult_le_compat; auto using Rabs_pos. }
  set (TS := T * S) in *. assert (PTS : 0 <= TS) by (unfold TS; nra).
  assert (AB' : Rabs a * Rabs b <= (1 + / 1000) * TS) by (unfold TS; nra).
  assert (D' : Rabs (a * b - x * y) <= (k + l) * u * TS + / 1000 * u * TS).
  { apply Rle_trans with (1 := D). unfold TS.
    replace (k * u * T * ((1 + / 1000000) * S) + T * (l * u * S)) with
      ((k + l) * u * (T * S) + k * / 1000000 * u * (T * S)) by ring. fold TS. nra. }
  replace (nearest64 (a * b) - x * y) with ((nearest64 (a * b) - a * b) + (a * b - x * y)) by ring.
  destruct Hz as [Z0|Hz].
  - (* one of them is zero, exactly *)
    rewrite Z0 in *. assert (Z1 : a * b = 0).
    { apply Rabs_eq_R0. rewrite Rabs_mult. assert (0 <= Rabs a * Rabs b) by (apply Rmult_le_pos; auto). lra. }
    rewrite Z1, nearest64_0. rewrite Z1 in D'. replace (0 - 0 + (0 - x * y)) with (0 - x * y) by ring. lra.
  - assert (Et : eta <= / 1000 * u * TS).
    { apply Rle_trans with (/ 1000 * u * bpow radix2 (-960)); [|apply Rmult_le_compat_l; [lra|exact Hz]].
      apply Rle_trans with (bpow radix2 (-64) * bpow radix2 (-960)).
      - rewrite <- bpow_plus. apply eta_below. lia.
      - apply Rmult_le_compat_r; [apply bpow_ge_0|]. change (bpow radix2 (-64)) with (/ 18446744073709551616). lra. }
    apply Rle_trans with (1 := Rabs_triang _ _). nra.
Qed.
(* A rounded product of two numbers of which one may be so small that digits are lost: with a little more. *)
Lemma near_times_any k a x T l b y S : near k a x T -> near l b y S -> 0 <= k <= 64 -> 0 <= l <= 64 ->
  near (k + l + 101 / 100) (nearest64 (a * b)) (x * y) (T * S + bpow radix2 (-900)).
Proof.
  intros Na Nb Hk Hl. pose proof (near_size _ _ _ _ Na) as PT. pose proof (near_size _ _ _ _ Nb) as PS.
  pose proof (bpow_gt_0 radix2 (-900)) as P9.
  destruct (Rle_lt_dec (bpow radix2 (-960)) (T * S)) as [L|L].
  - apply near_weaken with (k := k + l + 101 / 100) (T := T * S); [|lra|lra]. apply near_times; auto.
  - pose proof (near_abs _ _ _ _ Na Hk) as A. pose proof (near_abs _ _ _ _ Nb Hl) as B.
    destruct Na as [X1 X2], Nb as [Y1 Y2].
    assert (XY : Rabs (x * y) <= T * S) by (rewrite Rabs_mult; apply Rmult_le_compat; auto using Rabs_pos).
    assert (AB : Rabs (a * b) <= 2 * (T * S)).
    { rewrite Rabs_mult. apply Rle_trans with ((1 + / 1000000) * T * ((1 + / 1000000) * S));
        [apply Rmult_le_compat; auto using Rabs_pos|nra]. }
    split; [nra|]. pose proof (round_any (a * b)) as E.
    assert (N : Rabs (nearest64 (a * b) - x * y) <= 5 * bpow radix2 (-960)).
    { replace (nearest64 (a * b) - x * y) with ((nearest64 (a * b) - a * b) + (a * b + - (x * y))) by ring.
      apply Rle_trans with (1 := Rabs_triang _ _). pose proof (Rabs_triang (a * b) (- (x * y))) as K1.
      rewrite (Rabs_Ropp (x * y)) in K1.
      pose proof (eta_below (-960) ltac:(lia)). pose proof (bpow_gt_0 radix2 (-960)). lra. }
    apply Rle_trans with (1 := N). apply Rle_trans with (u * bpow radix2 (-900)); [|pose proof (Rmult_le_pos T S PT PS); nra].
    rewrite <- u_is, <- bpow_plus. apply Rle_trans with (bpow radix2 7 * bpow radix2 (-960)).
    + apply Rmult_le_compat_r; [apply bpow_ge_0|]. change (bpow radix2 7) with 128. lra.
    + rewrite <- bpow_plus. apply bpow_le. lia.
Qed.
(* One over a positive number. *)
Lemma near_over k b y : near k b y y -> 0 <= k <= 64 -> 0 < y -> bpow radix2 (-960) <= / y ->
  0 < b /\ near (k + 101 / 100) (nearest64 (1 / b)) (/ y) (/ y).
Proof.
  intros [_ H] Hk Hy Hz. apply Rabs_le_inv in H. assert (B : (1 - / 1000000) * y <= b <= (1 + / 1000000) * y) by (split; nra).
  assert (Pb : 0 < b) by nra. split; [exact Pb|]. pose proof (Rinv_0_lt_compat _ Hy) as Iy.
  split; [rewrite Rabs_pos_eq; lra|].
  pose proof (round_any (1 / b)) as E. unfold Rdiv in *. rewrite Rmult_1_l in *.
  pose proof (Rinv_0_lt_compat _ Pb) as Ib. rewrite (Rabs_pos_eq (/ b)) in E by lra.
  assert (Y1 : y * / y = 1) by (field; lra). assert (B1 : b * / b = 1) by (field; lra).
  set (i := / y) in *. set (j := / b) in *.
  assert (J : j <= (1 + / 100000) * i).
  { apply Rmult_le_reg_l with b; [exact Pb|]. rewrite B1. nra. }
  assert (D : Rabs (j - i) <= k * u * i + / 1000 * u * i).
  { assert (Ji : j - i = (y - b) * (i * j)) by (replace ((y - b) * (i * j)) with (y * i * j - b * j * i) by ring;
      rewrite Y1, B1; ring).
    rewrite Ji, Rabs_mult, (Rabs_pos_eq (i * j)) by (apply Rmult_le_pos; lra).
    assert (N : Rabs (y - b) <= k * u * y) by (apply Rabs_le; lra).
    apply Rle_trans with (k * u * y * (i * ((1 + / 100000) * i))).
    - apply Rmult_le_compat; try apply Rabs_pos; try exact N; [nra|]. apply Rmult_le_compat_l; lra.
    - replace (k * u * y * (i * ((1 + / 100000) * i))) with (k * u * (y * i) * i * (1 + / 100000)) by ring.
      rewrite Y1. nra. }
  assert (Et : eta <= / 1000 * u * i).
  { apply Rle_trans with (/ 1000 * u * bpow radix2 (-960)); [|apply Rmult_le_compat_l; [lra|exact Hz]].
    apply Rle_trans with (bpow radix2 (-64) * bpow radix2 (-960)).
    - rewrite <- bpow_plus. apply eta_below. lia.
    - apply Rmult_le_compat_r; [apply bpow_ge_0|]. change (bpow radix2 (-64)) with (/ 18446744073709551616). lra. }
  replace (nearest64 j - i) with ((nearest64 j - j) + (j - i)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _). nra.
Qed.
(* A root. *)
Lemma near_root k b y : near k b y y -> 0 <= k <= 64 -> 1 <= y ->
  near (k + 101 / 100) (nearest64 (sqrt b)) (sqrt y) (sqrt y).
Proof.
  intros [_ H] Hk Hy. apply Rabs_le_inv in H.
  assert (B : (1 - / 1000000) * y <= b <= (1 + / 1000000) * y) by (split; nra).
  assert (S1 : 1 <= sqrt y) by (rewrite <- sqrt_1; apply sqrt_le_1_alt, Hy).
  pose proof (sqrt_sqrt y ltac:(lra)) as Sy. pose proof (sqrt_sqrt b ltac:(lra)) as Sb.
  pose proof (sqrt_pos b) as P. set (p := sqrt b) in *. set (q := sqrt y) in *.
  split; [rewrite Rabs_pos_eq; lra|].
  assert (D : Rabs (p - q) <= k * u * q).
  { assert (N : Rabs ((p - q) * (p + q)) <= k * u * (q * q)).
    { replace ((p - q) * (p + q)) with (b - y) by lra. rewrite Sy. apply Rabs_le; lra. }
    rewrite Rabs_mult, (Rabs_pos_eq (p + q)) in N by lra. pose proof (Rabs_pos (p - q)).
    apply Rmult_le_reg_r with q; [lra|]. nra. }
  assert (E : Rabs (nearest64 p - p) <= u * Rabs p).
  { apply round_normal. rewrite Rabs_pos_eq by lra. apply Rle_trans with (/ 2); [|nra].
    apply (bpow_le radix2 (-1022) (-1)). lia. }
  rewrite (Rabs_pos_eq p P) in E. assert (P2 : p <= (1 + / 1000) * q) by nra.
  replace (nearest64 p - q) with ((nearest64 p - p) + (p - q)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _). nra.
Qed.
