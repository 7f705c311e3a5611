(* docs/reduction.md, "Which is first": "Balls of one radius that do not overlap (2 r at most the shortest lattice
   vector) are entered in the order of their centres, so s orders them. A ball in the strip is entered at t >= 0
   iff s > 0, if x is not inside it".
   Here: discs around the integer points of the plane. *)
From Coq Require Import ZArith Reals Lra Lia Psatz List.
From Flocq Require Import Core.
From Lorentz Require Import Spec Sanity.
From Lorentz Require Examples.
Import ListNotations.
Local Open Scope R_scope.

(* One disc in the unit square, and a flight. *)
Definition unit_square (r : numeral) : scene :=
  Scene 2 [Lattice [[Decimal 1 0; Decimal 0 0]; [Decimal 0 0; Decimal 1 0]]
    [Atom [Decimal 0 0; Decimal 0 0] (Radius r)]].
Definition disc (i j : Z) : obstacle := Obstacle 0 0 [i; j].
Definition lies_in (sc : scene) (q : query) (o : obstacle) (t : R) : Prop :=
  occupied sc o (along (point (start q)) t (point (velocity q))).

Lemma disc_is r o x y : 0 < value r -> occupied (unit_square r) o [x; y] <->
  exists i j, o = disc i j /\ (x - IZR i) * (x - IZR i) + (y - IZR j) * (y - IZR j) < value r * value r.
Proof.
  intros Hr. split.
  - intros (L & A & HA & K). destruct (Examples.only_atom _ _ _ _ HA _ _ eq_refl eq_refl) as (El & Ea & -> & ->).
    destruct HA as (_ & _ & Hc). destruct o as [l a n]. cbn in El, Ea, Hc, K. subst.
    destruct n as [|i [|j [|k n]]]; try discriminate. exists i, j. split; [reflexivity|].
    apply norm_less in K; [|lra]. cbn in K. rewrite ?value_0, ?value_1 in K. lra.
  - intros (i & j & -> & K). do 2 eexists. split; [split; [reflexivity|split; reflexivity]|]. cbn [shape_of].
    apply norm_less; [lra|]. cbn. rewrite ?value_0, ?value_1. lra.
Qed.
Lemma disc_injective i j i' j' : disc i j = disc i' j' -> i = i' /\ j = j'.
Proof. intros E. injection E. auto. Qed.

