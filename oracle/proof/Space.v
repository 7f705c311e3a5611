(* Scenes of integers in space. All lengths are integers in a unit u; a planar scene is the layer z = 0 of a
   spatial one, its discs the equators of balls, its ellipses those of ellipsoids with the third semiaxis (0,
   0, 1). *)
From Coq Require Import ZArith Reals Lra Lia List.
From Lorentz Require Import Spec Vectors.
Import ListNotations.
Local Open Scope R_scope.

(* ---- Real vectors in space. *)
Record rv := P { px : R; py : R; pz : R }.
Definition real (a : zv) : rv := P (IZR (vx a)) (IZR (vy a)) (IZR (vz a)).
Definition radd (a : rv) (t : R) (b : rv) := P (px a + t * px b) (py a + t * py b) (pz a + t * pz b).
Definition norm2 (a : rv) := px a * px a + py a * py a + pz a * pz a.
Definition rplace (c y a1 a2 a3 : rv) := radd (radd (radd c (px y) a1) (py y) a2) (pz y) a3.

Lemma rv_eq a b : px a = px b -> py a = py b -> pz a = pz b -> a = b.
Proof. destruct a, b; cbn; intros; subst; reflexivity. Qed.

(* Equal lists of sums. *)
Ltac lists := cbn; repeat (apply (f_equal2 (@cons R)); [ring|]); reflexivity.

(* ---- Atoms. *)
Inductive body := Ball (r : Z) | Ellipsoid (a1 a2 a3 : zv).
(* The first `rank` of g1, g2, g3 are the vectors of its lattice. *)
Record solid := Solid { middle : zv; rank : nat; g1 : zv; g2 : zv; g3 : zv; shaped : body }.
Definition middle_of (S : solid) (n : zv) : rv := rplace (real (middle S)) (real n) (real (g1 S))
  (real (g2 S)) (real (g3 S)).
Definition in_body (b : body) (c q : rv) : Prop :=
  match b with
  | Ball r => norm2 (radd q (-1) c) < IZR r * IZR r
  | Ellipsoid a1 a2 a3 => exists y, norm2 y < 1 /\ q = rplace c y (real a1) (real a2) (real a3)
  end.

(* Volume: three vectors of a determinant are independent. *)
Lemma volume a b c k1 k2 k3 : det a b c <> 0%Z ->
  rplace (P 0 0 0) (P k1 k2 k3) (real a) (real b) (real c) = P 0 0 0 -> k1 = 0 /\ k2 = 0 /\ k3 = 0.
Proof.
  intros Hdet E.
  unfold rplace, radd, real in E; cbn in E. injection E as E1 E2 E3.
  apply not_0_IZR in Hdet. unfold det, dot, cross in Hdet; cbn in Hdet.
  repeat rewrite ?plus_IZR, ?minus_IZR, ?mult_IZR in Hdet.
  destruct a as [ax ay az], b as [bx b2 bz], c as [cx cy cz]; cbn in *.
  set (D := _ + _ + _) in Hdet.
  assert (K : k1 * D = 0 /\ k2 * D = 0 /\ k3 * D = 0).
  { split; [|split].
    - transitivity ((0 + k1 * IZR ax + k2 * IZR bx + k3 * IZR cx) * (IZR b2 * IZR cz - IZR bz * IZR cy)
        + (0 + k1 * IZR ay + k2 * IZR b2 + k3 * IZR cy) * (IZR bz * IZR cx - IZR bx * IZR cz)
        + (0 + k1 * IZR az + k2 * IZR bz + k3 * IZR cz) * (IZR bx * IZR cy - IZR b2 * IZR cx)); [unfold D;
            ring|].
      rewrite E1, E2, E3. ring.
    - transitivity ((0 + k1 * IZR ax + k2 * IZR bx + k3 * IZR cx) * (IZR cy * IZR az - IZR cz * IZR ay)
        + (0 + k1 * IZR ay + k2 * IZR b2 + k3 * IZR cy) * (IZR cz * IZR ax - IZR cx * IZR az)
        + (0 + k1 * IZR az + k2 * IZR bz + k3 * IZR cz) * (IZR cx * IZR ay - IZR cy * IZR ax)); [unfold D;
            ring|].
      rewrite E1, E2, E3. ring.
    - transitivity ((0 + k1 * IZR ax + k2 * IZR bx + k3 * IZR cx) * (IZR ay * IZR bz - IZR az * IZR b2)
        + (0 + k1 * IZR ay + k2 * IZR b2 + k3 * IZR cy) * (IZR az * IZR bx - IZR ax * IZR bz)
        + (0 + k1 * IZR az + k2 * IZR bz + k3 * IZR cz) * (IZR ax * IZR b2 - IZR ay * IZR bx)); [unfold D;
            ring|].
      rewrite E1, E2, E3. ring. }
  repeat split; apply (Rmult_eq_reg_r D); try lra; exact Hdet.
