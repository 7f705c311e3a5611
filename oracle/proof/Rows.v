(* docs/reduction.md, "2D": "Then each row { n R + m L } enters the strip at one m, found by a division, and
   only the rows near the start matter". Over the real numbers. *)
From Coq Require Import ZArith Reals Lra Lia Psatz.
From Flocq Require Import Core.
Local Open Scope R_scope.

Section Rows.
  (* R and L are D_R above the line and D_L below it, and S_R and S_L along it; the ball from which rows are
     counted is y above the line, and s ahead. The line meets what is nearer than rho. *)
  Variables (D_R D_L S_R S_L y s rho : R).
  Definition area_of : R := S_R * D_L + S_L * D_R.
  Hypothesis R_above : 0 < D_R.
  Hypothesis L_below : 0 <= D_L.
  Hypothesis R_forward : 0 <= S_R.
  Hypothesis L_forward : 0 < S_L.
  Hypothesis rho_positive : 0 < rho.
  Notation A := area_of.

  Definition height_at (n m : Z) : R := y + IZR n * D_R - IZR m * D_L.
  Definition position_at (n m : Z) : R := s + IZR n * S_R + IZR m * S_L.
  Definition in_strip (n m : Z) : Prop := Rabs (height_at n m) < rho.
  Definition ahead (n m : Z) : Prop := in_strip n m /\ 0 < position_at n m.
  (* The number of the row beside the start, and how far from it others pass. *)
  Definition beside : R := - (S_L * y + D_L * s) / A.
  Definition reach : R := S_L * rho / A.

  Lemma area_positive : 0 < A.
  Proof using R_above L_below R_forward L_forward. unfold area_of. nra. Qed.
  Lemma row_of n m : IZR n = beside + (S_L * height_at n m + D_L * position_at n m) / A.
  Proof using R_above L_below R_forward L_forward.
    pose proof area_positive as P. unfold beside, height_at, position_at. unfold area_of in *. field. lra.
  Qed.

  (* Row n comes into question not before this one.. *)
  Theorem first_row n m : ahead n m -> beside - reach < IZR n.
  Proof using R_above L_below R_forward L_forward rho_positive.
    intros [H P]. unfold in_strip in H. apply Rabs_def2 in H. destruct H as [_ H]. pose proof area_positive as AP.
    rewrite (row_of n m). unfold reach, Rdiv. apply Rinv_0_lt_compat in AP. set (i := / A) in *.
    assert (0 <= D_L * position_at n m) by nra. assert (S_L * - rho < S_L * height_at n m) by nra. nra.
  Qed.
  (* .. and for a ball before P not after this one. *)
  Theorem last_row n m P : ahead n m -> position_at n m <= P -> IZR n < beside + reach + P * (D_L / A).
  Proof using R_above L_below R_forward L_forward rho_positive.
    intros [H _] HP. unfold in_strip in H. apply Rabs_def2 in H. destruct H as [H _].
    pose proof area_positive as AP. rewrite (row_of n m). unfold reach, Rdiv. apply Rinv_0_lt_compat in AP.
    set (i := / A) in *. assert (S_L * height_at n m < S_L * rho) by nra.
    assert (D_L * position_at n m <= D_L * P) by nra. nra.
  Qed.

  (* In a row balls come down to the strip, and go forward. *)
  Lemma next_in_row n m m' : (m <= m')%Z -> height_at n m' <= height_at n m /\
    position_at n m <= position_at n m'.
  Proof using L_below L_forward. intros H. apply IZR_le in H. unfold height_at, position_at. split; nra. Qed.
  Lemma later_in_row n m m' : (m < m')%Z -> position_at n m < position_at n m'.
  Proof using L_forward. intros H. apply IZR_lt in H. unfold position_at. nra. Qed.

  (* The stopping rule: if L's step is lower than the strip is wide, each row enters it. *)
  Theorem each_row_enters n : 0 < D_L < 2 * rho -> exists m, in_strip n m.
  Proof using.
    intros [P W]. set (z := (y + IZR n * D_R - rho) / D_L).
    exists (Zfloor z + 1)%Z. unfold in_strip, height_at. rewrite plus_IZR.
    pose proof (Zfloor_lb z) as Lo. pose proof (Zfloor_ub z) as Up.
    assert (E : y + IZR n * D_R = rho + z * D_L) by (unfold z; field; lra).
    rewrite E. apply Rabs_def1; nra.
  Qed.
  Theorem not_each_row_enters : D_L = 2 * rho -> exists y', forall m, ~ Rabs (y' - IZR m * D_L) < rho.
  Proof using rho_positive.
    intros E. exists rho. intros m H. rewrite E in H. apply Rabs_def2 in H.
    assert (K : -1 < IZR (1 - 2 * m) < 1) by (rewrite minus_IZR, mult_IZR; split; nra).
    destruct K as [K1 K2]. apply lt_IZR in K1, K2. lia.
  Qed.
  Lemma where_row_enters n m : 0 < D_L -> in_strip n m -> (y + IZR n * D_R - rho) / D_L < IZR m.
  Proof using.
    intros P H. unfold in_strip, height_at in H. apply Rabs_def2 in H.
    apply Rmult_lt_reg_r with D_L; [exact P|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra.
  Qed.
  Lemma where_row_starts n m : 0 < position_at n m -> - (s + IZR n * S_R) / S_L < IZR m.
  Proof using L_forward.
    unfold position_at. intros H.
    apply Rmult_lt_reg_r with S_L; [exact L_forward|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra.
  Qed.

  (* If two rows meet the strip, the later one meets it earlier only if it is less than 2 rho higher; *)
  Theorem overtaken n m n' m' : in_strip n m -> in_strip n' m' -> (n < n')%Z ->
    position_at n' m' <= position_at n m -> IZR (n' - n) * D_R < 2 * rho.
  Proof using R_above L_below R_forward L_forward rho_positive.
    unfold in_strip. intros H H' N P. apply Rabs_def2 in H, H'. unfold height_at, position_at in *.
    assert (N1 : 1 <= IZR (n' - n)) by (apply (IZR_le 1); lia). rewrite minus_IZR in *.
    apply Rnot_le_lt. intros K. assert (M : 0 < IZR m' - IZR m) by (apply Rnot_le_lt; intros M; nra). nra.
  Qed.
  (* so rows that are farther apart than that come one after the other, *)
  Theorem rows_in_order n m n' m' : 2 * rho <= D_R -> in_strip n m -> in_strip n' m' -> (n < n')%Z ->
    position_at n m < position_at n' m'.
  Proof using R_above L_below R_forward L_forward rho_positive.
    intros W H H' N. apply Rnot_le_lt. intros P. pose proof (overtaken n m n' m' H H' N P) as K.
    assert (N1 : 1 <= IZR (n' - n)) by (apply (IZR_le 1); lia). nra.
  Qed.
  (* and else only the next one can be earlier: at the end of Euclid's algorithm D_R is at least rho. *)
  Theorem only_the_next n m n' m' : rho <= D_R -> in_strip n m -> in_strip n' m' -> (n < n')%Z ->
    position_at n' m' <= position_at n m -> n' = (n + 1)%Z.
  Proof using R_above L_below R_forward L_forward rho_positive.
    intros W H H' N P. pose proof (overtaken n m n' m' H H' N P) as K.
    assert (IZR (n' - n) < 2) by nra. apply (lt_IZR (n' - n) 2) in H0. lia.
  Qed.
  Definition first_ball (n m : Z) : Prop := ahead n m /\
    forall n' m', ahead n' m' -> (n', m') = (n, m) \/ position_at n m < position_at n' m'.
  Theorem first_of_first_row n m : 2 * rho <= D_R -> ahead n m ->
    (forall m', ahead n m' -> (m <= m')%Z) ->
    (forall n' m', ahead n' m' -> beside - reach < IZR n' -> (n <= n')%Z) -> first_ball n m.
  Proof using R_above L_below R_forward L_forward rho_positive.
    intros W H Row Rows. split; [exact H|]. intros n' m' H'.
    specialize (Rows n' m' H' (first_row n' m' H')). destruct (Z.eq_dec n' n) as [->|N].
    - specialize (Row m' H'). destruct (Z.eq_dec m' m) as [->|M]; [left; reflexivity|right].
      apply later_in_row. lia.
    - right. apply rows_in_order; try apply H; try apply H'; [exact W|lia].
  Qed.
  (* Two rows suffice: the first that has a ball ahead, and the next one. *)
  Theorem two_rows n m n' m' : rho <= D_R -> ahead n' m' -> (forall n m, ahead n m -> (n' <= n)%Z) ->
    first_ball n m -> n = n' \/ n = (n' + 1)%Z.
  Proof using R_above L_below R_forward L_forward rho_positive.
    intros W H' Rows [H First]. destruct (Z.eq_dec n n') as [|N]; [auto|right].
    pose proof (Rows n m H) as Le. destruct (First n' m' H') as [E|P]; [congruence|].
    apply (only_the_next n' m' n m W); try apply H; try apply H'; [lia|lra].
  Qed.
End Rows.
