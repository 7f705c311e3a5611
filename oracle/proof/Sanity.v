(* That Spec.v says what is meant: examples, and facts that small wrong specifications contradict.
   `wrong_specs` plants such and sees this file, or the proof, fail. It rests on Spec.v alone, but for the values
   of numbers. *)
From Coq Require Import ZArith Reals Lra Lia List.
From Flocq Require Import Core.
From Lorentz Require Import Spec Rounding Number.
Import ListNotations.
Local Open Scope R_scope.

(* ---- Numbers: 5/2, 0.1, a tie to even, the smallest one, a hexadecimal one. *)
Lemma value_is x n k : number x = Some (n * 2 ^ k)%Z -> (0 <= k)%Z ->
  value x = IZR n * bpow radix2 (k - 1074).
Proof.
  intros E Hk. destruct (number_ok x _ E) as [V _]. rewrite V, mult_IZR. change 2%Z with (radix_val radix2).
  rewrite IZR_power by auto. unfold smallest. rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal; lia.
Qed.
Lemma value_integer n : number (Decimal n 0) = Some (n * 2 ^ 1074)%Z -> value (Decimal n 0) = IZR n.
Proof. intros E. rewrite (value_is _ n 1074 E) by lia. simpl. ring. Qed.
Lemma value_0 : value (Decimal 0 0) = 0. Proof. apply value_integer. vm_compute. reflexivity. Qed.
Lemma value_1 : value (Decimal 1 0) = 1. Proof. apply value_integer. vm_compute. reflexivity. Qed.
Lemma value_2 : value (Decimal 2 0) = 2. Proof. apply value_integer. vm_compute. reflexivity. Qed.
Example five_halves : value (Decimal 25 (-1)) = 5 / 2.
Proof. rewrite (value_is _ 5 1073) by (lia || vm_compute; reflexivity). simpl. lra. Qed.
Example a_tenth : value (Decimal 1 (-1)) = 3602879701896397 / 36028797018963968.
Proof. rewrite (value_is _ 3602879701896397 1019) by (lia || vm_compute; reflexivity). simpl. lra. Qed.
Example tie_to_even : value (Decimal 9007199254740993 0) = 9007199254740992.
Proof. rewrite (value_is _ 9007199254740992 1074) by (lia || vm_compute; reflexivity). simpl. lra. Qed.
Example smallest_number : value (Decimal 5 (-324)) = bpow radix2 (-1074).
Proof. rewrite (value_is _ 1 0) by (lia || vm_compute; reflexivity). simpl (0 - 1074)%Z. ring. Qed.
Example hexadecimal_number : value (Hexadecimal 3 (-1)) = 3 / 2.
Proof. rewrite (value_is _ 3 1073) by (lia || vm_compute; reflexivity). simpl. lra. Qed.

(* ---- Obstacles. *)
Lemma norm_less a r : 0 < r -> norm a < r <-> fold_right (fun c sum => c * c + sum) 0 a < r * r.
Proof.
  intros Hr. unfold norm. set (s := fold_right _ 0 a).
  assert (0 <= s) by (subst s; induction a as [|c a IH]; cbn; [lra|]; pose proof (Rle_0_sqr c);
    unfold Rsqr in *; lra).
  assert (E : sqrt (r * r) = r) by (apply sqrt_square; lra). split; intros K.
  - rewrite <- E in K. apply sqrt_lt_0_alt in K. exact K.
  - rewrite <- E. apply sqrt_lt_1_alt. lra.
Qed.

Definition plane_of (s : shape) : scene :=  (* position (1, 0), vectors (2, 1) and (0, 2) *)
  Scene 2 [Lattice [[Decimal 2 0; Decimal 1 0]; [Decimal 0 0; Decimal 2 0]]
    [Atom [Decimal 1 0; Decimal 0 0] s]].
Lemma plane_of_only s l a n q : occupied (plane_of s) (Obstacle l a n) q -> l = 0%Z /\ a = 0%Z.
Proof.
  intros (L & A & (HL & HA & _) & _). unfold item in *. cbn [of_lattice of_atom lattices plane_of] in *.
  destruct (Z.ltb_spec l 0); [discriminate|]. destruct (Z.ltb_spec a 0); [discriminate|].
  destruct (Z.to_nat l) as [|[|i]] eqn:El; try discriminate. injection HL as <-. cbn [atoms] in HA.
  destruct (Z.to_nat a) as [|[|i]] eqn:Ea; try discriminate. lia.