Qed.

(* The place of an obstacle in a lattice of k vectors. *)
Definition coordinates (k : nat) (n : zv) : list Z := firstn k [vx n; vy n; vz n].
Lemma coordinates_of k (c : list Z) : (k <= 3)%nat -> length c = k -> exists n, c = coordinates k n /\ fits k n.
Proof.
  intros Hk H. exists (V (nth 0 c 0) (nth 1 c 0) (nth 2 c 0))%Z. unfold fits, coordinates.
  destruct c as [|? [|? [|? [|? ?]]]]; cbn in H; subst k; cbn; repeat split; auto; lia.
Qed.
Lemma coordinates_inj k n m : fits k n -> fits k m -> coordinates k n = coordinates k m -> n = m.
Proof.
  intros (N3 & N2 & N1) (M3 & M2 & M1) E. unfold coordinates in E.
  destruct k as [|[|[|k]]]; cbn in E; try injection E; intros; apply zv_eq; auto; rewrite ?N3, ?N2, ?N1, ?M3, ?M2, ?M1 by lia; reflexivity.
Qed.
Lemma coordinates_length k n : (k <= 3)%nat -> length (coordinates k n) = k.
Proof. intros H. unfold coordinates. rewrite firstn_length. cbn. lia. Qed.

Section Unit.
  Variables (planar : bool) (u : R).
  Hypothesis u_pos : 0 < u.

  Definition lift (q : rv) : vec := if planar then [u * px q; u * py q] else [u * px q; u * py q; u * pz q].
  Definition three {A} (a b c : A) : list A := if planar then [a; b] else [a; b; c].
  Definition lifts (a b c : zv) : list vec := three (lift (real a)) (lift (real b)) (lift (real c)).
  Definition firsts (k : nat) (a b c : zv) : list vec := firstn k [lift (real a); lift (real b); lift (real c)].
  Definition size : nat := if planar then 2%nat else 3%nat.
  Definition level (a : zv) : Prop := planar = true -> vz a = 0%Z.

  (* The atom A of the lattice L. *)
  Definition depicts_shape (s : shape) (b : body) : Prop :=
    match s, b with
    | Radius r, Ball k => value r = u * IZR k /\ (0 < k)%Z
    | Semiaxes a, Ellipsoid a1 a2 a3 => map point a = lifts a1 a2 a3 /\
        level a1 /\ level a2 /\ (planar = true -> a3 = V 0 0 1)
    | _, _ => False
    end.
  Definition depicts (L : lattice) (A : atom) (S : solid) : Prop :=
    point (position A) = lift (real (middle S)) /\
    map point (vectors L) = firsts (rank S) (g1 S) (g2 S) (g3 S) /\ (rank S <= 3)%nat /\
    level (middle S) /\ level (g1 S) /\ level (g2 S) /\ level (g3 S) /\ depicts_shape (shape_of A) (shaped S).

  Lemma depicts_rank L A S : depicts L A S -> (rank S <= 3)%nat /\ length (vectors L) = rank S.
  Proof.
    intros (_ & Hv & Hk & _). split; [exact Hk|]. apply (f_equal (@length vec)) in Hv.
    rewrite map_length in Hv. unfold firsts in Hv. rewrite firstn_length in Hv. cbn in Hv. lia.
  Qed.

  (* ---- The same sums, with the third coordinate or without. *)
  Lemma lift_along a t b : along (lift a) t (lift b) = lift (radd a t b).
  Proof. unfold lift, along. destruct planar; lists. Qed.
  Lemma lift_combination c k1 k2 k3 a1 a2 a3 : (planar = true -> k3 = 0) ->
    combination (lift c) (three k1 k2 k3) (lifts a1 a2 a3) =
      lift (rplace c (P k1 k2 k3) (real a1) (real a2) (real a3)).
  Proof.
    intros Hk. unfold lifts, three, rplace, lift, along, radd. destruct planar; [rewrite Hk by auto|]; lists.
  Qed.
  Lemma lift_eq a b : (planar = true -> pz a = pz b) -> lift a = lift b -> a = b.
  Proof.
    unfold lift. intros Hz E.
    destruct planar; injection E; intros; apply rv_eq; try (apply Rmult_eq_reg_l with u; lra); auto.
  Qed.
  Lemma lift_norm a r : (planar = true -> pz a = 0) -> 0 < r -> norm (lift a) < u * r <-> norm2 a < r * r.
  Proof.
    intros Hz Hr. assert (N : norm (lift a) = sqrt (u * u * norm2 a)).
    { unfold norm, lift, norm2. destruct planar; cbn; [rewrite Hz by auto|]; f_equal; ring. }
    rewrite N. assert (0 < u * u) by (apply Rmult_lt_0_compat; auto).
    assert (0 < u * r) by (apply Rmult_lt_0_compat; auto).
    assert (Pn : 0 <= norm2 a) by (unfold norm2; pose proof (Rle_0_sqr (px a)); pose proof (Rle_0_sqr (py a));
      pose proof (Rle_0_sqr (pz a)); unfold Rsqr in *; lra).
    assert (E : u * r = sqrt (u * u * (r * r))).
    { replace (u * u * (r * r)) with ((u * r) * (u * r)) by ring. rewrite sqrt_square; lra. }
    rewrite E. split; intros K.
    - apply sqrt_lt_0_alt in K. apply Rmult_lt_reg_l with (u * u); auto.
    - apply sqrt_lt_1_alt. split; [apply Rmult_le_pos; lra|]. apply Rmult_lt_compat_l; auto.
  Qed.
  Lemma norm_lt_1 y : norm y < 1 <-> fold_right (fun c sum => c * c + sum) 0 y < 1.
  Proof.
    unfold norm. set (s := fold_right _ 0 y).
    assert (0 <= s) by (subst s; induction y as [|c y IH]; cbn; [lra|]; pose proof (Rle_0_sqr c);
      unfold Rsqr in *; lra).
    rewrite <- sqrt_1 at 1. split; intros K; [apply sqrt_lt_0_alt in K; lra|apply sqrt_lt_1_alt; lra].
  Qed.

  Lemma three_length {A} (l : list A) : length l = size -> forall d, exists a b c, l = three a b c /\
    (planar = true -> c = d).
  Proof.
    unfold size, three. intros H d. destruct planar; destruct l as [|a [|b [|c [|e l]]]]; try discriminate.
    - exists a, b, d. auto.
    - exists a, b, c. split; [auto|discriminate].
  Qed.
  Lemma middle_is k c n a1 a2 a3 : (k <= 3)%nat -> fits k n ->
    combination (lift c) (map IZR (coordinates k n)) (firsts k a1 a2 a3) =
      lift (rplace c (real n) (real a1) (real a2) (real a3)).
  Proof.
    intros Hk (F3 & F2 & F1). unfold coordinates, firsts, rplace, lift, along, radd, real; cbn [px py pz].
    destruct k as [|[|[|[|k]]]]; [| | | |lia]; rewrite ?F3, ?F2, ?F1 by lia; destruct planar; lists.
  Qed.

  Lemma rplace_level c y a1 a2 a3 : planar = true -> pz c = 0 -> vz a1 = 0%Z -> vz a2 = 0%Z ->
    pz (rplace c y (real a1) (real a2) (real a3)) = pz y * IZR (vz a3).
  Proof. intros _ Hc H1 H2. unfold rplace, radd, real; cbn. rewrite Hc, H1, H2. ring. Qed.

  (* ---- What the plane's scene says is what its layer says. *)
  Lemma depicted_occupied sc o L A S n q : dimension sc = size -> atom_of sc o L A -> depicts L A S ->
    cell o = coordinates (rank S) n -> fits (rank S) n -> (planar = true -> pz q = 0) ->
    occupied sc o (lift q) <-> in_body (shaped S) (middle_of S n) q.
  Proof.
    intros Hd HA (Hm & Hv & Rk & Lm & L1 & L2 & L3 & Hs) Hc Hn Hq.
    assert (EC : combination (point (position A)) (map IZR (cell o)) (map point (vectors L)) =
      lift (middle_of S n)).
    { rewrite Hm, Hv, Hc. apply middle_is; auto. }
    assert (ZC : planar = true -> pz (middle_of S n) = 0).
    { intros E. unfold middle_of. rewrite rplace_level; cbn; rewrite ?Lm, ?L1, ?L2, ?L3 by auto; auto;
        ring. }
    generalize dependent (middle_of S n). intros c EC ZC.
    assert (Only : occupied sc o (lift q) <-> match shape_of A with
      | Radius r => norm (along (lift q) (-1) (lift c)) < value r
      | Semiaxes a => exists y, length y = size /\ norm y < 1 /\
        lift q = combination (lift c) y (map point a) end).
    { unfold occupied. rewrite <- Hd, <- EC. split; [|intros K; exists L, A; split; auto].
      intros (L' & A' & (HL' & HA' & _) & K). destruct HA as (HL & HA & _).
      rewrite HL in HL'. injection HL' as <-. rewrite HA in HA'. injection HA' as <-. exact K. }
    rewrite Only. clear Only EC Hm Hv. unfold depicts_shape in Hs.
    destruct (shape_of A) as [r|a], (shaped S) as [k|a1 a2 a3]; try tauto; cbn [in_body].
    - destruct Hs as [-> Hk]. rewrite lift_along. apply lift_norm; [|apply IZR_lt; auto].
      intros E. cbn. rewrite Hq, ZC by auto. ring.
    - destruct Hs as (-> & H1 & H2 & H3). split.
      + intros (y & Hy & Ny & E). destruct (three_length y Hy 0) as (y1 & y2 & y3 & -> & Hy3).
        exists (P y1 y2 y3). split.
        * rewrite norm_lt_1 in Ny. unfold norm2, three in *; cbn.
          destruct planar; cbn in Ny; [rewrite Hy3 by auto|]; lra.
        * rewrite lift_combination in E by auto. apply lift_eq in E; auto.
          intros Ep. rewrite rplace_level; cbn; auto. rewrite Hq, Hy3 by auto. ring.
      + intros ([y1 y2 y3] & Ny & E). exists (three y1 y2 y3).
        assert (Hy3 : planar = true -> y3 = 0).
        { intros Ep. apply (f_equal pz) in E. rewrite rplace_level in E; auto. cbn in E.
          rewrite Hq, (H3 Ep) in E by auto. cbn in E. lra. }
        split; [unfold three, size; destruct planar; reflexivity|]. split.
        * rewrite norm_lt_1. unfold norm2, three in *; cbn in Ny.
          destruct planar; cbn; [rewrite Hy3 in Ny by auto|]; lra.
        * rewrite lift_combination by auto. rewrite <- E. reflexivity.
  Qed.

  (* ---- Volume. *)
  Lemma lift_origin : zero size = lift (P 0 0 0).
  Proof. unfold zero, size, lift. destruct planar; lists. Qed.
  Lemma firsts_independent n a b c : (n <= 3)%nat -> spread n a b c = true -> level a -> level b -> level c ->
    forall k, length k = n -> combination (zero size) k (firsts n a b c) = zero size -> k = zero n.
  Proof.
    intros Hn Hs La Lb Lc k Hk E. rewrite lift_origin in E.
    assert (Flat : forall k1 k2 k3 d, level d -> combination (lift (P 0 0 0)) k (firsts n a b c) =
      lift (rplace (P 0 0 0) (P k1 k2 k3) (real a) (real b) (real d)) ->
      rplace (P 0 0 0) (P k1 k2 k3) (real a) (real b) (real d) = P 0 0 0).
    { intros k1 k2 k3 d Ld K. rewrite E in K. apply lift_eq in K; auto.
      intros Ep. rewrite rplace_level by auto. cbn. rewrite (Ld Ep). ring. }
    destruct n as [|[|[|[|n]]]]; [| | | |lia]; cbn [spread] in Hs;
      try (apply Bool.negb_true_iff, Z.eqb_neq in Hs);
      repeat (destruct k as [|? k]; try discriminate Hk); clear Hk; unfold firsts in *; cbn [firstn] in *.
    - reflexivity.
    - assert (K := Flat r 0 0 c Lc ltac:(unfold rplace, lift, along, radd; destruct planar; lists)).
      apply not_0_IZR in Hs. unfold dot in Hs. rewrite !plus_IZR, !mult_IZR in Hs.
      unfold rplace, radd, real in K; cbn in K. injection K as K1 K2 K3.
      assert (r * (IZR (vx a) * IZR (vx a) + IZR (vy a) * IZR (vy a) + IZR (vz a) * IZR (vz a)) = 0) as Z0.
      { transitivity (IZR (vx a) * (r * IZR (vx a)) + IZR (vy a) * (r * IZR (vy a)) + IZR (vz a) * (r * IZR (vz a)));
          [ring|]. replace (r * IZR (vx a)) with 0 by lra. replace (r * IZR (vy a)) with 0 by lra.
        replace (r * IZR (vz a)) with 0 by lra. ring. }
      apply Rmult_integral in Z0. destruct Z0 as [-> |Z0]; [reflexivity|contradiction].
    - assert (Dn : det a b (cross a b) = dot (cross a b) (cross a b)) by (vectors; ring).
      assert (K : rplace (P 0 0 0) (P r r0 0) (real a) (real b) (real (cross a b)) = P 0 0 0).
      { transitivity (rplace (P 0 0 0) (P r r0 0) (real a) (real b) (real c)).
        - unfold rplace, radd. cbn. f_equal; ring.
        - apply (Flat r r0 0 c Lc). unfold rplace, lift, along, radd. destruct planar; lists. }
      apply volume in K; [|rewrite Dn; exact Hs]. destruct K as (-> & -> & _). reflexivity.
    - assert (K := Flat r r0 r1 c Lc ltac:(unfold rplace, lift, along, radd; destruct planar; lists)).
      apply volume in K; auto. destruct K as (-> & -> & ->). reflexivity.
  Qed.
  Lemma lifts_independent a b c : det a b c <> 0%Z -> level a -> level b -> forall k, length k = size ->
    combination (zero size) k (lifts a b c) = zero size -> k = zero size.
  Proof.
    intros Hdet La Lb k Hk E. destruct (three_length k Hk 0) as (k1 & k2 & k3 & -> & Hk3).
    rewrite lift_origin in E. rewrite lift_combination in E by auto. apply lift_eq in E.
    2: { intros Ep. rewrite rplace_level; cbn; auto. rewrite Hk3 by auto. ring. }
    apply volume in E; auto. destruct E as (-> & -> & ->). rewrite lift_origin.
    unfold three, lift. destruct planar; lists.
  Qed.
End Unit.
