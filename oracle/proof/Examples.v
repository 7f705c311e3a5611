(* Right answers of whole questions, in the plane and in space; and what is a valid question.
  With `one_answer`
   (Answers.v) each example says also that no other answer is right. *)
From Coq Require Import ZArith Reals Lra Lia List.
From Flocq Require Import Core.
From Lorentz Require Import Spec Rounding Number Sanity.
Import ListNotations.
Local Open Scope R_scope.

(* ---- Discs of radius 1/4 around the integer points; in space ellipsoids of semiaxes 1/4, 1/8, 1/8. *)
Notation number n := (Decimal n 0).
Definition quarter : numeral := Decimal 25 (-2).
Definition eighth : numeral := Decimal 125 (-3).
Lemma value_quarter : value quarter = 1 / 4.
Proof. rewrite (value_is _ 1 1072) by (lia || vm_compute; reflexivity). simpl. lra. Qed.
Lemma value_eighth : value eighth = 1 / 8.
Proof. rewrite (value_is _ 1 1071) by (lia || vm_compute; reflexivity). simpl. lra. Qed.

Definition discs : scene := Scene 2 [Lattice [[number 1; number 0]; [number 0; number 1]]
  [Atom [number 0; number 0] (Radius quarter)]].
Definition ellipsoids : scene := Scene 3
  [Lattice [[number 1; number 0; number 0]; [number 0; number 1; number 0]; [number 0; number 0; number 1]]
    [Atom [number 0; number 0; number 0] (Semiaxes
      [[quarter; number 0; number 0]; [number 0; eighth; number 0]; [number 0; number 0; eighth]])]].