Qed.

(* The open disc of radius 2 around (1, 0) + 1 (2, 1) + 1 (0, 2) = (3, 3). *)
Lemma disc_is x y : occupied (plane_of (Radius (Decimal 2 0))) (Obstacle 0 0 [1; 1]%Z) [x; y] <->
  (x - 3) * (x - 3) + (y - 3) * (y - 3) < 4.
Proof.
  split.
  - intros (L & A & (HL & HA & _) & K). cbn in HL, HA. injection HL as <-. injection HA as <-.
    cbn [shape_of] in K.
    rewrite value_2 in K. apply norm_less in K; [|lra]. cbn in K.
    rewrite ?value_0, ?value_1, ?value_2 in K. lra.
  - intros K. do 2 eexists. split; [split; [reflexivity|split; reflexivity]|]. cbn [shape_of].
    rewrite value_2. apply norm_less; [lra|]. cbn. rewrite ?value_0, ?value_1, ?value_2. lra.
Qed.
(* The open ellipse of semiaxes (2, 1) and (0, 1) around (1, 0). *)
Lemma ellipse_is x y :
  occupied (plane_of (Semiaxes [[Decimal 2 0; Decimal 1 0]; [Decimal 0 0; Decimal 1 0]]))
    (Obstacle 0 0 [0; 0]%Z) [x; y] <->
  (x - 1) / 2 * ((x - 1) / 2) + (y - (x - 1) / 2) * (y - (x - 1) / 2) < 1.
Proof.
  split.
  - intros (L & A & (HL & HA & _) & K). cbn in HL, HA. injection HL as <-. injection HA as <-.
    cbn [shape_of] in K.
    destruct K as (k & Hk & Nk & E). destruct k as [|a [|b [|c k]]]; try discriminate. cbn in E.
    rewrite ?value_0, ?value_1, ?value_2 in E. injection E as Ex Ey. apply norm_less in Nk; [|lra]. cbn in Nk.
    assert (a = (x - 1) / 2) as <- by lra. assert (b = y - a) as <- by lra. lra.
  - intros K. do 2 eexists. split; [split; [reflexivity|split; reflexivity]|]. cbn [shape_of].
    exists [(x - 1) / 2; y - (x - 1) / 2]. split; [reflexivity|]. split; [apply norm_less; [lra|]; cbn; lra|].
    cbn. rewrite ?value_0, ?value_1, ?value_2. repeat (apply (f_equal2 (@cons R)); [lra|]). reflexivity.
