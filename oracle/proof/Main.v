(* The theorem: what the check accepts is a valid question with the right answer. *)
From Coq Require Import ZArith Reals Lra Lia List Bool.
From Flocq Require Import Core.
From Lorentz Require Import Spec Time Rounding Vectors Number Steps Space View Quadratic Windows Claims
  Reading Check.
Import ListNotations.
Local Open Scope Z_scope.

(* ---- The scene. *)
Definition scene_of (sc : scene) (p : prepared) : Prop :=
  (dimension sc = 2 \/ dimension sc = 3)%nat /\ dimension sc = size (flat p) /\
  (forall o L A, atom_of sc o L A ->
    exists S, In (Placed (of_lattice o) (of_atom o) S) (solids p) /\ read_solid (flat p) L A = Some S) /\
  (forall s, In s (solids p) -> exists L A, read_solid (flat p) L A = Some (its_solid s) /\
    item (lattices sc) (lattice_index s) = Some L /\ item (atoms L) (atom_index s) = Some A).

Lemma numbered_0 {A} (l : list A) j a : In (j, a) (numbered 0 l) <-> item l j = Some a.
Proof.
  rewrite numbered_ok, Z.sub_0_r. split; [tauto|]. intros E. split; auto.
  unfold item in E. destruct (Z.ltb_spec j 0); [discriminate|auto].
Qed.

Lemma in_numbered {A} (l : list A) a : In a l -> exists j, In (j, a) (numbered 0 l).
Proof.
  intros H. destruct (In_nth_error _ _ H) as [n En]. exists (Z.of_nat n). apply numbered_0. unfold item.
  destruct (Z.ltb_spec (Z.of_nat n) 0); [lia|]. rewrite Nat2Z.id. exact En.
Qed.

Theorem prepare_ok sc p : prepare sc = Some p -> valid_scene sc /\ scene_of sc p.
Proof.
  unfold prepare. set (planar := (dimension sc =? 2)%nat).
  destruct ((planar || (dimension sc =? 3)%nat) && negb (is_empty (lattices sc))) eqn:G; [|discriminate].
  apply andb_true_iff in G. destruct G as [Gd Gl].
  rewrite all_some_long_is, numbered_long_is.
  destruct (all_some (place_atoms planar) (numbered 0 (lattices sc))) as [pls|] eqn:E; [|discriminate].
  intros I; injection I as <-. rewrite concat_long_is. cbn [flat solids].
  assert (Hd : (dimension sc = 2 \/ dimension sc = 3)%nat)
    by (unfold planar in Gd; rewrite orb_true_iff, !Nat.eqb_eq in Gd; exact Gd).
  assert (Hs : dimension sc = size planar) by (unfold planar, size; destruct Hd as [-> | ->]; reflexivity).
  destruct (all_some_ok _ _ _ E) as [A1 A2].
  assert (Atoms : forall l ps, place_atoms planar l = Some ps -> atoms (snd l) <> [] /\
    (forall j A, item (atoms (snd l)) j = Some A -> exists S, In (Placed (fst l) j S) ps /\
      read_solid planar (snd l) A = Some S) /\
    (forall s, In s ps -> lattice_index s = fst l /\ exists A, item (atoms (snd l)) (atom_index s) = Some A /\
      read_solid planar (snd l) A = Some (its_solid s))).
  { intros l ps. unfold place_atoms. destruct (is_empty (atoms (snd l))) eqn:Em; [discriminate|]. intros Ep.
    rewrite all_some_long_is, numbered_long_is in Ep.
    destruct (all_some_ok _ _ _ Ep) as [B1 B2]. split; [intros K; rewrite K in Em; discriminate|]. split.
    - intros j A HA. apply numbered_0 in HA. destruct (B1 _ HA) as (s & Hin & Es). cbn [fst snd] in Es.
      destruct (read_solid planar (snd l) A) as [S|]; [|discriminate]. injection Es as <-. eauto.
    - intros s Hin. destruct (B2 _ Hin) as ([j A] & HA & Es). cbn [fst snd] in Es. apply numbered_0 in HA.
      destruct (read_solid planar (snd l) A) as [S|] eqn:ES; [|discriminate]. injection Es as <-.
      cbn. eauto. }
  split; [split; [exact Hd|split]|].
  - intros K. rewrite K in Gl. discriminate.
  - rewrite Forall_forall. intros L HL. destruct (in_numbered _ _ HL) as [l Hl].
    destruct (A1 _ Hl) as (ps & _ & Ep).
    destruct (Atoms _ _ Ep) as (N & B1 & _). cbn [fst snd] in *. rewrite Hs.
    assert (All : forall A, In A (atoms L) -> independent (size planar) (vectors L) /\
      valid_atom (size planar) A).
    { intros A HA. destruct (in_numbered _ _ HA) as [j Hj]. apply numbered_0 in Hj.
      destruct (B1 _ _ Hj) as (S & _ & ES).
      apply read_solid_ok in ES. tauto. }
    split; [|split; [exact N|rewrite Forall_forall; intros A HA; apply All, HA]].
    destruct (atoms L) as [|A rest]; [contradiction|]. apply (All A). left. reflexivity.
  - split; [exact Hd|]. split; [exact Hs|]. split.
    + intros o L A (HL & HA & _). apply numbered_0 in HL. destruct (A1 _ HL) as (ps & Hin & Ep).
      destruct (Atoms _ _ Ep) as (_ & B1 & _). destruct (B1 _ _ HA) as (S & HS & ES). exists S. split; auto.
      apply in_concat. eauto.
    + intros s Hin. apply in_concat in Hin. destruct Hin as (ps & Hps & Hin).
      destruct (A2 _ Hps) as ([l L] & HL & Ep).
      destruct (Atoms _ _ Ep) as (_ & _ & B2). destruct (B2 _ Hin) as (El & A & HA & ES). cbn [fst snd] in *.
      apply numbered_0 in HL. exists L, A. rewrite El. auto.