Lemma only_atom sc o L A : atom_of sc o L A -> forall L' A', lattices sc = [L'] -> atoms L' = [A'] ->
  of_lattice o = 0%Z /\ of_atom o = 0%Z /\ L = L' /\ A = A'.
Proof.
  intros (HL & HA & _) L' A' EL EA. unfold item in *. rewrite EL in HL.
  destruct (Z.ltb_spec (of_lattice o) 0); [discriminate|]. destruct (Z.ltb_spec (of_atom o) 0);
    [discriminate|].
  destruct (Z.to_nat (of_lattice o)) as [|[|i]] eqn:El; try discriminate. injection HL as <-.
    rewrite EA in HA.
  destruct (Z.to_nat (of_atom o)) as [|[|i]] eqn:Ea; try discriminate. injection HA as <-. repeat split; lia.
Qed.
Lemma discs_are o x y : occupied discs o [x; y] <->
  exists i j, o = Obstacle 0 0 [i; j] /\ (x - IZR i) * (x - IZR i) + (y - IZR j) * (y - IZR j) < 1 / 16.
Proof.
  split.
  - intros (L & A & HA & K). destruct (only_atom _ _ _ _ HA _ _ eq_refl eq_refl) as (El & Ea & -> & ->).
    destruct HA as (_ & _ & Hc). destruct o as [l a n]. cbn in El, Ea, Hc, K. subst.
    destruct n as [|i [|j [|k n]]]; try discriminate. exists i, j. split; [reflexivity|].
    rewrite value_quarter in K. apply norm_less in K; [|lra]. cbn in K. rewrite ?value_0, ?value_1 in K. lra.
  - intros (i & j & -> & K). do 2 eexists. split; [split; [reflexivity|split; reflexivity]|]. cbn [shape_of].
    rewrite value_quarter. apply norm_less; [lra|]. cbn. rewrite ?value_0, ?value_1. lra.
Qed.
Lemma ellipsoids_are o x y z : occupied ellipsoids o [x; y; z] <-> exists i j k, o = Obstacle 0 0 [i; j; k] /\
  16 * ((x - IZR i) * (x - IZR i)) + 64 * ((y - IZR j) * (y - IZR j)) + 64 * ((z - IZR k) * (z - IZR k)) < 1.
Proof.
  split.
  - intros (L & A & HA & K). destruct (only_atom _ _ _ _ HA _ _ eq_refl eq_refl) as (El & Ea & -> & ->).
    destruct HA as (_ & _ & Hc). destruct o as [l a n]. cbn in El, Ea, Hc, K. subst.
    destruct n as [|i [|j [|k [|? n]]]]; try discriminate. exists i, j, k. split; [reflexivity|].
    destruct K as (u & Hu & Nu & E). destruct u as [|u1 [|u2 [|u3 [|? u]]]]; try discriminate. cbn in E.
    rewrite ?value_0, ?value_1, ?value_quarter, ?value_eighth in E. injection E as Ex Ey Ez.
    apply norm_less in Nu; [|lra]. cbn in Nu.
    replace (x - IZR i) with (u1 / 4) by lra. replace (y - IZR j) with (u2 / 8) by lra.
    replace (z - IZR k) with (u3 / 8) by lra. lra.
  - intros (i & j & k & -> & K). do 2 eexists. split; [split; [reflexivity|split; reflexivity]|].
    cbn [shape_of].
    exists [4 * (x - IZR i); 8 * (y - IZR j); 8 * (z - IZR k)]. split; [reflexivity|].
    split; [apply norm_less; [lra|]; cbn; lra|]. cbn. rewrite ?value_0, ?value_1, ?value_quarter,
      ?value_eighth.
    repeat (apply (f_equal2 (@cons R)); [lra|]). reflexivity.
Qed.

(* ---- Flights along the first axis from a, with twice its velocity: a row of chords. *)
Lemma integer_0 j : IZR j * IZR j < 1 -> j = 0%Z.
Proof. intros H. rewrite <- mult_IZR in H. apply lt_IZR in H. nia. Qed.
Lemma between_squares x : x * x < 1 / 16 <-> - (1 / 4) < x < 1 / 4.
Proof. split; [intros H; split; nra|intros []; nra]. Qed.

Section Row.
  Variables (within : obstacle -> R -> Prop) (row : Z -> obstacle) (a : R).
  Hypothesis row_injective : forall i j, row i = row j -> i = j.
  Hypothesis chords : forall o t, within o t <->
    exists i, o = row i /\ (IZR i - a - 1 / 4) / 2 < t < (IZR i - a + 1 / 4) / 2.
  Lemma row_within i t : within (row i) t <-> (IZR i - a - 1 / 4) / 2 < t < (IZR i - a + 1 / 4) / 2.
  Proof.
    rewrite chords. split; [intros (j & E & K); apply row_injective in E; subst; exact K|eauto].
  Qed.
  Lemma row_enters i t : enters within (row i) t <-> 0 <= t /\ t = (IZR i - a - 1 / 4) / 2.
  Proof. apply (enters_interval within (row i) _ ((IZR i - a + 1 / 4) / 2)); [lra|]. apply row_within. Qed.
  Lemma row_first from i t : from <> Some (row i) -> t = (IZR i - a - 1 / 4) / 2 -> 0 <= t ->
    (forall j, (j < i)%Z -> from = Some (row j) \/ IZR j - a + 1 / 4 <= 0) -> first_hit within from (row i) t.
  Proof.
    intros F -> T0 Before. split; [exact F|]. split; [apply row_enters; auto|].
    assert (L : forall j, from <> Some (row j) -> IZR j - a + 1 / 4 > 0 -> IZR i <= IZR j).
    { intros j Fj K. apply IZR_le. apply Z.nlt_ge. intros H. destruct (Before j H); [contradiction|lra]. }
    split.
    - intros o Fo K. apply chords in K. destruct K as (j & -> & K). specialize (L j Fo ltac:(lra)). lra.
    - intros o t Fo En. assert (exists j, o = row j) as [j ->].
      { destruct En as (_ & _ & Near). destruct (Near (t + 1) ltac:(lra)) as (u & K & _). apply chords in K.
        destruct K as (j & -> & _). eauto. }
      apply row_enters in En. destruct En as [T1 ->]. specialize (L j Fo ltac:(lra)). destruct (Z.eq_dec i j)
        as [<-|N].
      + right. split; [lra|left; reflexivity].
      + left. assert (IZR i < IZR j); [|lra]. apply le_IZR in L. apply IZR_lt. lia.
  Qed.
End Row.

Definition disc (i : Z) : obstacle := Obstacle 0 0 [i; 0]%Z.
Definition ellipsoid (i : Z) : obstacle := Obstacle 0 0 [i; 0; 0]%Z.
Definition along_discs (a : numeral) (from : option obstacle) : query :=
  Query [a; number 0] [number 2; number 0] from.
Definition along_ellipsoids (a : numeral) (from : option obstacle) : query :=
  Query [a; number 0; number 0] [number 2; number 0; number 0] from.

Lemma along_discs_chords a from o t :
  occupied discs o (along (point (start (along_discs a from))) t (point (velocity (along_discs a from)))) <->
  exists i, o = disc i /\ (IZR i - value a - 1 / 4) / 2 < t < (IZR i - value a + 1 / 4) / 2.
Proof.
  cbn. rewrite discs_are, ?value_0, ?value_2. split.
  - intros (i & j & -> & K). pose proof (Rle_0_sqr (value a + t * 2 - IZR i)) as S0. unfold Rsqr in S0.
    assert (j = 0%Z) as -> by (apply integer_0; lra). exists i. split; [reflexivity|].
    assert (S : (value a + t * 2 - IZR i) * (value a + t * 2 - IZR i) < 1 / 16) by lra.
    apply between_squares in S. lra.
  - intros (i & -> & K). exists i, 0%Z. split; [reflexivity|].
    assert (S : (value a + t * 2 - IZR i) * (value a + t * 2 - IZR i) < 1 / 16) by (apply between_squares;
      lra).
    lra.
Qed.
Lemma along_ellipsoids_chords a from o t :
  occupied ellipsoids o
    (along (point (start (along_ellipsoids a from))) t (point (velocity (along_ellipsoids a from)))) <->
  exists i, o = ellipsoid i /\ (IZR i - value a - 1 / 4) / 2 < t < (IZR i - value a + 1 / 4) / 2.
Proof.
  cbn. rewrite ellipsoids_are, ?value_0, ?value_2. split.
  - intros (i & j & k & -> & K). pose proof (Rle_0_sqr (value a + t * 2 - IZR i)) as S0.
    pose proof (Rle_0_sqr (IZR j)). pose proof (Rle_0_sqr (IZR k)). unfold Rsqr in *.
    assert (j = 0%Z) as -> by (apply integer_0; lra). assert (k = 0%Z) as -> by (apply integer_0; lra).
    exists i. split; [reflexivity|].
    assert (S : (value a + t * 2 - IZR i) * (value a + t * 2 - IZR i) < 1 / 16) by lra.
    apply between_squares in S. lra.
  - intros (i & -> & K). exists i, 0%Z, 0%Z. split; [reflexivity|].
    assert (S : (value a + t * 2 - IZR i) * (value a + t * 2 - IZR i) < 1 / 16) by (apply between_squares;
      lra).
    lra.
Qed.
Lemma disc_injective i j : disc i = disc j -> i = j. Proof. unfold disc. congruence. Qed.
Lemma ellipsoid_injective i j : ellipsoid i = ellipsoid j -> i = j. Proof. unfold ellipsoid. congruence. Qed.

(* ---- hit. What has 40 digits or fewer is its own rounding. *)
Lemma forty_digits m k : (Z.abs m < 10 ^ 40)%Z -> nearest40 (IZR m * bpow radix10 k) = IZR m * bpow radix10 k.
Proof.
  intros H. apply round_generic; [apply valid_rnd_N|]. apply generic_format_FLX.
  exists (Float radix10 m k); [reflexivity|exact H].
Qed.
Lemma correct_hit sc q o n m k : finite n -> (Z.abs m < 10 ^ 40)%Z -> written n = IZR m * bpow radix10 k ->
  first_hit (fun o t => occupied sc o (along (point (start q)) t (point (velocity q)))) (from q)
    o (written n) ->
  correct sc q (Hit o (Some n) m k).
Proof.
  intros F Hm E H. exists (written n). split; [exact H|]. split; [|split; [exact F|reflexivity]].
  rewrite E. symmetry. apply forty_digits, Hm.
Qed.
Lemma finite_number x : Number.number x <> None -> finite x.
Proof. destruct (Number.number x) as [n|] eqn:E; [|contradiction]. intros _. apply (number_ok x n E). Qed.
Ltac is_finite := apply finite_number; vm_compute; discriminate.
Ltac before_0 := intros j Hj; right; rewrite <- Z.le_succ_l in Hj; apply IZR_le in Hj;
  rewrite succ_IZR in Hj; lra.

Lemma minus_quarter : value (Decimal (-25) (-2)) = - (1 / 4).
Proof. rewrite (value_is _ (-1) 1072) by (lia || vm_compute; reflexivity). simpl. lra. Qed.
Lemma minus_three_quarters : value (Decimal (-75) (-2)) = - (3 / 4).
Proof. rewrite (value_is _ (-3) 1072) by (lia || vm_compute; reflexivity). simpl. lra. Qed.

(* From -3/4 to the disc around 0, which begins at -1/4: 1/2, and the velocity is 2. *)
Example hits : correct discs (along_discs (Decimal (-75) (-2)) None) (Hit (disc 0) (Some quarter) 25 (-2)).
Proof.
  apply correct_hit; [is_finite|reflexivity|reflexivity|].
  apply (row_first _ disc (value (Decimal (-75) (-2))) disc_injective (along_discs_chords _ _));
    rewrite ?minus_three_quarters; [discriminate|simpl; lra|simpl; lra|before_0].
Qed.
Example hits_in_space : correct ellipsoids (along_ellipsoids (Decimal (-75) (-2)) None)
  (Hit (ellipsoid 0) (Some quarter) 25 (-2)).
Proof.
  apply correct_hit; [is_finite|reflexivity|reflexivity|].
  apply (row_first _ ellipsoid (value (Decimal (-75) (-2)))
    ellipsoid_injective (along_ellipsoids_chords _ _));
    rewrite ?minus_three_quarters; [discriminate|simpl; lra|simpl; lra|before_0].
Qed.
(* On the surface, inwards; written otherwise. *)
Example hits_at_once : correct discs (along_discs (Decimal (-25) (-2)) None) (Hit (disc 0)
  (Some (Hexadecimal 0 7)) 0 3).
Proof.
  exists 0. split; [|split].
  - apply (row_first _ disc (value (Decimal (-25) (-2))) disc_injective (along_discs_chords _ _));
      rewrite ?minus_quarter; [discriminate|lra|lra|before_0].
  - unfold nearest40. rewrite round_0 by apply valid_rnd_N. ring.
  - split; [is_finite|]. unfold value. f_equal. cbn [written]. ring.
Qed.
(* From the middle of a disc, to the next one. *)
Example leaves : correct discs (along_discs (number 0) (Some (disc 0))) (Hit (disc 1)
  (Some (Decimal 375 (-3))) 375 (-3)).
Proof.
  apply correct_hit; [is_finite|reflexivity|reflexivity|].
  apply (row_first _ disc (value (number 0)) disc_injective (along_discs_chords _ _));
    rewrite ?value_0; [discriminate|simpl; lra|simpl; lra|].
  intros j Hj. destruct (Z.eq_dec j 0) as [->|N]; [left; reflexivity|right].
  assert (H : (j <= -1)%Z) by lia. apply IZR_le in H. lra.
Qed.
Example leaves_in_space : correct ellipsoids (along_ellipsoids (number 0) (Some (ellipsoid 0)))
  (Hit (ellipsoid 1) (Some (Decimal 375 (-3))) 375 (-3)).
Proof.
  apply correct_hit; [is_finite|reflexivity|reflexivity|].
  apply (row_first _ ellipsoid (value (number 0)) ellipsoid_injective (along_ellipsoids_chords _ _));
    rewrite ?value_0; [discriminate|simpl; lra|simpl; lra|].
  intros j Hj. destruct (Z.eq_dec j 0) as [->|N]; [left; reflexivity|right].
  assert (H : (j <= -1)%Z) by lia. apply IZR_le in H. lra.
Qed.

(* ---- inside: also if it left another one. *)
Example is_inside from : from <> Some (disc 0) -> correct discs (along_discs (number 0) from)
  (Inside (disc 0)).
Proof.
  intros F. split; [exact F|]. split.
  - apply along_discs_chords. exists 0%Z. rewrite value_0. split; [reflexivity|lra].
  - intros o _ K. apply along_discs_chords in K. destruct K as (i & -> & K). rewrite value_0 in K.
    assert (i = 0%Z) as ->; [|left; reflexivity]. apply integer_0. nra.
Qed.
Example is_inside_in_space : correct ellipsoids (along_ellipsoids (number 0) None) (Inside (ellipsoid 0)).
Proof.
  split; [discriminate|]. split.
  - apply along_ellipsoids_chords. exists 0%Z. rewrite value_0. split; [reflexivity|lra].
  - intros o _ K. apply along_ellipsoids_chords in K. destruct K as (i & -> & K). rewrite value_0 in K.
    assert (i = 0%Z) as ->; [|left; reflexivity]. apply integer_0. nra.
Qed.

(* ---- never: along the tangents at height 1/4, and half way between two rows; back from `from` alone. *)
Lemma nothing_met within from : (forall o t, from <> Some o -> ~ within o t) -> nothing within from.
Proof.
  intros H o F. split; [apply H, F|]. intros t (_ & _ & Near).
  destruct (Near (t + 1) ltac:(lra)) as (u & K & _). exact (H o u F K).
Qed.
Example never_met y : value y = 1 / 4 \/ value y = 1 / 2 ->
  correct discs (Query [number 0; y] [number 2; number 0] None) Never.
Proof.
  intros Hy. apply nothing_met. intros o t _ K. cbn in K. apply discs_are in K. destruct K as (i & j & _ & K).
  rewrite value_0 in K. pose proof (Rle_0_sqr (value (number 0) + t * value (number 2) - IZR i)) as S0.
  unfold Rsqr in S0. assert ((value y - IZR j) * (value y - IZR j) < 1 / 16) as S by (rewrite value_0 in *;
    nra).
  apply between_squares in S. destruct Hy as [E|E]; rewrite E in S.
  - assert (0 < IZR j < 1) as [L U] by lra. apply lt_IZR in L, U. lia.
  - assert (0 < IZR j < 1) as [L U] by lra. apply lt_IZR in L, U. lia.
Qed.
Example never_met_in_space : correct ellipsoids
  (Query [number 0; quarter; number 0] [number 2; number 0; number 0] None) Never.
Proof.
  apply nothing_met. intros o t _ K. cbn in K. apply ellipsoids_are in K. destruct K as (i & j & k & _ & K).
  rewrite value_0, value_quarter in K. pose proof (Rle_0_sqr (0 + t * value (number 2) - IZR i)) as S0.
  pose proof (Rle_0_sqr (0 + t * 0 - IZR k)) as S1. unfold Rsqr in *.
  assert (S : (1 / 4 - IZR j) * (1 / 4 - IZR j) < 1 / 16) by nra.
  apply between_squares in S. assert (0 < IZR j < 1) as [L U] by lra. apply lt_IZR in L, U. lia.
Qed.

(* ---- Lattices of fewer vectors. Discs of radius 1/4 in a row, 2 apart along x; and one ball. *)
Definition row_of_discs : scene := Scene 2 [Lattice [[number 2; number 0]] [Atom [number 0; number 0]
  (Radius quarter)]].
Definition ball : scene := Scene 3 [Lattice [] [Atom [number 1; number 0; number 0] (Radius quarter)]].
Lemma row_of_discs_are o x y : occupied row_of_discs o [x; y] <->
  exists i, o = Obstacle 0 0 [i] /\ (x - 2 * IZR i) * (x - 2 * IZR i) + y * y < 1 / 16.
Proof.
  split.
  - intros (L & A & HA & K). destruct (only_atom _ _ _ _ HA _ _ eq_refl eq_refl) as (El & Ea & -> & ->).
    destruct HA as (_ & _ & Hc). destruct o as [l a n]. cbn in El, Ea, Hc, K. subst.
    destruct n as [|i [|j n]]; try discriminate. exists i. split; [reflexivity|].
    rewrite value_quarter in K. apply norm_less in K; [|lra]. cbn in K. rewrite ?value_0, ?value_2 in K. lra.
  - intros (i & -> & K). do 2 eexists. split; [split; [reflexivity|split; reflexivity]|]. cbn [shape_of].
    rewrite value_quarter. apply norm_less; [lra|]. cbn. rewrite ?value_0, ?value_2. lra.
Qed.
Lemma ball_is o x y z : occupied ball o [x; y; z] <->
  o = Obstacle 0 0 [] /\ (x - 1) * (x - 1) + y * y + z * z < 1 / 16.
Proof.
  split.
  - intros (L & A & HA & K). destruct (only_atom _ _ _ _ HA _ _ eq_refl eq_refl) as (El & Ea & -> & ->).
    destruct HA as (_ & _ & Hc). destruct o as [l a n]. cbn in El, Ea, Hc, K. subst.
    destruct n as [|i n]; try discriminate. split; [reflexivity|].
    rewrite value_quarter in K. apply norm_less in K; [|lra]. cbn in K. rewrite ?value_0, ?value_1 in K. lra.
  - intros (-> & K). do 2 eexists. split; [split; [reflexivity|split; reflexivity]|]. cbn [shape_of].
    rewrite value_quarter. apply norm_less; [lra|]. cbn. rewrite ?value_0, ?value_1. lra.
Qed.
(* Along the row, from one disc to the next: from 0 to 2 - 1/4, at the velocity 2. *)
Example leaves_in_a_row : correct row_of_discs (Query [number 0; number 0] [number 2; number 0]
  (Some (Obstacle 0 0 [0%Z]))) (Hit (Obstacle 0 0 [1%Z]) (Some (Decimal 875 (-3))) 875 (-3)).
Proof.
  apply correct_hit; [is_finite|reflexivity|reflexivity|]. set (within := fun _ _ => _).
  assert (W : forall o t, within o t <-> exists i, o = Obstacle 0 0 [i] /\ IZR i - 1 / 8 < t < IZR i + 1 / 8).
  { intros o t. unfold within. cbn. rewrite row_of_discs_are, ?value_0, ?value_2. split; intros (i & -> & K);
      exists i; (split; [reflexivity|]).
    - assert (S : (0 + t * 2 - 2 * IZR i) * (0 + t * 2 - 2 * IZR i) < 1 / 16) by lra.
      apply between_squares in S. lra.
    - assert (S : (0 + t * 2 - 2 * IZR i) * (0 + t * 2 - 2 * IZR i) < 1 / 16) by (apply between_squares; lra).
      lra. }
  assert (En : forall i t, enters within (Obstacle 0 0 [i]) t <-> 0 <= t /\ t = IZR i - 1 / 8).
  { intros i t. apply (enters_interval within _ _ (IZR i + 1 / 8)); [lra|]. intros u. rewrite W. split; eauto.
    intros (j & E & K). injection E as ->. exact K. }
  assert (Later : forall i, Some (Obstacle 0 0 [0%Z]) <> Some (Obstacle 0 0 [i]) -> - 1 / 8 < IZR i ->
    1 <= IZR i).
  { intros i N K. apply (IZR_le 1). assert (-1 < i)%Z by (apply lt_IZR; lra).
    destruct (Z.eq_dec i 0) as [->|]; [contradiction|lia]. }
  split; [discriminate|]. split; [apply En; simpl; lra|]. split.
  - intros o F K. apply W in K. destruct K as (i & -> & K). specialize (Later i F ltac:(lra)). lra.
  - intros o t F K. assert (exists i, o = Obstacle 0 0 [i]) as [i ->].
    { destruct K as (_ & _ & Near). destruct (Near (t + 1) ltac:(lra)) as (u & K & _). apply W in K.
      destruct K as (i & -> & _). eauto. }
    apply En in K. destruct K as [T0 ->]. specialize (Later i F ltac:(lra)).
    destruct (Z.eq_dec i 1) as [->|N]; [right; simpl; split; [lra|left; reflexivity]|left].
    assert (IZR i <> 1) by (intros E; apply N, eq_IZR, E). simpl. lra.
Qed.
(* Away from the row, which is met only before the start; in the ball, and out of it. *)
Example away_from_a_row : correct row_of_discs (Query [number 1; number 1] [number 1; number 2] None) Never.
Proof.
  intros o _. assert (N : forall t, occupied row_of_discs o (along (point [number 1; number 1]) t
    (point [number 1; number 2])) -> t < 0).
  { intros t K. cbn in K. rewrite value_1, value_2 in K. apply row_of_discs_are in K. destruct K as (i & _ & K).
    pose proof (Rle_0_sqr (1 + t * 1 - 2 * IZR i)) as S0. unfold Rsqr in S0.
    assert (S : (1 + t * 2) * (1 + t * 2) < 1 / 16) by lra. apply between_squares in S. lra. }
  split; [intros K; apply N in K; lra|]. intros t (T0 & Low & Near).
  destruct (Near (t + 1) ltac:(lra)) as (u & K & _). specialize (Low u K). apply N in K. lra.
Qed.
Example in_a_ball : correct ball (Query [number 1; number 0; number 0] [number 1; number 2; number 0] None)
  (Inside (Obstacle 0 0 [])).
Proof.
  split; [discriminate|]. split; [cbn; rewrite ?value_0, ?value_1; apply ball_is; split; [reflexivity|lra]|].
  intros o _ K. cbn in K. rewrite ?value_0, ?value_1 in K. apply ball_is in K. destruct K as [-> _]. left.
  reflexivity.
Qed.
Example out_of_a_ball : correct ball (Query [number 1; number 0; number 0] [number 1; number 2; number 0]
  (Some (Obstacle 0 0 []))) Never.
Proof.
  apply nothing_met. intros o t F K. cbn in K. rewrite ?value_0, ?value_1 in K. apply ball_is in K.
  destruct K as [-> _]. contradiction.
Qed.

(* ---- Numbers of binary64: up to 2^1024, which is beyond. *)
Example largest_number : finite (Hexadecimal (2 ^ 53 - 1) 971). Proof. is_finite. Qed.
Lemma value_2_to_1024 m : (m = 1 \/ m = -1)%Z -> value (Hexadecimal m 1024) = IZR m * bpow radix2 1024.
Proof.
  intros Hm. apply round_generic; [apply valid_rnd_N|]. apply generic_format_FLT.
  exists (Float radix2 m 1024); [reflexivity| |discriminate]. destruct Hm as [-> | ->]; reflexivity.
Qed.
Lemma beyond_numbers m : (m = 1 \/ m = -1)%Z -> ~ finite (Hexadecimal m 1024).
Proof.
  intros Hm. unfold finite. rewrite value_2_to_1024, Rabs_mult, (Rabs_pos_eq (bpow _ _)) by
    (auto || apply bpow_ge_0).
  replace (Rabs (IZR m)) with 1; [lra|]. destruct Hm as [-> | ->]; [rewrite Rabs_R1|rewrite Rabs_left]; lra.
Qed.
Definition beyond : numeral := Hexadecimal 1 1024.
Lemma not_sized d l : In beyond l -> ~ sized d l.
Proof.
  intros Hl [_ F]. rewrite Forall_forall in F. exact (beyond_numbers 1 ltac:(auto) (F _ Hl)).
Qed.

(* ---- Valid scenes, and others: of no lattice, no atom, one or four dimensions, .. *)
Ltac are_finite := split; [reflexivity|repeat (constructor; [is_finite|])]; constructor.
Ltac vectors_of := repeat (constructor; [are_finite|]); constructor.
Lemma independent_2 x y : independent 2 [[number x; number 0]; [number 0; number y]] ->
  value (number x) <> 0 /\ value (number y) <> 0.
Proof.
  intros (_ & _ & H). split; intros E.
  - assert (K := H [1; 0] eq_refl). cbn in K. rewrite value_0, E in K.
    assert (F : [1; 0] = [0; 0]); [apply K; repeat (apply (f_equal2 (@cons R)); [ring|]); reflexivity|].
    injection F. lra.
  - assert (K := H [0; 1] eq_refl). cbn in K. rewrite value_0, E in K.
    assert (F : [0; 1] = [0; 0]); [apply K; repeat (apply (f_equal2 (@cons R)); [ring|]); reflexivity|].
    injection F. lra.
Qed.
Definition unit_2 := [[number 1; number 0]; [number 0; number 1]].
Definition unit_3 := [[number 1; number 0; number 0]; [number 0; number 1; number 0]; [number 0; number 0;
  number 1]].
Lemma unit_2_independent : independent 2 unit_2.
Proof.
  split; [cbn; lia|]. split; [vectors_of|]. intros k Hk E. destruct k as [|a [|b [|c k]]];
    try discriminate.
  cbn in E. rewrite ?value_0, ?value_1 in E. injection E as Ea Eb. unfold zero. cbn.
  repeat (apply (f_equal2 (@cons R)); [lra|]). reflexivity.
Qed.
Lemma unit_3_independent : independent 3 unit_3.
Proof.
  split; [cbn; lia|]. split; [vectors_of|]. intros k Hk E. destruct k as [|a [|b [|c [|d k]]]];
    try discriminate.
  cbn in E. rewrite ?value_0, ?value_1 in E. injection E as Ea Eb Ec. unfold zero. cbn.
  repeat (apply (f_equal2 (@cons R)); [lra|]). reflexivity.
Qed.
Example discs_are_valid : valid_scene discs.
Proof.
  split; [left; reflexivity|]. split; [discriminate|]. constructor; [|constructor].
  split; [exact unit_2_independent|]. split; [discriminate|]. constructor; [|constructor].
  split; [are_finite|]. cbn. split; [is_finite|]. rewrite value_quarter. lra.
Qed.
Example ellipsoids_are_valid : valid_scene ellipsoids.
Proof.
  split; [right; reflexivity|]. split; [discriminate|]. constructor; [|constructor].
  split; [exact unit_3_independent|]. split; [discriminate|]. constructor; [|constructor].
  split; [are_finite|]. cbn. split; [reflexivity|]. split; [cbn; lia|]. split; [vectors_of|]. intros k Hk E.
  destruct k as [|a [|b [|c [|d k]]]]; try discriminate. cbn in E.
  rewrite ?value_0, ?value_quarter, ?value_eighth in E. injection E as Ea Eb Ec. unfold zero. cbn.
  repeat (apply (f_equal2 (@cons R)); [lra|]). reflexivity.
Qed.

Example row_is_valid : valid_scene row_of_discs.
Proof.
  split; [left; reflexivity|]. split; [discriminate|]. constructor; [|constructor]. split.
  - split; [cbn; lia|]. split; [vectors_of|]. intros k Hk E. destruct k as [|a [|b k]]; try discriminate.
    cbn in E. rewrite ?value_0, ?value_2 in E. injection E as Ea. unfold zero. cbn. f_equal. lra.
  - split; [discriminate|]. constructor; [|constructor].
    split; [are_finite|]. cbn. split; [is_finite|]. rewrite value_quarter. lra.
Qed.
Example ball_is_valid : valid_scene ball.
Proof.
  split; [right; reflexivity|]. split; [discriminate|]. constructor; [|constructor]. split.
  - split; [cbn; lia|]. split; [constructor|]. intros k Hk E. destruct k; [reflexivity|discriminate].
  - split; [discriminate|]. constructor; [|constructor].
    split; [are_finite|]. cbn. split; [is_finite|]. rewrite value_quarter. lra.
Qed.

Definition atom_0 := Atom [number 0; number 0] (Radius quarter).
Example no_lattice : ~ valid_scene (Scene 2 []). Proof. intros (_ & H & _). auto. Qed.
Ltac first_lattice := let H := fresh in intros (_ & _ & H); inversion_clear H as [|? ? V _]; cbn in V.
Example no_atom : ~ valid_scene (Scene 2 [Lattice unit_2 []]). Proof. first_lattice. apply V. reflexivity.
  Qed.
Example the_second_lattice_counts : ~ valid_scene (Scene 2 [Lattice unit_2 [atom_0]; Lattice unit_2 []]).
Proof. intros (_ & _ & H). inversion_clear H as [|? ? _ K]. inversion_clear K as [|? ? V _]. apply V.
  reflexivity. Qed.
Definition unit_1 := [[number 1]].
Definition unit_4 := [[number 1; number 0; number 0; number 0]; [number 0; number 1; number 0; number 0];
  [number 0; number 0; number 1; number 0]; [number 0; number 0; number 0; number 1]].
Example one_dimension : ~ valid_scene (Scene 1 [Lattice unit_1 [Atom [number 0] (Radius quarter)]]).
Proof. intros ([|] & _); discriminate. Qed.
Example four_dimensions : ~ valid_scene
  (Scene 4 [Lattice unit_4 [Atom [number 0; number 0; number 0; number 0] (Radius quarter)]]).
Proof. intros ([|] & _); discriminate. Qed.

(* .. of vectors that are too many, too long, dependent, beyond binary64; of such semiaxes, or of too few, .. *)
Definition one_atom (s : shape) := Scene 2 [Lattice unit_2 [Atom [number 0; number 0] s]].
Definition wrong_vectors : list (list (list numeral)) := [
  unit_2 ++ [[number 1; number 1]]; [[number 0; number 0]];
  [[number 1; number 0; number 0]; [number 0; number 1; number 0]]; [[number 1]; [number 1]]; [[number 1]];
  [[number 1; number 2]; [number 2; number 4]]; [[number 0; number 0]; [number 0; number 1]];
  [[beyond; number 0]; [number 0; number 1]]; [[number 1; number 0]; [number 0; beyond]]].
Lemma value_4 : value (number 4) = 4. Proof. apply value_integer. vm_compute. reflexivity. Qed.
Example are_wrong b : In b wrong_vectors -> ~ independent 2 b.
Proof.
  unfold wrong_vectors, unit_2. cbn. intros H (L & S & I).
  repeat destruct H as [<-|H]; try (cbn in L; lia); try tauto;
    try (inversion_clear S as [|? ? [V _] _]; discriminate).
  - assert (K := I [1] eq_refl). cbn in K. rewrite value_0 in K.
    assert (F : [1] = [0]); [apply K; repeat (apply (f_equal2 (@cons R)); [ring|]); reflexivity|].
    injection F. lra.
  - assert (K := I [2; -1] eq_refl). cbn in K. rewrite value_1, value_2, value_4 in K.
    assert (F : [2; -1] = [0; 0]); [apply K; repeat (apply (f_equal2 (@cons R)); [ring|]); reflexivity|].
    injection F. lra.
  - assert (K := I [1; 0] eq_refl). cbn in K. rewrite value_0, value_1 in K.
    assert (F : [1; 0] = [0; 0]); [apply K; repeat (apply (f_equal2 (@cons R)); [ring|]); reflexivity|].
    injection F. lra.
  - inversion_clear S as [|? ? V _]. revert V. apply not_sized. cbn. auto.
  - inversion_clear S as [|? ? _ S']. inversion_clear S' as [|? ? V _]. revert V. apply not_sized. cbn. auto.
Qed.
Example wrong_lattice b : In b wrong_vectors -> ~ valid_scene (Scene 2 [Lattice b [atom_0]]).
Proof. intros H. first_lattice. exact (are_wrong b H (proj1 V)). Qed.
Ltac first_atom := let H := fresh in intros (_ & _ & H); inversion_clear H as [|? ? (_ & _ & K) _];
  inversion_clear K as [|? ? V _].
Example wrong_semiaxes b : In b wrong_vectors -> ~ valid_scene (one_atom (Semiaxes b)).
Proof. intros H. first_atom. exact (are_wrong b H (proj2 (proj2 V))). Qed.
Example few_semiaxes b : In b [[]; [[number 1; number 0]]] -> ~ valid_scene (one_atom (Semiaxes b)).
Proof. intros H. first_atom. destruct V as (_ & V & _). cbn in H. destruct H as [<-|[<-|[]]]; discriminate. Qed.
(* .. of a radius that is 0, negative, beyond binary64, of a position that is too long, too short, or beyond.
  *)
Example radius_0 : ~ valid_scene (one_atom (Radius (number 0))).
Proof. first_atom. destruct V as (_ & _ & K). rewrite value_0 in K. lra. Qed.
Example radius_negative : ~ valid_scene (one_atom (Radius (Decimal (-25) (-2)))).
Proof. first_atom. destruct V as (_ & _ & K). rewrite minus_quarter in K. lra. Qed.
Example radius_beyond : ~ valid_scene (one_atom (Radius beyond)).
Proof. first_atom. destruct V as (_ & K & _). exact (beyond_numbers 1 ltac:(auto) K). Qed.
Example wrong_position p : In p [[number 0]; [number 0; number 0; number 0]; [number 0; beyond]] ->
  ~ valid_scene (Scene 2 [Lattice unit_2 [Atom p (Radius quarter)]]).
Proof.
  cbn. intros H. first_atom. destruct V as (K & _). cbn in K. repeat destruct H as [<-|H]; try tauto.
  - destruct K; discriminate.
  - destruct K; discriminate.
  - revert K. apply not_sized. cbn. auto.
Qed.
Example the_second_atom_counts : ~ valid_scene
  (Scene 2 [Lattice unit_2 [atom_0; Atom [number 0; number 0] (Radius (number 0))]]).
Proof.
  first_lattice. destruct V as (_ & _ & K). inversion_clear K as [|? ? _ K'].
    inversion_clear K' as [|? ? V _].
  destruct V as (_ & _ & K). cbn in K. rewrite value_0 in K. lra.
Qed.

(* ---- Valid questions, and others. *)
Example along_discs_is_valid a : finite a -> valid_query discs (along_discs a None).
Proof.
  intros Ha. split; [split; [reflexivity|constructor; [exact Ha|constructor; [is_finite|constructor]]]|].
  split; [are_finite|]. split; [|discriminate]. cbn. rewrite value_2. unfold zero. cbn. intros E.
    injection E. lra.
Qed.
Example valid_from : valid_query ellipsoids (along_ellipsoids (number 0) (Some (Obstacle 0 0 [5; -7; 0]%Z))).
Proof.
  split; [are_finite|]. split; [are_finite|]. split.
  - cbn. rewrite value_2. unfold zero. cbn. intros E. injection E. lra.
  - intros o E. injection E as <-. do 2 eexists. repeat split; reflexivity.
Qed.
Definition wrong_points : list (list numeral) :=
  [[]; [number 1]; [number 1; number 0; number 0]; [beyond; number 0]; [number 1; beyond]].
Lemma wrong_point p : In p wrong_points -> ~ sized 2 p.
Proof.
  cbn. intros H. repeat destruct H as [<-|H]; try tauto; try solve [intros [K _]; discriminate];
    apply not_sized; cbn; auto.
Qed.
Example wrong_start p v f : In p wrong_points -> ~ valid_query discs (Query p v f).
Proof. intros H (K & _). exact (wrong_point p H K). Qed.
Example wrong_velocity p v f : In v wrong_points -> ~ valid_query discs (Query p v f).
Proof. intros H (_ & K & _). exact (wrong_point v H K). Qed.
Example at_rest p f : ~ valid_query discs (Query p [number 0; number 0] f).
Proof. intros (_ & _ & K & _). apply K. cbn. rewrite value_0. reflexivity. Qed.
Example wrong_from o : In o [Obstacle 1 0 [0; 0]; Obstacle (-1) 0 [0; 0]; Obstacle 0 1 [0; 0];
  Obstacle 0 (-1) [0; 0];
    Obstacle 0 0 [0]; Obstacle 0 0 [0; 0; 0]]%Z -> ~ valid_query discs (along_discs (number 0) (Some o)).
Proof.
  cbn. intros H (_ & _ & _ & K). destruct (K o eq_refl) as (L & A & HA).
  repeat destruct H as [<-|H]; try tauto; destruct HA as (HL & HA & HC); cbn in HL, HA, HC;
    try discriminate; injection HL as <-; discriminate.
Qed.