Qed.
(* Not in the plane of another dimension's cell. *)
Lemma no_third_coordinate q : ~ occupied (plane_of (Radius (Decimal 2 0))) (Obstacle 0 0 [1; 1; 0]%Z) q.
Proof. intros (L & A & (HL & _ & H) & _). cbn in HL. injection HL as <-. discriminate. Qed.

(* ---- What is first: of chords that are given. *)
Definition a := Obstacle 0 1 [5; 5]%Z.
Definition b := Obstacle 1 0 [0; 0]%Z.
Definition c := Obstacle 1 0 [0; 1]%Z.
Definition chord_of (o : obstacle) (first last : R) : obstacle -> R -> Prop :=
  fun o' t => o' = o /\ first < t < last.

(* Where the chord is (first, last). *)
Lemma enters_interval (within : obstacle -> R -> Prop) o first last t : first < last ->
  (forall t', within o t' <-> first < t' < last) -> enters within o t <-> 0 <= t /\ t = first.
Proof.
  intros H I. split.
  - intros (T0 & Low & Near). split; [auto|]. apply Rle_antisym.
    + apply Rnot_lt_le. intros K. set (m := Rmin t last).
      assert (first < m) by (unfold m, Rmin; destruct Rle_dec; lra).
      assert (t <= (first + m) / 2); [|unfold m, Rmin in *; destruct Rle_dec; lra].
      apply Low, I. unfold m, Rmin in *; destruct Rle_dec; lra.
    + apply Rnot_lt_le. intros K. destruct (Near first K) as (t' & It & L). apply I in It. lra.
  - intros (T0 & ->). split; [auto|]. split; [intros t' K; apply I in K; lra|]. intros later K.
    set (m := Rmin later last).
    assert (first < m /\ m <= later /\ m <= last) as (? & ? & ?) by (unfold m, Rmin; destruct Rle_dec; lra).
    exists ((first + m) / 2). split; [apply I; lra|lra].
Qed.
Lemma enters_chord o first last t : first < last ->
  enters (chord_of o first last) o t <-> 0 <= t /\ t = first.
Proof. intros H. apply (enters_interval _ o first last t H). unfold chord_of. intuition. Qed.

Example ahead : first_hit (chord_of a 1 2) None a 1.
Proof.
  split; [discriminate|]. split; [apply enters_chord; lra|]. split; [intros o _ (_ & K); lra|].
  intros o' t' _ En. right. destruct En as (T0 & Low & Near).
  destruct (Near (t' + 1) ltac:(lra)) as (t'' & (-> & _) & _).
  assert (enters (chord_of a 1 2) a t') as En by (split; [auto|split; auto]).
  apply enters_chord in En; [|lra].
  split; [lra|left; reflexivity].
Qed.
Example not_at_the_far_side t : first_hit (chord_of a 1 2) None a t -> t = 1.
Proof. intros (_ & En & _). apply enters_chord in En; lra. Qed.
Example on_the_surface_inwards : enters (chord_of a 0 1) a 0.
Proof. apply enters_chord; lra. Qed.
Example on_the_surface_outwards : nothing (chord_of a (-1) 0) None.
Proof.
  intros o _. split; [intros (_ & K); lra|]. intros t (T0 & Low & Near).
  destruct (Near (t + 1) ltac:(lra)) as (t' & (-> & _) & _).
  specialize (Low (-1 / 2) ltac:(split; [reflexivity|lra])). lra.
Qed.
Example behind t : ~ first_hit (chord_of a (-2) (-1)) None a t.
Proof. intros (_ & En & _). apply enters_chord in En; lra. Qed.
Example something : ~ nothing (chord_of a 1 2) None.
Proof. intros N. apply (proj2 (N a ltac:(discriminate)) 1), enters_chord; lra. Qed.
Example inside_is_something : ~ nothing (chord_of a (-1) 1) None.
Proof. intros N. apply (proj1 (N a ltac:(discriminate))). split; [reflexivity|lra]. Qed.

(* If an obstacle other than `from` contains x, nothing is a hit. *)
Example inside_first o t : ~ first_hit (fun o t => chord_of a (-1) 1 o t \/ chord_of b 2 3 o t) None o t.
Proof. intros (_ & _ & N & _). apply (N a ltac:(discriminate)). left. split; [reflexivity|lra]. Qed.
Example inside_is : first_inside (chord_of a (-1) 1) None a.
Proof. split; [discriminate|]. split; [split; [reflexivity|lra]|]. intros o _ (-> & _). left.
reflexivity. Qed.
Example inside_from o : ~ first_inside (chord_of a (-1) 1) (Some a) o.
Proof. intros (N & (-> & _) & _). contradiction. Qed.
Example nothing_but_from : nothing (chord_of a (-1) 1) (Some a).
Proof.
  intros o N. split; [intros (-> & _); contradiction|]. intros t (_ & _ & Near).
  destruct (Near (t + 1) ltac:(lra)) as (t' & (-> & _) & _). contradiction.
Qed.
Example from_is_no_hit t : ~ first_hit (chord_of a 1 2) (Some a) a t.
Proof. intros (N & _). contradiction. Qed.

(* Two are entered at once, or contain x: the smaller name, number by number, the lattice first. *)
Example ties_b : not_after a b. Proof. right. left. reflexivity. Qed.
Example ties_c : not_after b c.
Proof. right. right. split; [reflexivity|]. right. split; [reflexivity|]. right. split; [reflexivity|]. left.
reflexivity. Qed.
Example no_tie_back : ~ not_after b a. Proof. intros [E|[L|[E _]]];
  [discriminate|cbn in L; lia|discriminate]. Qed.
Example no_tie_back_c : ~ not_after c b.
Proof. intros [E|[L|[_ [L|[_ [L|[_ [L|[E _]]]]]]]]]; cbn in *; try discriminate; lia. Qed.
Example tie_is_for_the_smaller t :
  ~ first_hit (fun o t => chord_of b 1 2 o t \/ chord_of a 1 3 o t) None b t.
Proof.
  intros (_ & En & _ & Least).
  assert (T1 : t <= 1).
  { destruct En as (_ & Low & _). apply Rnot_lt_le. intros K. set (m := Rmin t 2).
    assert (1 < m <= 2 /\ m <= t) as [? ?] by (unfold m, Rmin; destruct Rle_dec; lra).
    assert (t <= (1 + m) / 2) by (apply Low; left; split; [reflexivity|lra]). lra. }
  assert (Ea : enters (fun o t => chord_of b 1 2 o t \/ chord_of a 1 3 o t) a 1).
  { split; [lra|]. split; [intros t' [(E & _)|(_ & K)]; [discriminate|lra]|]. intros later K.
    destruct (proj2 (enters_chord a 1 3 1 ltac:(lra)) ltac:(lra)) as (_ & _ & Near).
    destruct (Near later K) as (t' & I & L).
    exists t'. auto. }
  assert (T2 : 1 <= t).
  { destruct En as (_ & _ & Near). apply Rnot_lt_le. intros K.
    destruct (Near 1 K) as (t' & [(_ & I)|(E & _)] & L); [lra|discriminate]. }
  destruct (Least a 1 ltac:(discriminate) Ea) as [L|[_ L]]; [lra|]. exact (no_tie_back L).
Qed.
Example tie_is_hit : first_hit (fun o t => chord_of b 1 2 o t \/ chord_of a 1 3 o t) None a 1.
Proof.
  set (both := fun o t => _).
  assert (Ia : forall t, both a t <-> 1 < t < 3) by (unfold both, chord_of; intuition discriminate).
  assert (Ib : forall t, both b t <-> 1 < t < 2) by (unfold both, chord_of; intuition discriminate).
  split; [discriminate|]. split; [apply (enters_interval both a 1 3 1 ltac:(lra) Ia); lra|].
  split; [intros o _ [(_ & K)|(_ & K)]; lra|]. intros o t _ En. right.
  assert (o = b \/ o = a) as [-> | ->].
  { destruct En as (_ & _ & Near). destruct (Near (t + 1) ltac:(lra)) as (u & [(E & _)|(E & _)] & _); auto. }
  - apply (enters_interval both b 1 2 t ltac:(lra) Ib) in En. split; [lra|exact ties_b].
  - apply (enters_interval both a 1 3 t ltac:(lra) Ia) in En. split; [lra|left; reflexivity].
Qed.
Example later_is_no_hit t : ~ first_hit (fun o t => chord_of a 2 3 o t \/ chord_of b 1 3 o t) None a t.
Proof.
  set (both := fun o t => _).
  assert (Ia : forall t, both a t <-> 2 < t < 3) by (unfold both, chord_of; intuition discriminate).
  assert (Ib : forall t, both b t <-> 1 < t < 3) by (unfold both, chord_of; intuition discriminate).
  intros (_ & En & _ & Least). apply (enters_interval both a 2 3 t ltac:(lra) Ia) in En.
  assert (Eb : enters both b 1) by (apply (enters_interval both b 1 3 1 ltac:(lra) Ib); lra).
  destruct (Least b 1 ltac:(discriminate) Eb); lra.
Qed.
Example inside_is_the_smaller : first_inside (fun o t => chord_of b (-1) 2 o t \/ chord_of a (-1) 3 o t)
  None a.
Proof.
  split; [discriminate|]. split; [right; split; [reflexivity|lra]|].
  intros o _ [(-> & _)|(-> & _)]; [exact ties_b|left; reflexivity].
Qed.
(* A chord that has a first point begins there. *)
Example closed_chord : enters (fun o t => o = a /\ 1 <= t <= 2) a 1.
Proof.
  split; [lra|]. split; [intros t (_ & K); lra|]. intros later K. exists 1. split; [split;
    [reflexivity|lra]|lra].
Qed.