Section Line.
  Variables (x0 x1 v0 v1 r : R).
  Hypothesis moves : 0 < v0 * v0 + v1 * v1.
  Hypothesis radius_positive : 0 < r.
  Hypothesis radius_small : 2 * r <= 1.
  Notation V := (v0 * v0 + v1 * v1).
  Variables (within : obstacle -> R -> Prop) (from : option obstacle).
  Hypothesis discs_are : forall o t, within o t <-> exists i j, o = disc i j /\
    (x0 + t * v0 - IZR i) * (x0 + t * v0 - IZR i) + (x1 + t * v1 - IZR j) * (x1 + t * v1 - IZR j) < r * r.

  (* The centre as the line sees it: along, and across. *)
  Definition along_line (i j : Z) : R := v0 * (IZR i - x0) + v1 * (IZR j - x1).
  Definition across_line (i j : Z) : R := v0 * (IZR j - x1) - v1 * (IZR i - x0).
  Definition meets (i j : Z) : Prop := across_line i j * across_line i j < r * r * V.
  Definition half_chord (i j : Z) : R := sqrt (r * r * V - across_line i j * across_line i j).
  Definition entry (i j : Z) : R := (along_line i j - half_chord i j) / V.

  Lemma within_disc i j t : within (disc i j) t <->
    (V * t - along_line i j) * (V * t - along_line i j) < r * r * V - across_line i j * across_line i j.
  Proof.
    rewrite discs_are. unfold along_line, across_line. split.
    - intros (i' & j' & E & K). apply disc_injective in E. destruct E as [<- <-].
      apply Rmult_lt_compat_r with (r := V) in K; [|exact moves]. lra.
    - intros K. exists i, j. split; [reflexivity|]. apply Rmult_lt_reg_r with V; [exact moves|]. lra.
  Qed.
  Lemma chord i j t : meets i j ->
    within (disc i j) t <-> entry i j < t < (along_line i j + half_chord i j) / V.
  Proof.
    intros M. rewrite within_disc. unfold entry, half_chord, meets in *. set (s := along_line i j) in *.
    set (d := r * r * V - across_line i j * across_line i j) in *.
    assert (D : 0 < d) by (unfold d; lra). pose proof (sqrt_lt_R0 _ D) as Q.
    pose proof (sqrt_sqrt d (Rlt_le _ _ D)) as Q2. set (q := sqrt d) in *. rewrite <- Q2.
    assert (A1 : s - q = V * ((s - q) / V)) by (field; lra).
    assert (A2 : s + q = V * ((s + q) / V)) by (field; lra).
    set (b := (s - q) / V) in *. set (e := (s + q) / V) in *. split.
    - intros K. assert (s - q < V * t < s + q) by (split; nra). split; nra.
    - intros [K1 K2]. assert (s - q < V * t < s + q) by (split; nra). nra.
  Qed.
  Lemma half_chord_positive i j : meets i j -> 0 < half_chord i j.
  Proof. unfold meets. intros M. apply sqrt_lt_R0. lra. Qed.
  Lemma within_meets i j t : within (disc i j) t -> meets i j.
  Proof. rewrite within_disc. unfold meets. intros K. pose proof (Rle_0_sqr (V * t - along_line i j)) as S.
    unfold Rsqr in S. lra. Qed.
  Lemma within_is_disc o t : within o t -> exists i j, o = disc i j.
  Proof. rewrite discs_are. intros (i & j & -> & _). eauto. Qed.
  Lemma enters_disc i j t : enters within (disc i j) t <-> meets i j /\ 0 <= t /\ t = entry i j.
  Proof.
    split.
    - intros En. assert (M : meets i j).
      { destruct En as (_ & _ & N). destruct (N (t + 1) ltac:(lra)) as (t' & K & _). eapply within_meets, K. }
      split; [exact M|]. pose proof (half_chord_positive i j M) as Q.
      apply (enters_interval within (disc i j) (entry i j) ((along_line i j + half_chord i j) / V)) in En.
      + exact En.
      + unfold entry. apply Rmult_lt_compat_r; [apply Rinv_0_lt_compat, moves|lra].
      + intros t'. apply chord, M.
    - intros (M & H). pose proof (half_chord_positive i j M) as Q.
      apply (enters_interval within (disc i j) (entry i j) ((along_line i j + half_chord i j) / V)).
      + unfold entry. apply Rmult_lt_compat_r; [apply Rinv_0_lt_compat, moves|lra].
      + intros t'. apply chord, M.
      + exact H.
  Qed.

  (* No point lies in two discs. *)
  Lemma apart i j i' j' t : within (disc i j) t -> within (disc i' j') t -> i = i' /\ j = j'.
  Proof.
    rewrite !discs_are. intros (i1 & j1 & E & K) (i2 & j2 & E' & K'). apply disc_injective in E, E'.
    destruct E as [<- <-], E' as [<- <-].
    set (a := x0 + t * v0) in *. set (b := x1 + t * v1) in *.
    assert (D : IZR ((i - i') * (i - i') + (j - j') * (j - j')) < 1).
    { rewrite plus_IZR, !mult_IZR, !minus_IZR.
      pose proof (Rle_0_sqr (a - IZR i + (a - IZR i'))) as S1.
      pose proof (Rle_0_sqr (b - IZR j + (b - IZR j'))) as S2. unfold Rsqr in *.
      assert (4 * (r * r) <= 1) by nra. lra. }
    apply (lt_IZR _ 1) in D. pose proof (Z.square_nonneg (i - i')). pose proof (Z.square_nonneg (j - j')).
    assert ((i - i') * (i - i') = 0)%Z as Ei by lia. assert ((j - j') * (j - j') = 0)%Z as Ej by lia.
    apply Z.mul_eq_0 in Ei, Ej. lia.
  Qed.
  (* If the line meets two, the one with the nearer centre is entered earlier. *)
  Lemma entered_in_order i j i' j' : meets i j -> meets i' j' -> along_line i j < along_line i' j' ->
    entry i j < entry i' j'.
  Proof.
    intros M M' L. pose proof (half_chord_positive i j M) as Q. pose proof (half_chord_positive i' j' M') as Q'.
    apply Rnot_le_lt. intros K.
    assert (I : 0 < / V) by (apply Rinv_0_lt_compat, moves).
    assert (E : along_line i' j' - half_chord i' j' <= along_line i j - half_chord i j).
    { unfold entry, Rdiv in K. apply Rmult_le_reg_r with (/ V); auto. }
    (* the middle of the first chord is in both *)
    assert (W : within (disc i j) (along_line i j / V)).
    { apply chord; [exact M|]. unfold entry, Rdiv. split; apply Rmult_lt_compat_r; lra. }
    assert (W' : within (disc i' j') (along_line i j / V)).
    { apply chord; [exact M'|]. unfold entry, Rdiv. split; apply Rmult_lt_compat_r; lra. }
    destruct (apart _ _ _ _ _ W W') as [-> ->]. lra.
  Qed.

  Lemma entered_ahead i j : meets i j -> 0 <= entry i j -> 0 < along_line i j.
  Proof.
    intros M T0. pose proof (half_chord_positive i j M) as Q. apply Rnot_le_lt. intros N. unfold entry, Rdiv in T0.
    pose proof (Rinv_0_lt_compat _ moves). nra.
  Qed.

  (* x lies in no disc but `from`; of all discs that the line meets ahead, but `from`, the centre of this one is
     the first: then this disc is. *)
  Theorem first_by_position i j : from <> Some (disc i j) -> meets i j -> 0 < along_line i j ->
    (forall i' j', from <> Some (disc i' j') -> ~ within (disc i' j') 0) ->
    (forall i' j', from <> Some (disc i' j') -> meets i' j' -> 0 < along_line i' j' ->
      (i', j') = (i, j) \/ along_line i j < along_line i' j') ->
    first_hit within from (disc i j) (entry i j).
  Proof.
    intros F M S Out First.
    assert (Ahead : forall i' j', from <> Some (disc i' j') -> meets i' j' -> 0 < along_line i' j' ->
      0 <= entry i' j').
    { intros i' j' F' M' S'. apply Rnot_lt_le. intros N. apply (Out i' j' F'). apply chord; [exact M'|].
      split; [exact N|]. pose proof (half_chord_positive i' j' M').
      apply Rmult_lt_0_compat; [lra|apply Rinv_0_lt_compat, moves]. }
    split; [exact F|]. split; [apply enters_disc; auto|]. split.
    - intros o Fo W. destruct (within_is_disc o 0 W) as (i' & j' & ->). exact (Out i' j' Fo W).
    - intros o t Fo En. assert (exists i' j', o = disc i' j') as (i' & j' & ->).
      { destruct En as (_ & _ & N). destruct (N (t + 1) ltac:(lra)) as (t' & K & _). eapply within_is_disc, K. }
      apply enters_disc in En. destruct En as (M' & T0 & ->).
      pose proof (entered_ahead i' j' M' T0) as S'.
      destruct (First i' j' Fo M' S') as [E|L].
      + injection E as -> ->. right. split; [reflexivity|left; reflexivity].
      + left. apply entered_in_order; auto.
  Qed.
  Theorem nothing_by_position : (forall i j, from <> Some (disc i j) -> ~ within (disc i j) 0) ->
    (forall i j, from <> Some (disc i j) -> meets i j -> ~ 0 < along_line i j) -> nothing within from.
  Proof.
    intros Out None o Fo. split.
    - intros W. destruct (within_is_disc o 0 W) as (i & j & ->). exact (Out i j Fo W).
    - intros t En. assert (exists i j, o = disc i j) as (i & j & ->).
      { destruct En as (_ & _ & N). destruct (N (t + 1) ltac:(lra)) as (t' & K & _). eapply within_is_disc, K. }
      apply enters_disc in En. destruct En as (M & T0 & ->). exact (None i j Fo M (entered_ahead i j M T0)).
  Qed.
  (* Where x is at most half a cell from an integer point in each coordinate, no other disc contains it. *)
  Lemma home_only i j i' j' : Rabs (x0 - IZR i) <= 1 / 2 -> Rabs (x1 - IZR j) <= 1 / 2 ->
    within (disc i' j') 0 -> i' = i /\ j' = j.
  Proof.
    rewrite discs_are. intros H0 H1 (i2 & j2 & E & K). apply disc_injective in E. destruct E as [<- <-].
    rewrite !Rmult_0_l, !Rplus_0_r in K.
    assert (A : forall (a : R) (n m : Z), Rabs (a - IZR n) <= 1 / 2 -> (a - IZR m) * (a - IZR m) < r * r -> m = n).
    { clear -radius_small radius_positive. intros a n m H K. assert (Hn : - (1 / 2) <= a - IZR n <= 1 / 2) by (apply Rabs_le_inv, H).
      assert (Hm : - (1 / 2) < a - IZR m < 1 / 2) by (split; nra).
      assert (-1 < IZR (m - n) < 1) as [D1 D2] by (rewrite minus_IZR; lra).
      apply (lt_IZR (-1)) in D1. apply (lt_IZR _ 1) in D2. lia. }
    pose proof (Rle_0_sqr (x0 - IZR i')) as S0. pose proof (Rle_0_sqr (x1 - IZR j')) as S1. unfold Rsqr in *.
    split; [apply (A x0)|apply (A x1)]; auto; lra.
  Qed.
End Line.