Qed.

(* ---- A record of it. *)
Section Record.
  Variables (sc : scene) (p : prepared) (q : query) (k : Z) (x v : zv).
  Hypothesis depicted : scene_of sc p.
  Notation planar := (flat p).
  Hypothesis x_read : read_vector planar (start q) = Some x.
  Hypothesis v_read : read_vector planar (velocity q) = Some v.
  Hypothesis k_nonneg : 0 <= k.
  Hypothesis exact : divisible k (numbers_of x ++ numbers_of v) = true.
  Hypothesis all_visible : visible p k v = true.
  Let sights := see_all p k x v.
  Let within (o : obstacle) (t : R) : Prop := occupied sc o (along (point (start q)) t (point (velocity q))).

  Lemma the_line t : along (point (start q)) t (point (velocity q)) =
    lift planar (unit k) (radd (real (shrink k x)) t (real (shrink k v))).
  Proof.
    apply divisible_app in exact. destruct exact as [Dx Dv].
    rewrite (proj1 (read_vector_ok _ _ _ x_read)), (proj1 (read_vector_ok _ _ _ v_read)).
    rewrite (shrink_lift planar k k_nonneg x Dx), (shrink_lift planar k k_nonneg v Dv). apply lift_along.
  Qed.
  Lemma line_level t : planar = true -> pz (radd (real (shrink k x)) t (real (shrink k v))) = 0%R.
  Proof.
    intros E. pose proof (shrink_level planar k x (proj1 (proj2 (read_vector_ok _ _ _ x_read))) E) as Hx.
    pose proof (shrink_level planar k v (proj1 (proj2 (read_vector_ok _ _ _ v_read))) E) as Hv.
    cbn in *. rewrite Hx, Hv. ring.
  Qed.

  (* A sight, its solid and its atom; its rank. *)
  Definition sees (a : sight) (L : lattice) (A : atom) (S : solid) : Prop :=
    item (lattices sc) (its_lattice a) = Some L /\ item (atoms L) (its_atom a) = Some A /\
      depicts planar (unit k) L A S /\
    its_view a = see (shrink k x) (shrink k v) S /\ radius (adjugate (shaped S)) <> 0 /\ 0 < sQ (its_view a).
  Lemma visible_in s : In s (solids p) -> divisible k (all_numbers planar (its_solid s)) = true /\
    radius (adjugate (shaped (shrink_solid planar k (its_solid s)))) <> 0 /\
    0 < sQ (see (shrink k x) (shrink k v) (shrink_solid planar k (its_solid s))).
  Proof.
    intros Hs. pose proof all_visible as V. unfold visible in V. rewrite forallb_forall in V.
    specialize (V _ Hs). cbv zeta in V.
    rewrite !andb_true_iff, negb_true_iff, Z.eqb_neq, Z.ltb_lt in V. exact V.
  Qed.
  Lemma sights_ok a : In a sights -> exists L A S, sees a L A S.
  Proof.
    intros Ha. unfold sights, see_all in Ha. rewrite map_long_is in Ha. apply in_map_iff in Ha.
      destruct Ha as (s & <- & Hs).
    destruct depicted as (_ & _ & _ & B). destruct (B _ Hs) as (L & A & ES & HL & HA).
    destruct (visible_in s Hs) as (V1 & V2 & V3). exists L, A, (shrink_solid planar k (its_solid s)).
    split; [exact HL|split; [exact HA|split; [|auto]]]. apply shrink_depicts; auto.
    apply (read_solid_ok _ _ _ _ ES).
  Qed.

  Lemma regular_sights a : In a sights -> 0 < sQ (its_view a) /\ 0 <= sr (its_view a).
  Proof.
    intros Ha. destruct (sights_ok a Ha) as (L & A & S & _ & _ & _ & E & _ & HQ). split; [exact HQ|].
    rewrite E. apply sr_nonneg.
  Qed.
  Lemma seen_all o t : within o t -> exists a n, In a sights /\ fits (sk (its_view a)) n /\ o = obstacle_at a n.
  Proof.
    intros (L & A & HA & _). destruct depicted as (_ & _ & B & _). destruct (B _ _ _ HA) as (S & HS & ES).
    apply read_solid_ok in ES. destruct ES as [D _]. destruct (depicts_rank _ _ _ _ _ D) as [Rk Lk].
    destruct HA as (_ & _ & Hc). rewrite Lk in Hc. destruct (coordinates_of _ _ Rk Hc) as (n & En & Ln).
    exists (Sight (of_lattice o) (of_atom o) (see (shrink k x) (shrink k v) (shrink_solid planar k S))), n.
    split; [|split; [exact Ln|]].
    - unfold sights, see_all. rewrite map_long_is. apply in_map_iff. exists (Placed (of_lattice o)
      (of_atom o) S). auto.
    - unfold obstacle_at. cbn. destruct o. cbn in *. subst. reflexivity.
  Qed.
  Lemma chords a n t : In a sights -> fits (sk (its_view a)) n -> let y := its_view a in let W := at_cell y n in
    within (obstacle_at a n) t <-> ((IZR (sQ y) * t - IZR (sS y W)) * (IZR (sQ y) * t - IZR (sS y W)) <
      IZR (sD y W))%R.
  Proof.
    intros Ha Ln y W. destruct (sights_ok a Ha) as (L & A & S & HL & HA & HS & Ey & HR & HQ). unfold within.
    rewrite the_line. destruct depicted as (_ & Hs & _). destruct (depicts_rank _ _ _ _ _ HS) as [Rk Lk].
    assert (Er : sk (its_view a) = rank S) by (rewrite Ey; reflexivity).
    assert (AO : atom_of sc (obstacle_at a n) L A).
    { split; [exact HL|split; [exact HA|]]. rewrite Lk. cbn. rewrite Er. apply coordinates_length, Rk. }
    rewrite (depicted_occupied planar (unit k) (unit_pos k) sc (obstacle_at a n) L A S n _ Hs AO HS
      ltac:(cbn; rewrite Er; reflexivity) ltac:(rewrite <- Er; exact Ln) (line_level t)).
    unfold W, y. rewrite Ey in *. apply chord_view; auto.
  Qed.

  Lemma find_sight_ok o a : find_sight sights o = Some a -> In a sights /\ of_lattice o = its_lattice a /\
    of_atom o = its_atom a.
  Proof.
    intros E. apply find_some in E. destruct E as [Hin E]. unfold same_atom in E.
    rewrite andb_true_iff, !Z.eqb_eq in E. tauto.
  Qed.
  Lemma named o a n : find_sight sights o = Some a -> read_row (sk (its_view a)) (cell o) = Some n ->
    In a sights /\ fits (sk (its_view a)) n /\ o = obstacle_at a n.
  Proof.
    intros E1 E2. destruct (find_sight_ok _ _ E1) as (Ha & El & Ea).
    destruct (read_row_ok _ _ _ E2) as [Ln En].
    split; [auto|split; [auto|]]. unfold obstacle_at. destruct o. cbn in *. subst. reflexivity.
  Qed.

  (* ---- Times. *)
  Lemma check_times_ok t time m e : regular t -> (0 <= time_value t)%R -> 0 <= ts t ->
    passes (check_times t time m e) ->
    (IZR m * bpow radix10 e = nearest40 (time_value t))%R /\
    match time with
    | Some n => finite n /\ value n = nearest64 (time_value t)
    | None => (bpow radix2 1024 <= nearest64 (time_value t))%R
    end.
  Proof.
    intros Ht H0 Hs H. unfold check_times in H. apply passes_both in H. destruct H as [H1 H].
    apply passes_both in H.
    destruct H as [_ H2]. apply passes_require in H2. split.
    - destruct (Z.eqb_spec (ts t * ts t) (td t)) as [E|_]; [|symmetry; apply rounds40_ok; auto].
      apply Z.eqb_eq in H2. subst m. assert (V : time_value t = 0%R).
      { unfold time_value. rewrite <- E, mult_IZR, sqrt_square by (apply IZR_le; auto). unfold Rdiv. ring. }
      rewrite V. unfold nearest40. rewrite round_0 by apply valid_rnd_N. ring.
    - destruct time as [n|]; [|apply passes_require in H1; apply beyond_ok; auto].
      destruct (number n) as [N|] eqn:EN; [|apply passes_fail in H1; tauto].
      destruct (number_ok n N EN) as [V F].
      split; [exact F|]. cbv zeta in H1. set (c := Z.max 0 (Z.log2 N - 52)) in *.
      apply passes_both in H1. destruct H1 as [Hx Hr]. apply passes_require in Hx, Hr. apply Z.eqb_eq in Hx.
      rewrite (rounds64_ok t _ _ Ht H0 Hr), V. rewrite <- Hx at 1. rewrite Z.shiftl_mul_pow2, mult_IZR by lia.
      change 2 with (radix_val radix2). rewrite IZR_power by lia. rewrite Rmult_assoc. f_equal.
      unfold smallest.
      rewrite <- bpow_plus. reflexivity.
  Qed.

  Lemma check_answer_ok a c : passes (check_answer sights (from q) a c) -> correct sc q a.
  Proof.
    intros H. unfold correct, check_answer in *. fold within.
    destruct a as [X time m e|X|].
    - destruct (find_sight sights X) as [s|] eqn:ES; [|apply passes_fail in H; tauto].
      destruct (read_row (sk (its_view s)) (cell X)) as [n|] eqn:EN; [|apply passes_fail in H; tauto].
      apply passes_both in H. destruct H as [H Ht]. destruct (named _ _ _ ES EN) as (Hs & Ln & EX).
      pose proof (check_hit_ok sights (from q) _ within regular_sights seen_all chords s n Hs Ln H) as F.
      exists (time_value (time_of (its_view s) n)). rewrite EX at 1. split; [exact F|].
      destruct F as (_ & En & _).
      pose proof (proj1 (entered sights within regular_sights chords s n _ Hs Ln) En)
        as (Hd & _ & Hp & _).
      apply check_times_ok; [apply (time_of_regular sights regular_sights); auto|apply En|lia|exact Ht].
    - destruct (find_sight sights X) as [s|] eqn:ES; [|apply passes_fail in H; tauto].
      destruct (read_row (sk (its_view s)) (cell X)) as [n|] eqn:EN; [|apply passes_fail in H; tauto].
      destruct (named _ _ _ ES EN) as (Hs & Ln & ->).
      exact (check_inside_ok sights (from q) _ within regular_sights seen_all chords s n Hs Ln H).
    - exact (check_never_ok sights (from q) _ _ within regular_sights seen_all chords H).
  Qed.
