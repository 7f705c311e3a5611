(* docs/certificates.md, "What is claimed": hit, inside and never, of all atoms together. *)
From Coq Require Import ZArith Reals Lra Lia List Bool.
From Lorentz Require Import Spec Time Vectors Steps Space View Quadratic Windows.
Import ListNotations.
Local Open Scope Z_scope.

(* ---- The order of obstacles. *)
Fixpoint compare_numbers (a b : list Z) : comparison :=
  match a, b with
  | [], [] => Eq
  | i :: a, j :: b => match i ?= j with Eq => compare_numbers a b | c => c end
  | _, _ => Gt
  end.
Definition compare (o o' : obstacle) : comparison := compare_numbers (name o) (name o').

Lemma compare_numbers_ok a : forall b, match compare_numbers a b with
  Lt => less a b | Eq => a = b | Gt => True end.
Proof.
  induction a as [|i a IH]; intros [|j b]; cbn [compare_numbers less]; auto.
  destruct (Z.compare_spec i j); auto. subst j. specialize (IH b). destruct (compare_numbers a b); auto.
  congruence.
Qed.
Lemma compare_refl o : compare o o = Eq.
Proof. unfold compare. induction (name o) as [|i a IH]; cbn; [auto|]. rewrite Z.compare_refl. exact IH. Qed.
Lemma compare_ok o o' : match compare o o' with Lt => less (name o) (name o') | Eq => o = o' | Gt => True end.
Proof.
  pose proof (compare_numbers_ok (name o) (name o')) as K. unfold compare.
  destruct (compare_numbers _ _); auto.
  destruct o, o'. injection K. intros. subst. reflexivity.
Qed.

Definition comes_after (X o : obstacle) : bool := match compare X o with Gt => false | _ => true end.
Lemma comes_after_ok X o : comes_after X o = true -> not_after X o.
Proof. unfold comes_after, not_after. pose proof (compare_ok X o). destruct compare; auto; discriminate. Qed.

Definition is_from (from : option obstacle) (o : obstacle) : bool :=
  match from with None => false | Some f => match compare f o with Eq => true | _ => false end end.
Lemma is_from_yes from o : is_from from o = true -> from = Some o.
Proof.
  unfold is_from. destruct from as [f|]; [|discriminate]. pose proof (compare_ok f o).
  destruct compare; congruence.
Qed.
Lemma is_from_no from o : is_from from o = false -> from <> Some o.
Proof. intros H ->. unfold is_from in H. rewrite compare_refl in H. discriminate. Qed.

(* ---- All atoms, as the ray sees them. *)
Record sight := Sight { its_lattice : Z; its_atom : Z; its_view : seen }.

(* Each with the certificate's pieces for it. *)
Fixpoint look_on {A} (sights : list A) (pieces : list (list written_piece))
  (got : list (A * list written_piece)) : list (A * list written_piece) :=
  match sights with [] => got | a :: sights => look_on sights (tl pieces) ((a, hd [] pieces) :: got) end.
Definition look {A} (sights : list A) (pieces : list (list written_piece)) := rev_append (look_on sights pieces []) [].
Lemma look_in {A} (sights : list A) pieces a : In a sights -> exists ws, In (a, ws) (look sights pieces).
Proof.
  unfold look. rewrite rev_append_rev, app_nil_r. intros H.
  enough (exists ws, In (a, ws) (look_on sights pieces [])) as [ws K] by (exists ws; rewrite <- in_rev; exact K).
  revert H. generalize (@nil (A * list written_piece)). revert pieces.
  assert (K : forall (l : list A) pieces got b, In b got -> In b (look_on l pieces got)).
  { clear. induction l as [|a l IH]; cbn [look_on]; auto. intros pieces got b H. apply IH. right. exact H. }
  induction sights as [|b sights IH]; cbn; [tauto|]. intros pieces got [->|Ha]; [|exact (IH _ _ Ha)].
  exists (hd [] pieces). apply K. left. reflexivity.
Qed.

Section Claims.
  Variables (sights : list sight) (from : option obstacle) (pieces rows : list (list written_piece)).

  Definition obstacle_at (a : sight) (n : zv) : obstacle := Obstacle (its_lattice a) (its_atom a)
    (coordinates (sk (its_view a)) n).
  Definition time_of (y : seen) (n : zv) : time := let W := at_cell y n in Time (sS y W) (sD y W) (sQ y).
  Definition gap_after (a : sight) : flaw := GapAfter (its_lattice a) (its_atom a).

  (* "no obstacle except `from` contains x", and "each obstacle that the ray enters, except X and `from`, is
     entered later than X, or at the same t and comes after X in the order". *)
  Definition judge_hit (X : obstacle) (t : time) (a : sight) (n : zv) (u : time) : check :=
    let o := obstacle_at a n in
    if is_from from o then done
    else if ts u * ts u <? td u then fail (ComesFirst o)
    else if ts u <=? 0 then done
    else require (match order u t with Lt => false | Eq => comes_after X o | Gt => true end) (ComesFirst o).
  Definition check_hit (a : sight) (n : zv) : check :=
    let X := obstacle_at a n in let t := time_of (its_view a) n in
    require (negb (is_from from X) && (0 <? td t) && (0 <? ts t) && (td t <=? ts t * ts t)) NotTheOutcome ;;
    each_in (look sights pieces) (fun b => let (b, ws) := b in
      check_windows (its_view b) ws (Until t) (gap_after b) (judge_hit X t b)).

  (* "X contains x, and X is not `from`", and "no obstacle that comes before X in the order contains x, except
     `from`". It suffices to look at X's atom and the atoms before it. *)
  Definition not_after_atom (a b : sight) : bool :=
    match compare_numbers [its_lattice b; its_atom b] [its_lattice a; its_atom a] with
    | Gt => false | _ => true end.
  Definition judge_inside (X : obstacle) (a : sight) (n : zv) (u : time) : check :=
    let o := obstacle_at a n in
    if is_from from o then done else require (negb (ts u * ts u <? td u) || comes_after X o) (ComesFirst o).
  Definition check_inside (a : sight) (n : zv) : check :=
    let X := obstacle_at a n in let t := time_of (its_view a) n in
    require (negb (is_from from X) && (ts t * ts t <? td t)) NotTheOutcome ;;
    each_in (look sights pieces) (fun b => let (b, ws) := b in
      let until := if not_after_atom a b then Until (Time 0 0 1) else Nothing in
      check_windows (its_view b) ws until (gap_after b) (judge_inside X b)).

  (* "No obstacle of a window may contain x or be entered, except the query's `from`." No row may be met, not
     even that of `from`. *)
  Definition judge_never (a : sight) (n : zv) (u : time) : check :=
    let o := obstacle_at a n in
    require (is_from from o || (ts u <=? 0) && (td u <=? ts u * ts u)) (Met o).
  Definition check_never : check :=
    each_in (look (look sights pieces) rows) (fun b => let '(a, ws, rs) := b in
      match rs, ws with
      | [], _ => check_windows (its_view a) ws Forever (gap_after a) (judge_never a)
      | [r], [] => check_row (its_view a) r (fun n => Met (obstacle_at a n))
      | _, _ => fail (NoRows (its_lattice a) (its_atom a))
      end).

  (* ---- What makes these lists of integers the question: the obstacles are those of the sights, and their
     chords these. *)
  Variable within : obstacle -> R -> Prop.
  Hypothesis regular_sights : forall a, In a sights -> 0 < sQ (its_view a) /\ 0 <= sr (its_view a).
  Hypothesis seen_all : forall o t, within o t -> exists a n, In a sights /\ fits (sk (its_view a)) n /\
    o = obstacle_at a n.
  Hypothesis chords : forall a n t, In a sights -> fits (sk (its_view a)) n ->
    let y := its_view a in let W := at_cell y n in
    within (obstacle_at a n) t <-> ((IZR (sQ y) * t - IZR (sS y W)) * (IZR (sQ y) * t - IZR (sS y W)) <
      IZR (sD y W))%R.

  Lemma enters_seen o t : enters within o t -> exists a n, In a sights /\ fits (sk (its_view a)) n /\
    o = obstacle_at a n.
  Proof. intros (_ & _ & K). destruct (K (t + 1)%R ltac:(lra)) as (t' & Ht & _). exact (seen_all _ _ Ht). Qed.
  Lemma time_of_regular a n : In a sights -> 0 < td (time_of (its_view a) n) ->
    regular (time_of (its_view a) n).
  Proof. intros Ha Hd. split; [lia|]. apply regular_sights, Ha. Qed.

  Lemma entered a n t : In a sights -> fits (sk (its_view a)) n -> let u := time_of (its_view a) n in
    enters within (obstacle_at a n) t <-> 0 < td u /\ t = time_value u /\ 0 < ts u /\ td u <= ts u * ts u.
  Proof.
    intros Ha Hn u. apply enters_iff; [apply regular_sights, Ha|]. intros t'. apply chords; auto.
  Qed.
  Lemma contained a n : In a sights -> fits (sk (its_view a)) n -> let u := time_of (its_view a) n in
    within (obstacle_at a n) 0 <-> ts u * ts u < td u.
  Proof.
    intros Ha Hn u. apply (contains_iff (within (obstacle_at a n)) _ _ (sQ (its_view a))). intros t'.
    apply chords; auto.
  Qed.

  Theorem check_hit_ok a n : In a sights -> fits (sk (its_view a)) n -> passes (check_hit a n) ->
    first_hit within from (obstacle_at a n) (time_value (time_of (its_view a) n)).
  Proof.
    intros Ha Hn H. unfold check_hit in H. set (X := obstacle_at a n) in *.
    set (t := time_of (its_view a) n) in *.
    apply passes_both in H. destruct H as [H Hall]. apply passes_require in H.
    rewrite !andb_true_iff, negb_true_iff, !Z.ltb_lt, Z.leb_le in H. destruct H as [[[Hf HD] Hs] HDs].
    assert (EX : enters within X (time_value t)) by (apply entered; auto).
    assert (Ht : regular t) by (apply time_of_regular; auto).
    assert (V0 : (0 <= time_value t)%R) by apply EX.
    (* Every obstacle that matters has been judged. *)
    assert (J : forall b m, In b sights -> fits (sk (its_view b)) m -> let u := time_of (its_view b) m in
      from <> Some (obstacle_at b m) -> 0 < td u -> 0 < ts u \/ ts u * ts u < td u ->
        (time_value u <= time_value t)%R ->
      td u <= ts u * ts u /\ (0 < ts u -> time_value t = time_value u /\ not_after X (obstacle_at b m))).
    { intros b m Hb Hm u Ho HDu Hsu HV. destruct (look_in _ pieces _ Hb) as [ws Hws].
      pose proof (each_in_ok _ _ Hall _ Hws) as K. cbv beta iota in K.
      apply (fun H => check_windows_ok (its_view b) ws (Until t) _ _ (proj1 (regular_sights b Hb)) H m Hm) in K;
        auto; [|split; auto].
      fold u in K. unfold judge_hit in K. cbn [ts td] in K.
      change (sS (its_view b) (at_cell (its_view b) m)) with (ts u) in K.
      change (sD (its_view b) (at_cell (its_view b) m)) with (td u) in K.
      change (Time (ts u) (td u) (sQ (its_view b))) with u in K.
      destruct (is_from from (obstacle_at b m)) eqn:EF; [apply is_from_yes in EF; contradiction|].
      destruct (Z.ltb_spec (ts u * ts u) (td u)); [apply passes_fail in K; tauto|]. split; [auto|].
      intros Hs0.
      destruct (Z.leb_spec (ts u) 0); [lia|]. apply passes_require in K.
      pose proof (order_ok u t (time_of_regular b m Hb HDu) Ht) as O.
      destruct (order u t); simpl in O; [|discriminate|lra]. split; [auto|apply comes_after_ok; auto]. }
    split; [apply is_from_no; auto|]. split; [exact EX|]. split.
    - intros o Ho C. destruct (seen_all _ _ C) as (b & m & Hb & Hm & ->). apply contained in C; auto.
      cbv zeta in C.
      set (u := time_of (its_view b) m) in *. assert (Dp : 0 < td u) by nia.
      destruct (J b m Hb Hm Ho Dp (or_intror C)) as [K _]; [|fold u in K; lia].
      apply Rle_trans with 0%R; [|exact V0]. apply begins_nonpos; [apply regular_sights, Hb|exact C].
    - intros o t' Ho En. destruct (enters_seen _ _ En) as (b & m & Hb & Hm & ->). apply entered in En; auto.
      cbv zeta in En.
      set (u := time_of (its_view b) m) in *. destruct En as (Dp & -> & Sp & Ds).
      destruct (Rlt_le_dec (time_value t) (time_value u)) as [L|L]; [left; auto|right]. apply (J b m); auto.
  Qed.

  Lemma later_atom a b n m : not_after_atom a b = false -> not_after (obstacle_at a n) (obstacle_at b m).
  Proof using.
    unfold not_after_atom, not_after, name, obstacle_at. cbn. intros H. right.
    destruct (Z.compare_spec (its_lattice b) (its_lattice a)); [|discriminate|left; lia].
    destruct (Z.compare_spec (its_atom b) (its_atom a)); [discriminate|discriminate|]. right.
    split; [auto|left; lia].
  Qed.

  Theorem check_inside_ok a n : In a sights -> fits (sk (its_view a)) n -> passes (check_inside a n) ->
    first_inside within from (obstacle_at a n).
  Proof.
    intros Ha Hn H. unfold check_inside in H. set (X := obstacle_at a n) in *.
    set (t := time_of (its_view a) n) in *.
    apply passes_both in H. destruct H as [H Hall]. apply passes_require in H.
    rewrite !andb_true_iff, negb_true_iff, Z.ltb_lt in H. destruct H as [Hf HC].
    split; [apply is_from_no; auto|]. split; [apply contained; auto|].
    intros o Ho C. destruct (seen_all _ _ C) as (b & m & Hb & Hm & ->).
    destruct (not_after_atom a b) eqn:U; [|apply later_atom; auto].
    apply contained in C; auto. cbv zeta in C. set (u := time_of (its_view b) m) in *.
    assert (Dp : 0 < td u) by nia.
    destruct (look_in _ pieces _ Hb) as [ws Hws].
    pose proof (each_in_ok _ _ Hall _ Hws) as K. cbv beta iota zeta in K. rewrite U in K.
    assert (R1 : regular (Time 0 0 1)) by (split; cbn; lia).
    assert (V1 : time_value (Time 0 0 1) = 0%R) by (unfold time_value; cbn [ts td tq]; rewrite sqrt_0; field).
    apply (fun H => check_windows_ok (its_view b) ws _ _ _ (proj1 (regular_sights b Hb)) H m Hm) in K; auto.
    - unfold judge_inside in K. cbn [ts td] in K.
      destruct (is_from from (obstacle_at b m)) eqn:EF; [apply is_from_yes in EF; contradiction|].
      apply passes_require in K.
      change (sS (its_view b) (at_cell (its_view b) m)) with (ts u) in K.
      change (sD (its_view b) (at_cell (its_view b) m)) with (td u) in K.
      rewrite (proj2 (Z.ltb_lt _ _) C) in K. apply comes_after_ok. exact K.
    - split; [exact R1|]. rewrite V1. apply begins_nonpos; [apply regular_sights, Hb|exact C].
  Qed.

  Theorem check_never_ok : passes check_never -> nothing within from.
  Proof.
    intros Hall. assert (N : forall a n, In a sights -> fits (sk (its_view a)) n -> from <> Some (obstacle_at a n) ->
      let u := time_of (its_view a) n in ~ 0 < td u \/ ts u <= 0 /\ td u <= ts u * ts u).
    { intros a n Ha Hn Hf u. destruct (look_in _ pieces _ Ha) as [ws Hws].
      destruct (look_in _ rows _ Hws) as [rs Hrs].
      pose proof (each_in_ok _ _ Hall _ Hrs) as K. cbv beta iota in K.
      destruct (Z_lt_le_dec 0 (td u)) as [D|D]; [right|left; lia].
      destruct rs as [|r [|r' rs]]; [| |apply passes_fail in K; tauto].
      - assert (J : 0 < ts u \/ ts u * ts u < td u -> False); [|lia]. intros B.
        pose proof (check_windows_ok (its_view a) ws Forever _ _ (proj1 (regular_sights a Ha)) K n Hn D B I) as J.
        apply passes_require in J. cbn [ts td] in J.
        change (sS (its_view a) (at_cell (its_view a) n)) with (ts u) in J.
        change (sD (its_view a) (at_cell (its_view a) n)) with (td u) in J.
        rewrite orb_true_iff, andb_true_iff, !Z.leb_le in J. destruct J as [J|J]; [|lia].
        apply is_from_yes in J. contradiction.
      - destruct ws; [|apply passes_fail in K; tauto]. exfalso. exact (check_row_ok _ r _ K n Hn D). }
    intros o Ho. split.
    - intros C. destruct (seen_all _ _ C) as (a & n & Ha & Hn & ->). apply contained in C; auto. cbv zeta in C.
      destruct (N a n Ha Hn Ho); nia.
    - intros t En. destruct (enters_seen _ _ En) as (a & n & Ha & Hn & ->). apply entered in En; auto.
      cbv zeta in En. destruct (N a n Ha Hn Ho); lia.
  Qed.
End Claims.
