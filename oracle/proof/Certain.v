(* If what the search computes is known as well as it believes, it names the right ball. docs/bounds.md says how well
   that is, Errors.v proves it. *)
From Coq Require Import ZArith Reals Lra Lia Psatz List Bool.
From Flocq Require Import Core.
From Lorentz Require Import Spec Doubles Euclid Rows Model.
Import ListNotations.
Local Open Scope R_scope.

(* Sums and differences that are compared: rounding keeps their order. *)
Lemma nearest64_le x y : x <= y -> nearest64 x <= nearest64 y.
Proof. apply round_le; [apply FLT_exp_valid, digits_53|apply valid_rnd_N]. Qed.
Lemma nearest64_lt x y : nearest64 x < nearest64 y -> x < y.
Proof. intros H. apply Rnot_le_lt. intros K. apply nearest64_le in K. lra. Qed.

Section Certain.
  Local Opaque plus minus times over root rounded below at_most floor ceiling max_coefficient max_rows.
  Variables (to : direction) (here : start_seen) (from : option (Z * Z)).
  (* The true positions of the arms, the true place of the home cell's disc, and the true rho. *)
  Variables (true_S_R true_S_L true_y true_s true_rho : R).
  Notation height_at := (height_at (val (D_R to)) (val (D_L to)) true_y).
  Notation position_at := (position_at true_S_R true_S_L true_s).
  Notation in_strip := (in_strip (val (D_R to)) (val (D_L to)) true_y true_rho).
  Notation ahead := (ahead (val (D_R to)) (val (D_L to)) true_S_R true_S_L true_y true_s true_rho).
  Notation beside := (beside (val (D_R to)) (val (D_L to)) true_S_R true_S_L true_y true_s).
  Notation reach := (reach (val (D_R to)) (val (D_L to)) true_S_R true_S_L true_rho).
  Notation area := (area_of (val (D_R to)) (val (D_L to)) true_S_R true_S_L).

  Hypothesis R_above : 0 < val (D_R to).
  Hypothesis L_below : 0 <= val (D_L to).
  Hypothesis R_forward : 0 <= true_S_R.
  Hypothesis L_forward : 0 < true_S_L.
  Hypothesis rho_positive : 0 < true_rho.
  Hypothesis rises_known : rises to = below (whole 0) (D_L to).

  Let first_n : Z := ceiling (minus (row_beside_start to here) (reach_of_rows to)).

  (* What errors allow. A decision is right; *)
  Definition strip_known : Prop := forall n m,
    match is_below (height_in_row to here n m) (rho to) (height_error to here n m) with
    | Yes => in_strip n m
    | No => if below (height_in_row to here n m) (whole 0) then height_at n m <= - true_rho
            else true_rho <= height_at n m
    | Doubtful => True
    end.
  (* positions err by at most so much; *)
  Definition positions_known : Prop := forall n m,
    Rabs (val (sum_along to here n m) - position_at n m) <= val (along_error to here n m).
  (* no row before the first comes into question, *)
  Definition first_row_known : Prop := forall n m, ahead n m -> (first_n <= n)%Z.
  (* nor any after the last; *)
  Definition last_row_known : Prop := forall n, (first_n <= n <= first_n + Z.of_nat max_rows)%Z ->
    (is_beyond_last to here None n = true -> beside + reach <= IZR n) /\
    (forall n' m', (first_n <= n' <= first_n + Z.of_nat max_rows)%Z -> ahead n' m' ->
      is_beyond_last to here (Some (Found n' m' (sum_along to here n' m') (along_error to here n' m'))) n = true ->
      beside + reach + position_at n' m' * (val (D_L to) / area) <= IZR n).
  (* in a row none comes into question before the first that is looked at; *)
  Definition starts_known : Prop := forall n m, (first_n <= n <= first_n + Z.of_nat max_rows)%Z -> ahead n m ->
    let '(m', unsure) := start_of_row to here n in
    below max_unsure unsure = false -> (ceiling (minus m' unsure) <= m)%Z.
  (* rows that are said to come one after the other do. *)
  Definition order_known : Prop := are_in_order to = true -> 2 * true_rho <= val (D_R to).
  Hypothesis strip : strip_known.
  Hypothesis positions : positions_known.
  Hypothesis first_row : first_row_known.
  Hypothesis last_row : last_row_known.
  Hypothesis starts : starts_known.
  Hypothesis order : order_known.

  Definition candidate (n m : Z) : Prop := ahead n m /\ is_cell from (cell_at to n m) = false.
  Definition is_met (f : found) : Prop := candidate (at_n f) (at_m f) /\
    found_s f = sum_along to here (at_n f) (at_m f) /\ found_error f = along_error to here (at_n f) (at_m f).
  Definition best_of (among : Z -> Z -> Prop) (b : option found) : Prop :=
    match b with
    | None => forall n m, among n m -> ~ candidate n m
    | Some f => is_met f /\ among (at_n f) (at_m f) /\ forall n m, among n m -> candidate n m ->
        (n, m) = (at_n f, at_m f) \/ position_at (at_n f) (at_m f) < position_at n m
    end.

  Lemma level : rises to = false -> val (D_L to) = 0.
  Proof.
    rewrite rises_known. destruct (below_ok (whole 0) (D_L to)) as [|Z0]; intros E; [discriminate E|].
    rewrite val_whole in Z0. lra.
  Qed.
  Lemma below_true a b : below a b = true -> val a < val b.
  Proof. destruct (below_ok a b); intros E; [assumption|discriminate E]. Qed.

  Lemma position_between n m : val (sum_along to here n m) - val (along_error to here n m) <= position_at n m /\
    position_at n m <= val (sum_along to here n m) + val (along_error to here n m).
  Proof. pose proof (positions n m) as K. apply Rabs_le_inv in K. lra. Qed.
  Lemma later n m m' : (m < m')%Z -> position_at n m < position_at n m'.
  Proof. apply later_in_row, L_forward. Qed.

  Lemma look_at_ok among best n m : best_of among best -> (first_n <= n <= first_n + Z.of_nat max_rows)%Z ->
    match look_at to here from best n m with
    | Before => ~ candidate n m
    | Taken f => at_n f = n /\ at_m f = m /\ is_met f /\
        match best with Some g => position_at n m < position_at (at_n g) (at_m g) | None => True end
    | Beyond => (forall m', (m <= m')%Z -> ~ candidate n m') \/
        exists g, best = Some g /\ position_at (at_n g) (at_m g) < position_at n m
    | Unsure => True
    end.
  Proof.
    intros B Hn. pose proof level as Level. unfold look_at. pose proof (strip n m) as S. pose proof (position_between n m) as [P1 P2].
    set (met := is_below (height_in_row to here n m) (rho to) (height_error to here n m)) in *.
    assert (Far : is_after (sum_along to here n m) (along_error to here n m) best = true ->
      exists g, best = Some g /\ position_at (at_n g) (at_m g) < position_at n m).
    { destruct best as [f|]; [|intros K; discriminate K]. intros K. exists f. split; [reflexivity|].
      destruct B as ((_ & Es & Ee) & _). unfold is_after in K. rewrite Es, Ee in K.
      apply below_true in K. rename K into L. rewrite plus_ok, minus_ok in L. apply nearest64_lt in L.
      pose proof (position_between (at_n f) (at_m f)). lra. }
    assert (Behind : below (sum_along to here n m) (neg (along_error to here n m)) = true -> ~ candidate n m).
    { intros K [[_ P] _]. apply below_true in K. rewrite val_neg in K. lra. }
    assert (Near : below (along_error to here n m) (sum_along to here n m) = true -> 0 < position_at n m).
    { intros K. apply below_true in K. lra. }
    destruct met eqn:M.
    - destruct (below (sum_along to here n m) (neg (along_error to here n m))) eqn:E1; [auto|].
      destruct (is_after (sum_along to here n m) (along_error to here n m) best) eqn:E2; [auto|].
      destruct (negb (exact_cell to n m)); [exact I|].
      destruct (is_cell from (cell_at to n m)) eqn:E3; [intros [_ K]; rewrite E3 in K; discriminate K|].
      destruct (below (along_error to here n m) (sum_along to here n m)) eqn:E4; [|exact I].
      destruct (is_before (sum_along to here n m) (along_error to here n m) best) eqn:E5; [|exact I].
      cbn [andb at_n at_m]. split; [reflexivity|]. split; [reflexivity|]. split.
      + split; [|split; reflexivity]. split; [|exact E3]. split; [exact S|apply Near; reflexivity].
      + destruct best as [g|]; [|exact I]. unfold is_before in E5.
        apply below_true in E5. rename E5 into L.
        rewrite plus_ok, minus_ok in L. apply nearest64_lt in L. destruct B as ((_ & Es & Ee) & _).
        rewrite Es, Ee in L. pose proof (position_between (at_n g) (at_m g)). lra.
    - destruct (below (height_in_row to here n m) (whole 0)) eqn:E; cbn [orb].
      + left. intros m' Hm [[K _] _]. unfold Rows.in_strip in K. apply Rabs_def2 in K.
        pose proof (next_in_row (val (D_R to)) (val (D_L to)) true_S_R true_S_L true_y true_s L_below L_forward
          n m m' Hm) as [N _]. lra.
      + destruct (rises to) eqn:Er; cbn [negb].
        * intros [[K _] _]. unfold Rows.in_strip in K. apply Rabs_def2 in K. lra.
        * left. intros m' Hm [[K _] _]. unfold Rows.in_strip in K. apply Rabs_def2 in K.
          pose proof (Level eq_refl) as Z1. unfold Rows.height_at in *.
          rewrite Z1 in *. lra.
    - destruct (below (sum_along to here n m) (neg (along_error to here n m))) eqn:E1; [auto|].
      destruct (is_after (sum_along to here n m) (along_error to here n m) best) eqn:E2; [auto|].
      destruct (negb (exact_cell to n m)); [exact I|].
      destruct (is_cell from (cell_at to n m)) eqn:E3; [intros [_ K]; rewrite E3 in K; discriminate K|exact I].
  Qed.

  Definition rows_before (n : Z) (n' m' : Z) : Prop := (first_n <= n' < n)%Z.
  Lemma look_from_ok candidates : forall best n m b, (first_n <= n <= first_n + Z.of_nat max_rows)%Z ->
    best_of (rows_before n) best -> (forall m', (m' < m)%Z -> ~ candidate n m') ->
    look_from to here from candidates best n m = Some b -> best_of (rows_before (n + 1)) b.
  Proof.
    induction candidates as [|candidates IH]; [intros ? ? ? ? _ _ _ E; discriminate E|].
    intros best n m b Hn B Skipped. cbn [look_from].
    pose proof (look_at_ok (rows_before n) best n m B Hn) as K.
    destruct (look_at to here from best n m) as [|f| |].
    - apply (IH best n (m + 1)%Z b Hn B). intros m' Hm. destruct (Z.eq_dec m' m) as [->|N]; [exact K|].
      apply Skipped. lia.
    - intros E. injection E as <-. destruct K as (E1 & E2 & Met & Sooner). unfold best_of. rewrite E1, E2.
      split; [exact Met|]. split; [unfold rows_before; lia|]. intros n' m' Hn' C.
      destruct (Z.eq_dec n' n) as [->|N].
      + destruct (Z.lt_trichotomy m' m) as [L|[->|L]]; [|left; reflexivity|right; apply later; exact L].
        destruct (Skipped m' L C).
      + assert (Old : rows_before n n' m') by (unfold rows_before in *; lia). right.
        destruct best as [g|]; [|destruct (B n' m' Old C)]. destruct B as (_ & _ & B).
        destruct (B n' m' Old C) as [E|L]; [|lra]. injection E as -> ->. exact Sooner.
    - intros E. injection E as <-. destruct K as [K|(g & -> & K)].
      + destruct best as [g|].
        * destruct B as (Met & Among & B). split; [exact Met|]. split; [unfold rows_before in *; lia|].
          intros n' m' Hn' C. destruct (Z.eq_dec n' n) as [->|N]; [|apply B; [unfold rows_before in *; lia|exact C]].
          destruct (Z_lt_le_dec m' m) as [L|L]; [destruct (Skipped m' L C)|destruct (K m' L C)].
        * intros n' m' Hn' C. destruct (Z.eq_dec n' n) as [->|N]; [|apply (B n' m');
            [unfold rows_before in *; lia|exact C]].
          destruct (Z_lt_le_dec m' m) as [L|L]; [destruct (Skipped m' L C)|destruct (K m' L C)].
      + destruct B as (Met & Among & B). split; [exact Met|]. split; [unfold rows_before in *; lia|].
        intros n' m' Hn' C. destruct (Z.eq_dec n' n) as [->|N]; [|apply B; [unfold rows_before in *; lia|exact C]].
        destruct (Z_lt_le_dec m' m) as [L|L]; [destruct (Skipped m' L C)|right].
        pose proof (proj2 (next_in_row (val (D_R to)) (val (D_L to)) true_S_R true_S_L true_y true_s L_below
          L_forward n m m' L)). lra.
    - intros E. discriminate E.
  Qed.
  Lemma look_in_row_ok best n b : (first_n <= n <= first_n + Z.of_nat max_rows)%Z ->
    best_of (rows_before n) best -> look_in_row to here from best n = Some b -> best_of (rows_before (n + 1)) b.
  Proof.
    intros Hn B. unfold look_in_row. pose proof (fun m => starts n m Hn) as K.
    destruct (start_of_row to here n) as [m' unsure]. destruct (below max_unsure unsure); [intros E; discriminate E|].
    apply look_from_ok; auto. intros m Hm [A _]. specialize (K m A eq_refl). lia.
  Qed.

  Definition everywhere (n m : Z) : Prop := True.
  Lemma look_in_rows_ok rows : forall best n b, n = (first_n + Z.of_nat (max_rows - rows))%Z -> (rows <= max_rows)%nat ->
    best_of (rows_before n) best -> look_in_rows to here from rows best n = Some b -> best_of everywhere b.
  Proof.
    induction rows as [|rows IH]; [intros ? ? ? _ _ _ E; discriminate E|].
    intros best n b En Hr B. pose proof level as Level.
    cbn [look_in_rows].
    assert (Hn : (first_n <= n <= first_n + Z.of_nat max_rows)%Z) by lia.
    destruct (is_beyond_last to here best n) eqn:EB.
    - intros E. injection E as <-. destruct (last_row n Hn) as [L1 L2].
      assert (Old : forall n' m', candidate n' m' -> (n' < n)%Z -> rows_before n n' m').
      { intros n' m' C L. split; [apply (first_row n' m'), C|exact L]. }
      destruct best as [f|].
      + destruct B as (Met & Among & B). split; [exact Met|]. split; [exact I|]. intros n' m' _ C.
        destruct (Z_lt_le_dec n' n) as [L|L]; [apply B; [apply Old; auto|exact C]|right].
        apply Rnot_le_lt. intros P. destruct C as [A _].
        pose proof (Rows.last_row (val (D_R to)) (val (D_L to)) true_S_R true_S_L true_y true_s true_rho R_above
          L_below R_forward L_forward rho_positive n' m' _ A P) as Last.
        destruct f as [nf mf sf ef]. destruct Met as ([Af _] & Es & Ee).
        cbn [at_n at_m found_s found_error] in *. subst sf ef.
        unfold rows_before in Among. specialize (L2 nf mf ltac:(lia) Af EB). apply IZR_le in L. lra.
      + intros n' m' _ C. destruct (Z_lt_le_dec n' n) as [L|L]; [apply (B n' m' (Old n' m' C L) C)|].
        destruct C as [A _]. specialize (L1 EB).
        assert (Z1 : val (D_L to) = 0).
        { unfold is_beyond_last in EB. apply Level. destruct (rises to); [discriminate EB|reflexivity]. }
        pose proof (Rows.last_row (val (D_R to)) (val (D_L to)) true_S_R true_S_L true_y true_s true_rho R_above
          L_below R_forward L_forward rho_positive n' m' _ A (Rle_refl _)) as Last.
        rewrite Z1 in Last at 3. apply IZR_le in L. unfold Rdiv in Last.
        rewrite Rmult_0_l, Rmult_0_r, Rplus_0_r in Last. lra.
    - destruct (look_in_row to here from best n) as [b'|] eqn:ER; [|intros E; discriminate E].
      pose proof (look_in_row_ok best n b' Hn B ER) as B'.
      destruct b' as [f|].
      + destruct (are_in_order to) eqn:EO.
        * intros E. injection E as <-. destruct B' as (Met & Among & B'). split; [exact Met|].
          split; [exact I|]. intros n' m' _ C. destruct (Z_le_gt_dec n' n) as [L|L].
          -- apply B'; [|exact C]. split; [apply (first_row n' m'), C|lia].
          -- right. apply (rows_in_order (val (D_R to)) (val (D_L to)) true_S_R true_S_L true_y true_s true_rho);
               auto; [apply Met|apply C|unfold rows_before in Among; lia].
        * apply IH; [lia|lia|exact B'].
      + apply IH; [lia|lia|exact B'].
  Qed.

  (* Of all balls in the strip ahead, but `from`, the one that is found is the first; or there is none. *)
  Theorem search_certain b : search to here from = Some b -> best_of everywhere b.
  Proof.
    unfold search. destruct (below (plus _ _) _); [|intros E; discriminate E].
    apply look_in_rows_ok; [fold first_n; rewrite Nat.sub_diag; cbn [Z.of_nat]; lia|lia|].
    intros n m H. unfold rows_before in H. fold first_n in H. lia.
  Qed.
End Certain.