End Record.

Theorem check_sound sc p q a c : prepare sc = Some p -> passes (check_record p q a c) ->
  valid_scene sc /\ valid_query sc q /\ correct sc q a.
Proof.
  intros Hp H. destruct (prepare_ok sc p Hp) as [Vs D]. split; [exact Vs|]. unfold check_record in H.
  destruct (read_vector (flat p) (start q)) as [x|] eqn:Ex; [|apply passes_fail in H; tauto].
  destruct (read_vector (flat p) (velocity q)) as [v|] eqn:Ev; [|apply passes_fail in H; tauto].
  cbv zeta in H.
  set (k := twos _) in *. clearbody k.
  apply passes_both in H. destruct H as [Hf H]. apply passes_both in H. destruct H as [Hv H].
  apply passes_both in H. destruct H as [Hk H]. apply passes_require in Hf, Hv, Hk.
  rewrite !andb_true_iff, Z.leb_le in Hk. destruct Hk as [[Hk Hdiv] Hvis]. apply Z.ltb_lt in Hv. split.
  - destruct D as (_ & Ds & _ & DB). unfold valid_query. rewrite Ds.
    split; [apply (read_vector_ok _ _ _ Ex)|].
    destruct (read_vector_ok _ _ _ Ev) as (Pv & Lv & Sv). split; [exact Sv|]. split.
    + intros Z0. rewrite Pv in Z0. assert (V : v = V 0 0 0); [|rewrite V in Hv; discriminate].
      pose proof smallest_pos as Sp. unfold lift, zero, size, real in Z0. unfold level in Lv.
      assert (K : forall c, (smallest * IZR c = 0)%R -> c = 0%Z)
        by (intros i Hi; apply Rmult_integral in Hi; destruct Hi as [Hi|Hi]; [lra|apply eq_IZR, Hi]).
      destruct (flat p); injection Z0; intros; apply zv_eq; cbn; auto.
    + intros o Eo. rewrite Eo in Hf. unfold is_obstacle in Hf. apply existsb_exists in Hf.
      destruct Hf as (s & Hs & Es). apply andb_true_iff in Es. destruct Es as [Es Hc]. unfold same_atom in Es.
      rewrite andb_true_iff, !Z.eqb_eq in Es.
      destruct (DB _ Hs) as (L & A & ES & HL & HA). destruct Es as [El Ea]. exists L, A.
      apply read_solid_ok in ES. destruct ES as [DS _]. destruct (depicts_rank _ _ _ _ _ DS) as [_ Lk].
      apply Nat.eqb_eq in Hc. unfold atom_of. rewrite El, Ea, Hc. auto.
  - exact (check_answer_ok sc p q k x v D Ex Ev Hk Hdiv Hvis _ _ H).
Qed.
